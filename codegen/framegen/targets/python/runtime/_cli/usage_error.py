"""The errors of the command line: one line for the user, and a number for the shell."""

from __future__ import annotations

from .exit_codes import LINE_LOST, UNUSABLE


class UsageError(Exception):
    """What was given on the command line, or to read, is of no use. The text says why."""

    code = UNUSABLE


class LineLostError(UsageError):
    """The line was there and is gone: nothing was wrong with what was given."""

    code = LINE_LOST
