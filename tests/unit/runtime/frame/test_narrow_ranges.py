"""Ranges narrower than their types: this protocol has none, so a message with one is made here."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from busservo import DecodeError, Direction, EncodeError, Message, Noise, Reason, StreamDecoder
from busservo._envelopes import FRAME_ENVELOPE, HEADS
from busservo._library import CODEC
from framewire.frame.element import Element
from framewire.frame.lists import List
from framewire.frame.little import U16
from framewire.frame.number import U8
from framewire.frame.table import Table, largest_of

from tests.strategies import bytes_of, joined, noise, single_bytes

if TYPE_CHECKING:
    from typing_extensions import Self


class Turn(Element, tuple[int, int]):
    """The angle of one dial."""

    __slots__ = ()
    __match_args__ = ("dial", "degrees")

    dial = U8(0, low=1, high=4)
    degrees = U16(1, high=359)


class DialsTurn(Message):
    """A message that turns some of four dials, with a force of 1 to 9."""

    __slots__ = ()
    __match_args__ = ("force", "turns")

    COMMAND = 0x30
    DIRECTION = Direction.HOST_TO_CONTROLLER
    LENGTHS = range(7, 17, 3)
    FRAME = FRAME_ENVELOPE
    IDS = (0x30,)

    force = U8(4, low=1, high=9)
    dial_count = U8(5)
    turns = List(6, Turn, 1, 4, count=dial_count)

    def __new__(cls, force: int, turns: list[tuple[int, int]]) -> Self:
        cls.SHAPE.check(force)
        flat = cls.turns.packed(turns)
        length, count = len(flat) + 4, len(flat) // 3
        layout = f"<2sBBBB{len(flat)}s"
        return cls._packed(layout, b"\x55\x55", length, 0x30, force, count, flat)


class LampDim(Message):
    """A message that dims the lamp, in percent: a range, and no list."""

    __slots__ = ()

    COMMAND = 0x31
    DIRECTION = Direction.HOST_TO_CONTROLLER
    LENGTHS = range(3, 4)
    FRAME = FRAME_ENVELOPE
    IDS = (0x31,)

    percent = U8(4, high=100)


GOOD = bytes.fromhex("55 55 0A 30 09 02 01 00 00 04 67 01")

# Bytes in the shape of the frame, with one value after another out of its range.
BAD = (
    ("55 55 0A 30 00 02 01 00 00 04 67 01", 4, "force is 0, outside 1..9"),
    ("55 55 0A 30 0A 02 01 00 00 04 67 01", 4, "force is 10, outside 1..9"),
    ("55 55 0A 30 09 02 00 00 00 04 67 01", 6, "turns[0].dial is 0, outside 1..4"),
    ("55 55 0A 30 09 02 01 68 01 04 67 01", 7, "turns[0].degrees is 360, outside 0..359"),
    ("55 55 0A 30 09 02 01 00 00 05 67 01", 9, "turns[1].dial is 5, outside 1..4"),
    ("55 55 0A 30 09 02 01 00 00 04 FF FF", 10, "turns[1].degrees is 65535, outside 0..359"),
)

each_bad = pytest.mark.parametrize(("frame", "offset", "problem"), BAD)


def decoder_of_dials() -> StreamDecoder:
    """Return a decoder that knows this message alone."""
    decoder = StreamDecoder(Direction.HOST_TO_CONTROLLER)
    decoder._table = Table([DialsTurn], largest_of([DialsTurn]), HEADS)
    decoder._noise = CODEC.noise_lane(decoder._table)
    return decoder


def test_a_range_holds_its_ends() -> None:
    message = DialsTurn(force=9, turns=[(1, 0), (4, 359)])

    assert message.encode() == GOOD
    assert DialsTurn.decode(GOOD) == message
    for chunks in ([GOOD], single_bytes(GOOD), [GOOD[:11], GOOD[11:] + b"\x55"]):
        decoder = decoder_of_dials()
        assert [event for chunk in chunks for event in decoder.feed(chunk)] == [message]


@pytest.mark.parametrize(
    ("force", "turns", "text"),
    [
        (0, [(1, 0)], "force: 0 is outside 1..9"),
        (10, [(1, 0)], "force: 10 is outside 1..9"),
        (1, [(1, 0), (5, 0)], "turns[1].dial: 5 is outside 1..4"),
        (1, [(1, 360)], "turns[0].degrees: 360 is outside 0..359"),
    ],
)
def test_a_value_out_of_range_is_refused(
    force: int, turns: list[tuple[int, int]], text: str
) -> None:
    with pytest.raises(EncodeError) as caught:
        DialsTurn(force, turns)

    assert str(caught.value) == text


@each_bad
def test_a_frame_out_of_range_is_refused(frame: str, offset: int, problem: str) -> None:
    with pytest.raises(DecodeError) as caught:
        DialsTurn.decode(bytes.fromhex(frame))

    assert (caught.value.reason, caught.value.offset) == (Reason.OUT_OF_RANGE, offset)
    assert caught.value.problem == problem


def test_a_message_without_a_list_has_ranges_too() -> None:
    assert LampDim.decode(bytes.fromhex("55 55 03 31 64")).encode()[4] == 100
    with pytest.raises(DecodeError) as caught:
        LampDim.decode(bytes.fromhex("55 55 03 31 65"))

    assert str(caught.value) == "out of range at byte 4: percent is 101, outside 0..100"


@each_bad
def test_a_frame_out_of_range_is_noise_that_hides_nothing(
    frame: str, offset: int, problem: str
) -> None:
    line = bytes.fromhex(frame) + GOOD

    for chunks in ([line], single_bytes(line)):
        decoder = decoder_of_dials()
        *before, message = [event for chunk in chunks for event in decoder.feed(chunk)]
        assert message == DialsTurn.decode(GOOD)
        assert joined(before) == [noise(frame, Reason.OUT_OF_RANGE)]


@each_bad
def test_a_frame_out_of_range_hides_no_frame_within(frame: str, offset: int, problem: str) -> None:
    # The last dial and degrees are the beginning of what follows.
    line = bytes.fromhex(frame)[:-3] + GOOD
    decoder = decoder_of_dials()

    events = decoder.feed(line) + decoder.flush()

    assert bytes_of(events) == line
    if offset < 9:
        assert isinstance(events[0], Noise)
        assert events[-1] == DialsTurn.decode(GOOD)
