"""The errors of the command line: one line for the user, and an exit status."""

from __future__ import annotations

from .exit_codes import LINE_LOST, UNUSABLE


class UsageError(Exception):
    """Arguments or input that cannot be used. The text says why."""

    code = UNUSABLE


class LineLostError(UsageError):
    """The line was lost after it was opened: the arguments are not to blame."""

    code = LINE_LOST
