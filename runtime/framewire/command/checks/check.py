"""A check: its id, what it checks, which others it needs, and the function that makes it."""

from __future__ import annotations

from typing import NamedTuple

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from .diagnosis import Diagnosis
    from .result import Result


class Check(NamedTuple):
    """One check. It is skipped if one of `needs` has failed, or was skipped."""

    id: str
    title: str
    needs: tuple[str, ...]
    look: Callable[[Diagnosis], Result]
