"""A line by a function, by the name that other tests know it by."""

from tests.lines.timed_line import ScriptedLine

__all__ = ["ScriptedLine"]
