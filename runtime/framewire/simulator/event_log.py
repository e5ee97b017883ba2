"""The events on the board, as lines to read: the LED and the buzzer among them."""

from __future__ import annotations

from collections import deque
from typing import TYPE_CHECKING

from ..line.log import Log

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

KEPT = 10_000


class EventLog:
    """The last lines, oldest first; each goes to the log of the simulator's package, at INFO."""

    def __init__(self, package: str) -> None:
        self._logger = Log(package)()
        self._lines: deque[str] = deque(maxlen=KEPT)
        self.listener: Callable[[str], None] | None = None

    def add(self, moment: float, who: str, what: str) -> None:
        """Add a line: when, in seconds since the board was switched on, who, and what."""
        line = f"{moment:10.3f}  {who:8}  {what}"
        self._lines.append(line)
        self._logger.info("%s", line)
        if self.listener is not None:
            self.listener(line)

    def __iter__(self) -> Iterator[str]:
        return iter(tuple(self._lines))

    def __len__(self) -> int:
        return len(self._lines)

    def __str__(self) -> str:
        return "\n".join(self)
