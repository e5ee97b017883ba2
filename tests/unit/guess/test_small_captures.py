"""What a few frames decide is true of them: two header bytes and a checksum of a byte behind them.

A small capture is what newcomers have. What it does not show is undecided, and not absent.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import reduce
from operator import xor
from random import Random

import pytest
from framegen.guess.capture import Capture
from framegen.guess.guess import Guess, guess

SUMS: dict[str, Callable[[bytes], int]] = {
    "sum": lambda data: sum(data) & 0xFF,
    "inverted sum": lambda data: ~sum(data) & 0xFF,
    "xor": lambda data: reduce(xor, data),
}


def with_length(chance: Random) -> bytes:
    size = chance.randint(1, 5)
    return bytes([size]) + chance.randbytes(size)


def small_numbers(chance: Random) -> bytes:
    return bytes([chance.randint(1, 2), 0, chance.randrange(40)])


BODIES: dict[str, Callable[[Random], bytes]] = {
    "of one size": lambda chance: bytes([chance.randint(1, 4)]) + chance.randbytes(2),
    "of small numbers": small_numbers,
    "with a length": with_length,
    "of any size": lambda chance: (
        bytes([chance.randint(1, 3)]) + chance.randbytes(chance.randint(1, 3))
    ),
}


@dataclass(frozen=True)
class Line:
    """A line that was recorded: its frames, and how many bytes of the first were missed."""

    header: bytes
    method: str
    frames: Sequence[bytes]
    missed: int = 0
    is_text: bool = False

    @property
    def capture(self) -> Capture:
        """The recording, raw or as text with a frame a line."""
        data = b"".join(self.frames)[self.missed :]
        return Capture(data, tuple(self.frames) if self.is_text else (data,))

    @property
    def places(self) -> set[tuple[int, int]]:
        """Where frames begin and end in it."""
        found, at = set(), -self.missed
        for frame in self.frames:
            found.add((at, at + len(frame)))
            at += len(frame)
        return found


def line(chance: Random, body: str, *, missed: bool = False) -> Line:
    """Return a small recording of a made-up protocol."""
    common = [0x09, 0x55, 0xAA, 0x00, chance.randrange(256)]
    header = bytes(chance.choice(common) for _ in range(2))
    method, left_out = chance.choice([*SUMS]), chance.randrange(3)
    frames = []
    for _ in range(chance.choice((3, 4, 6, 8, 12, 20))):
        frame = header + BODIES[body](chance)
        frames.append(frame + bytes([SUMS[method](frame[left_out:])]))
    text = chance.random() < 0.3 and not missed
    return Line(header, method, frames, chance.randrange(1, 5) if missed else 0, text)


def wrong(found: Guess, line: Line) -> list[str]:
    """Return what is said to be decided, and is not so."""
    decided = {each.about: each.says for each in found.conclusions if each.is_decided}
    places = {*found.reading.framing.places}
    begun = found.reading.framing.begun
    problems: list[str] = []
    if "that begin" in decided.get("frames", "") and not places <= line.places:
        problems.append(decided["frames"])
    if "frames" in decided and len(places) < 0.9 * len(line.frames) - 2:
        problems.append(f"of {len(line.frames)}: {decided['frames']}")
    if "constants" in decided and not begun.startswith(line.header):
        problems.append(decided["constants"])
    if "checksum" in decided and line.method not in decided["checksum"]:
        problems.append(decided["checksum"])
    return problems


@pytest.mark.parametrize("missed", [False, True], ids=["from its beginning", "from within a frame"])
@pytest.mark.parametrize("body", BODIES)
def test_what_a_few_frames_decide_is_right(body: str, missed: bool) -> None:
    chance = Random(f"{body} {missed}")  # noqa: S311 - the same each time
    for _ in range(6):
        recorded = line(chance, body, missed=missed)
        found = guess(recorded.capture)
        if found is not None:
            assert wrong(found, recorded) == [], [each.hex(" ") for each in recorded.frames]


FRAMES = ["09 A5 01 07 00 B6", "09 A5 02 31 01 E2", "09 A5 01 1C 02 CD", "09 A5 03 20 00 D1"]


def guessed(*frames: str) -> Guess:
    pieces = tuple(bytes.fromhex(each) for each in frames)
    found = guess(Capture(b"".join(pieces), pieces))
    assert found is not None
    return found


def test_too_few_frames_do_not_show_that_there_is_no_checksum() -> None:
    checksum = guessed(*FRAMES).conclusion("checksum")
    assert (checksum.says, checksum.is_decided) == (
        "4 different frames are too few to tell whether there is one",
        False,
    )
    assert "right for all: the last byte: `sum`, of all from byte 0 on" in checksum.others
    # Of more, it is seen, and so is that there is none.
    more = [(bytes.fromhex(each)[:4], number) for number, each in enumerate(FRAMES * 3)]
    whole = [(start + bytes([number])).hex() for start, number in more]
    summed = [each + bytes([sum(bytes.fromhex(each)) & 0xFF]).hex() for each in whole]
    checksum = guessed(*summed).conclusion("checksum")
    assert checksum.says == "the last byte: `sum`, of all from byte 0 on"
    none = guessed(*(each + other[:2] for each, other in zip(whole, FRAMES[::-1] * 3, strict=True)))
    assert "no method of the catalogue is right" in none.conclusion("checksum").says


def test_frames_that_are_passed_over_leave_all_undecided() -> None:
    # Those of one size follow each other; those between have the same header.
    one, other = "09 A5 01 07 00 B6", "09 A5 02 07 B7"
    found = guessed(*[one, other, other] * 4)
    for each in found.conclusions:
        assert not each.is_decided or len(found.reading.framing.places) == 12, each


def test_a_beginning_that_the_recording_does_not_show_is_not_told_as_one() -> None:
    data = bytes.fromhex("".join(FRAMES * 4))
    found = guess(Capture(data[1:], (data[1:],)))
    assert found is not None
    assert not found.conclusion("constants").is_decided
    assert "begin" not in found.conclusion("frames").says
    assert "that begin 09 A5" in guessed(*FRAMES * 4).conclusion("frames").says
