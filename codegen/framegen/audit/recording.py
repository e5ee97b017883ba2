"""What a recording holds: stretches of bytes, each with its sender and its time where it says so.

A recording has a line for each event, as `recording_file` writes it: those of a client, a monitor,
a doctor and a run of `framegen conform` alike. Hex as text and raw bytes are one stretch each.
"""

from __future__ import annotations

import re
from bisect import bisect_right
from dataclasses import dataclass, replace
from itertools import accumulate
from typing import TYPE_CHECKING

from framewire.codec.hextext import HexError, read_hex
from framewire.recording.file import EITHER, NOISE, QUIET
from framewire.recording.form import TIMED_LINE, LogError, is_text, log_lines, text_of

from framegen.cases.malformed import malformed_in
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator

    from framegen.model.roles import Roles

_RAW = "raw bytes need --input raw"
# How a doctor's report says what board it is of, and at which rate it goes on.
_DEVICE, _NOT_STATED = "# device: ", "not stated"
_OPENED = re.compile(r"# opened, at (\S+) baud")
# A recording begins anew, as where two were put into one file.
_BEGUN = "# recorded of "
# Noise that came within so many seconds is one piece: a recorder waits no longer for the rest.
_GAP = 0.05


@dataclass(frozen=True, slots=True)
class Stretch:
    """Bytes of a line, after which it was quiet or another end sent.

    `sender` is None where it is not known, and `at` where there are no times. `refused` is why its
    recorder took them for no message, and empty where it did not. What is `malformed` was sent so
    on purpose, and a `probe` at a rate, `baud`, at which the device said nothing. What is
    `backward` has a time before that of the line before. `joined` are the places of pieces, each
    with where it begins.
    """

    data: bytes
    place: str
    sender: str | None = None
    at: float | None = None
    refused: str = ""
    malformed: bool = False
    probe: bool = False
    backward: bool = False
    baud: str = ""
    joined: tuple[tuple[int, str], ...] = ()

    def place_at(self, at: int) -> str:
        """Name the place of a byte of it."""
        if self.at is None:
            return f"byte {int(self.place.removeprefix('byte ')) + at}"
        after = bisect_right(self.joined, at, key=lambda piece: piece[0])
        return self.joined[after - 1][1] if after else self.place


@dataclass(frozen=True, slots=True)
class Recording:
    """The content of a file: its name, and its stretches in order.

    `device` is what a doctor's report says that it is of; empty where nothing says so.
    """

    name: str
    stretches: tuple[Stretch, ...]
    device: str = ""

    @property
    def size(self) -> int:
        """How many bytes it holds."""
        return sum(len(stretch.data) for stretch in self.stretches)


def read_recording(
    name: str, content: bytes, ends: Collection[str], roles: Roles, form: str = "auto"
) -> Recording:
    """Read the content of a file in one of FORMS. Raises Unusable, with the line.

    `ends` are those who may send. Noise of nobody's came from the device.
    """
    if form == "raw" or (form == "auto" and not is_text(content, ended=True)):
        raw = Stretch(content, "byte 0")
        return Recording(name, (raw,) if content else ())
    lines = text_of(content).split("\n")
    try:
        if any(map(TIMED_LINE.match, lines)):
            found = [*_joined(_recorded(lines, ends, roles))]
            return Recording(name, tuple(_probed(found, roles)), device=_device(lines))
        return Recording(name, tuple(_plain(lines)))
    except _Line as error:
        hint = _RAW if form == "auto" and not error.hint else error.hint
        raise Unusable(f"{name}, line {error.number}: {error}", hint=hint) from None


def _device(lines: list[str]) -> str:
    found = (line.removeprefix(_DEVICE).strip() for line in lines if line.startswith(_DEVICE))
    return next((each for each in found if each != _NOT_STATED), "")


class _Line(ValueError):  # noqa: N818 - where it is
    def __init__(self, number: int, problem: str, hint: str = "") -> None:
        super().__init__(problem)
        self.number = number
        self.hint = hint


def _plain(lines: list[str]) -> Iterator[Stretch]:
    """Yield hex as text, in which the line may have gone quiet."""
    data, size = b"", 0
    log = log_lines("\n".join(lines))
    for number, line in enumerate(lines, 1):
        if line.strip() == QUIET and data:
            yield Stretch(data, f"byte {size}")
            size, data = size + len(data), b""
        try:
            data += _hex(line if log is None else log.hex_of(line), number)
        except LogError as error:
            raise _Line(number, str(error)) from None
    if data:
        yield Stretch(data, f"byte {size}")


def _hex(text: str, number: int) -> bytes:
    try:
        return read_hex(text)
    except HexError as error:
        raise _Line(number, str(error)) from None


@dataclass
class _Notes:
    """What the comments of a recording say of the lines that follow."""

    title: str = ""
    baud: str = ""
    last: float = 0.0

    def add(self, line: str) -> None:
        """Take a line that is a comment, or empty."""
        opened = _OPENED.fullmatch(line)
        if opened is not None:
            self.baud = opened[1]
        if line.startswith(_BEGUN):
            self.title, self.baud, self.last = "", "", 0.0
        elif line:
            self.title = line.removeprefix("# ")


def _recorded(lines: list[str], ends: Collection[str], roles: Roles) -> Iterator[Stretch | None]:
    """Yield the lines of a recording; None for one where the line went quiet."""
    notes = _Notes()
    for number, line in enumerate(lines, 1):
        found = TIMED_LINE.match(line)
        if found is None:
            text = line.strip()
            if text == QUIET:
                yield None
            elif text and not text.startswith("#"):
                problem = "it has no time and sender, as in `HEX  # 0.5 s, NAME: ...`"
                raise _Line(number, f"{problem}, and other lines have")
            else:
                notes.add(text)
            continue
        data = _hex(found["hex"], number)
        who, _, last = found["who"].rpartition(" ")
        is_noise = last == NOISE
        sender = (who or roles.device) if is_noise else found["who"]
        if sender not in (*ends, EITHER):
            known = ", ".join([*ends, EITHER, NOISE])
            hint = f"those who send are {known}: is it a recording of this protocol?"
            raise _Line(number, f"{sender!r} is none of those who send", hint)
        at, what = float(found["at"]), found["what"].strip()
        is_backward, notes.last = at < notes.last, at
        yield Stretch(
            data,
            f"line {number}",
            None if sender == EITHER else sender,
            at,
            (what or NOISE) if is_noise else "",
            # Only a run of conform sends such, and says so before it does.
            malformed=is_noise and sender == roles.client and what in malformed_in(notes.title),
            backward=is_backward,
            baud=notes.baud,
        )


def _joined(found: Iterator[Stretch | None]) -> Iterator[Stretch]:
    """Join noise of one sender and reason, of which a recorder has a line for each piece it read.

    What came later than a recorder waits for the rest of a frame stays apart.
    """
    held: list[Stretch] = []
    for each in found:
        if held and (each is None or not _goes_on(held[-1], each)):
            yield from _whole(held)
            held.clear()
        if each is not None:
            held.append(each)
    yield from _whole(held)


def _whole(pieces: list[Stretch]) -> Iterator[Stretch]:
    """Yield what pieces are together, unless that is nothing."""
    data = b"".join(each.data for each in pieces)
    if len(pieces) > 1 and data:
        begins = accumulate((len(each.data) for each in pieces), initial=0)
        joined = tuple(zip(begins, (each.place for each in pieces), strict=False))
        yield replace(pieces[0], data=data, joined=joined)
    elif data:
        yield pieces[0]


def _goes_on(held: Stretch, each: Stretch) -> bool:
    """Tell whether noise goes on in the next line."""
    if not held.refused or held.malformed or each.malformed or held.at is None or each.at is None:
        return False
    is_alike = (held.sender, held.refused) == (each.sender, each.refused)
    return is_alike and 0 <= each.at - held.at <= _GAP + 1e-9


def _probed(found: list[Stretch], roles: Roles) -> Iterator[Stretch]:
    """Mark what was sent at rates at which nothing came, where something came at another."""
    heard = {
        each.baud for each in found if each.sender not in (None, roles.client) and not each.refused
    }
    for each in found:
        is_probe = bool(each.baud and heard) and each.baud not in heard
        yield replace(each, probe=True) if is_probe and each.sender == roles.client else each
