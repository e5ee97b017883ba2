"""A check: its id, what it holds, which others must have passed before, and how it is made."""

from __future__ import annotations

from typing import NamedTuple

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

    from .diagnosis import Diagnosis
    from .result import Result


class Check(NamedTuple):
    """One check. Where one of `needs` has failed, or could not be made, it is not made."""

    id: str
    title: str
    needs: tuple[str, ...]
    look: Callable[[Diagnosis], Result]
