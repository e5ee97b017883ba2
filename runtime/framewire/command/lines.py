"""Lines of text for the events of a line: time, sender, meaning and bytes."""

from __future__ import annotations

import time

from ..codec.event_bytes import bytes_of
from ..frame.bytes_like import format_hex
from ..recording.file import EITHER, NOISE
from .colour import painted, takes_colour
from .console import visible, write_as_it_is
from .events import UNKNOWN, in_json, in_words, sender_of

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import TextIO

    from ..codec.noise import Noise
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message

TIMES = ("absolute", "delta", "zero")
_OF_SENDERS = ("cyan", "green")
_COLOURS = {EITHER: "yellow", UNKNOWN: "magenta", NOISE: "red"}


class Lines:
    """One printed line for each event, at once, so that a pipe has it when it comes.

    `times` is one of TIMES. Times are given in seconds, of the day's clock for `absolute` and of
    any clock for the others.
    """

    def __init__(
        self, screen: TextIO, codec: ProtocolCodec, times: str = "zero", *, as_json: bool = False
    ) -> None:
        self._screen = screen
        self._codec = codec
        self._times = times
        self._began = self._last = 0.0
        self._json = as_json
        self._colour = takes_colour(screen) and not as_json
        self._colours = dict(zip(codec.senders, _OF_SENDERS, strict=False)) | _COLOURS
        self.count = 0

    def begin(self, now: float) -> None:
        """Set the time from which on times count."""
        self._began = self._last = now

    def show(self, event: Message | Noise, direction: Direction | None, now: float) -> None:
        """Print an event that was received in a direction; None for a line with both."""
        self.count += 1
        since = {"absolute": 0.0, "delta": self._last, "zero": self._began}[self._times]
        at, self._last = now - since, now
        if self._json:
            text = self._as_json(event, direction, at)
        else:
            text = self._as_text(event, direction, at)
        write_as_it_is(self._screen, f"{text}\n")
        self._screen.flush()

    def _as_text(self, event: Message | Noise, direction: Direction | None, at: float) -> str:
        when = time_of_day(at) if self._times == "absolute" else f"{at:12.6f}"
        line = in_line(event, direction, self._codec)
        if self._colour:
            who = sender_of(event, direction, self._codec)
            line = painted(f"{who:10}", self._colours[who]) + line[max(10, len(who)) :]
        return f"{when:>12}  {line}"

    def _as_json(self, event: Message | Noise, direction: Direction | None, at: float) -> str:
        return f'{{"time": {round(at, 6)}, {in_json(event, direction, self._codec)[1:]}'


def in_line(event: Message | Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    """Return the text of an event, behind its time or place: sender, meaning and bytes."""
    who, what = sender_of(event, direction, codec), in_words(event, direction, codec)
    return f"{who:10}  {visible(what)} | {format_hex(bytes_of(event))}"


def time_of_day(now: float) -> str:
    """Return the time of day, as HH:MM:SS.ffffff."""
    whole, part = divmod(round(now * 1_000_000), 1_000_000)
    return f"{time.strftime('%H:%M:%S', time.localtime(whole))}.{part:06d}"
