"""Read the lines of a recording: each is one event, with its time, its sender and its bytes."""

from __future__ import annotations

import re
from datetime import datetime

from .._codec.codec import table_for
from .._codec.decoder import Event, StreamDecoder
from .._codec.event_bytes import bytes_of
from .._codec.hextext import HexError, read_hex
from .._codec.noise import Noise
from .._frame.direction import RECEIVED
from .._frame.errors import Reason
from .entry import SENDERS, WAYS, Entry, RecordingError
from .file import EITHER, NOISE
from .form import LONGEST_LINE, TIMED_LINE

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from typing import Any

    from .._frame.direction import Direction

_BEGAN = re.compile(
    r"# recorded of .* from (\d{4}-\d\d-\d\d \d\d:\d\d:\d\d)(\.\d{1,6})? ([+-]\d{4}) on"
)
_REASONS = {reason.value: reason for reason in Reason}


def recorded(blocks: Iterable[str], direction: Direction | None) -> Iterator[Entry]:
    """Yield the entries of a recording; `direction` is of lines that name either end as sender."""
    began: float | None = None
    number = offset = 0
    for block in blocks:
        lines = block.split("\n")
        if not lines[-1]:
            lines.pop()
        for line in lines:
            number += 1
            found = TIMED_LINE.match(line)
            if found is None or len(line) >= LONGEST_LINE:
                began = _beginning(line, number, began)
                continue
            text, at, who, what = found.groups()
            try:
                data = read_hex(text)
            except HexError as error:
                raise RecordingError(f"line {number}: {error}") from None
            sender, is_noise = _sender(who, number, direction)
            time = float(at)
            for event in _events(data, sender, what.strip(), is_noise=is_noise):
                yield Entry(event, sender, offset, line=number, time=time, began=began)
                offset += len(bytes_of(event))


def _beginning(line: str, number: int, began: float | None) -> float | None:
    """Return when the recording began, or None. Raises RecordingError if the line has bytes."""
    line = line.strip()
    if len(line) >= LONGEST_LINE:
        problem = f"it has more than {LONGEST_LINE} characters, and is no line of a recording"
        raise RecordingError(f"line {number}: {problem}")
    if line and not line.startswith("#"):
        raise RecordingError(
            f"line {number}: it has no time and sender, as in `HEX  # 0.5 s, NAME: ...`, "
            "and other lines have"
        )
    found = _BEGAN.fullmatch(line)
    if found is None:
        return began
    day, part, zone = found.groups()
    try:
        return datetime.strptime(f"{day} {zone}", "%Y-%m-%d %H:%M:%S %z").timestamp() + float(
            part or 0
        )
    except ValueError:  # the 31st of February
        return began


def _sender(who: str, number: int, direction: Direction | None) -> tuple[str | None, bool]:
    """Return who sent a line, None for either, and whether it was noise. Raises RecordingError."""
    whose, _, last = who.rpartition(" ")
    if is_noise := last == NOISE:
        # A line without a sender came to this end: what a client sends is never noise.
        who = whose or RECEIVED.sender
    if who in SENDERS:
        return who, is_noise
    if who == EITHER:
        return (None if direction is None else direction.sender), is_noise
    known = ", ".join([*SENDERS, EITHER, NOISE])
    raise RecordingError(f"line {number}: {who!r} is none of those who send: {known}")


def _events(data: bytes, sender: str | None, what: str, *, is_noise: bool) -> list[Event]:
    """Return the events of a line's bytes, as its sender's: one, or more if lines were joined.

    Bytes recorded as noise stay noise, even if they would be a message by themselves; save for a
    frame whose command was not known then.
    """
    ways: Sequence[Direction | None] = [None] if sender is None else WAYS[sender]
    for way in () if is_noise else ways:
        message: Any = table_for(way).find(data)
        if message is not None:
            return [message]
    # Of several ends that it may have been sent to, to the one that understands most of it.
    events = min((_streamed(data, way) for way in ways), key=_noise_in)
    if not is_noise:
        return events
    reason = _REASONS.get(what)
    if reason is Reason.UNKNOWN_COMMAND and len(events) == 1 and type(events[0]) is not Noise:
        return events
    reasons = [event.reason for event in events if isinstance(event, Noise)]
    return [Noise(data, reason or (reasons or [Reason.BAD_HEADER])[0])] if data else []


def _streamed(data: bytes, direction: Direction | None) -> list[Event]:
    decoder = StreamDecoder(direction)
    return [*decoder.feed(data), *decoder.flush()]


def _noise_in(events: Iterable[Event]) -> int:
    return sum(len(event.data) for event in events if isinstance(event, Noise))
