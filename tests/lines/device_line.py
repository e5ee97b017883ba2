"""A line to the Device of any library, by the name that other tests know it by."""

from tests.lines.timed_line import DeviceLine, client_of

__all__ = ["DeviceLine", "client_of"]
