"""Troubleshooting as a program: checks of a port, a line and a device, in the order of the guide.

It reads and changes nothing, unless it is told to. A check is a function in a module of its own,
which gives a Result; `checks` lists them, and `diagnosis` holds what they share.
"""
