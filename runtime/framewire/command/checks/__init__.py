"""Troubleshooting as a program: checks of a port, a line and a device, in the order of the guide.

It reads and changes nothing, unless an option says so. A check is a function in a module of its
own, which returns a Result; `checks` lists them, and `diagnosis` holds what they share.
"""
