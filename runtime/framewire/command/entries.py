"""Print the entries of a recording, as text, as JSON or as CSV, with the times that it holds."""

from __future__ import annotations

import csv

from ..codec.noise import Noise
from ..frame.bytes_like import format_hex
from .events import in_json, origin_of
from .lines import in_line, time_of_day
from .values import fields_in_json

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from typing import Any, TextIO, TypeVar

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message
    from ..recording.entry import Entry

    _Said = TypeVar("_Said")

COLUMNS = ("offset", "time", "from", "direction", "message", "or", "fields", "hex", "reason")
# The text of events that a recording repeats is remembered, up to this many.
_REMEMBERED = 2048


class EntryLines:
    """A line for each entry, on a given screen.

    `form` is text, json or csv. `times` is one of TIMES, None for whatever times there are.
    """

    def __init__(
        self, screen: TextIO, form: str, codec: ProtocolCodec, times: str | None = None
    ) -> None:
        self._screen = screen
        self._codec = codec
        self._times = times or "zero"
        self._began: float | None = None
        self._last = 0.0
        self._with_time = self._with_day = self._count = 0
        self._said: dict[tuple[object, ...], Any] = {}
        # Text streams end lines as the system does.
        self._rows = csv.writer(screen, lineterminator="\n")
        self._say = {"text": self._as_text, "json": self._as_json, "csv": self._as_row}[form]
        if form == "csv":
            self._rows.writerow(COLUMNS)

    def show(self, entry: Entry) -> None:
        """Print an entry; the caller flushes."""
        self._count += 1
        self._say(entry, self._time(entry))

    def problems(self, name: str) -> Iterator[str]:
        """Yield which of the chosen times are missing."""
        if self._with_time < self._count:
            yield f"{name} holds no times: the first column is the byte at which each begins"
        elif self._times == "absolute" and self._with_day < self._count:
            yield f"{name} does not say when it began: times are seconds since then"

    def _time(self, entry: Entry) -> float | None:
        now = entry.time
        if now is None:
            return None
        self._with_time += 1
        if self._times == "delta":
            if entry.began != self._began:  # one recording behind the other
                self._began, self._last = entry.began, 0.0
            now, self._last = now - self._last, now
        elif self._times == "absolute" and entry.began is not None:
            self._with_day += 1
            now += entry.began
        return now

    def _as_text(self, entry: Entry, time: float | None) -> None:
        if time is None:
            when = f"{entry.offset:6}"
        elif self._times == "absolute" and entry.began is not None:
            when = time_of_day(time)
        else:
            when = f"{time:12.6f}"
        self._screen.write(f"{when}  {self._remembered(entry, in_line)}\n")

    def _as_json(self, entry: Entry, time: float | None) -> None:
        when = "" if time is None else f', "time": {round(time, 6)}'
        rest = self._remembered(entry, _as_json)
        self._screen.write(f'{{"offset": {entry.offset}{when}, {rest}\n')

    def _as_row(self, entry: Entry, time: float | None) -> None:
        when = "" if time is None else f"{time:.6f}"
        self._rows.writerow([entry.offset, when, *self._remembered(entry, _as_cells)])

    def _remembered(
        self, entry: Entry, say: Callable[[Message | Noise, Direction | None, ProtocolCodec], _Said]
    ) -> _Said:
        event = entry.event
        key: tuple[object, ...]
        if isinstance(event, Noise):
            key = (type(event), event.data, event.reason, entry.sender)
        else:
            key = (event.encode(), entry.sender)
        said: _Said | None = self._said.get(key)
        if said is None:
            if len(self._said) >= _REMEMBERED:
                self._said.clear()
            said = self._said[key] = say(event, entry.direction, self._codec)
        return said


def _as_json(event: Message | Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    return in_json(event, direction, codec)[1:]


def _as_cells(
    event: Message | Noise, direction: Direction | None, codec: ProtocolCodec
) -> list[str]:
    sender, names = origin_of(event, direction, codec)
    if isinstance(event, Noise):
        return [sender, "", "", "", "", format_hex(event.data), event.reason.value]
    name, *others = names
    fields, frame = fields_in_json(event), format_hex(event.encode())
    return [sender, event.DIRECTION.value, name, " ".join(others), fields, frame, ""]
