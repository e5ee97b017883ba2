"""Transports: serial ports, USB HID devices, and the errors of both."""
