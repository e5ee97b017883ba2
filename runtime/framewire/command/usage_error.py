"""The errors of the command line: what is wrong, what could be typed, and an exit status."""

from __future__ import annotations

from .exit_codes import LINE_LOST, UNUSABLE

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable


class UsageError(Exception):
    """Arguments or input that cannot be used. The text says why.

    `choices` are what could be typed instead, a line each.
    """

    code = UNUSABLE

    def __init__(self, problem: str, choices: Iterable[str] = ()) -> None:
        super().__init__(problem)
        self.choices = tuple(choices)


class LineLostError(UsageError):
    """The line was lost after it was opened: the arguments are not to blame."""

    code = LINE_LOST
