"""Lists in either byte order, and in both: this protocol has one, so messages are made here."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from busservo import DecodeError, Direction, EncodeError, Message
from busservo._envelopes import FRAME_ENVELOPE
from framewire.frame.element import Element
from framewire.frame.lists import List
from framewire.frame.little import I16, U16
from framewire.frame.number import ANY_ORDER, I8, U8, Number, order_of

if TYPE_CHECKING:
    from typing_extensions import Self


class BigU16(Number, code="H", order=">"):
    """An unsigned number of two bytes, of which the highest comes first."""

    __slots__ = ()


class Step(Element, tuple[int, int, int, int]):
    """Numbers in both orders, most of them big endian."""

    __slots__ = ()
    __match_args__ = ("low", "tiny", "high", "higher")

    low = U16(0)
    tiny = I8(2)
    high = BigU16(3)
    higher = BigU16(5, high=0x1FF)


class Steps(Message):
    """A message with a number in each order in front of a list."""

    __slots__ = ()
    __match_args__ = ("big", "little", "steps")

    COMMAND = 0x31
    DIRECTION = Direction.HOST_TO_CONTROLLER
    LENGTHS = range(7, 22, 7)
    FRAME = FRAME_ENVELOPE
    IDS = (0x31,)

    big = BigU16(4, high=0x1FF)
    little = U16(6, high=0x1FF)
    count = U8(8)
    steps = List(9, Step, 0, 2, count=count)

    def __new__(cls, big: int, little: int, steps: list[tuple[int, int, int, int]]) -> Self:
        cls.SHAPE.check(big, little)
        flat = cls.steps.packed(steps)
        values = (len(flat) + 7, 0x31, cls.big.struct.pack(big), little, len(flat) // 7, flat)
        return cls._packed(f"<2sBB2sHB{len(flat)}s", b"\x55\x55", *values)


def test_the_order_is_that_of_most_numbers() -> None:
    assert order_of([]) == order_of([U8(), I8()]) == ANY_ORDER
    assert order_of([U8(), U16(), I16(), BigU16()]) == "<"
    assert order_of([BigU16(), U16(), U8(), BigU16()]) == ">"
    assert Steps.steps.order == ">"


def test_each_number_is_written_and_read_in_its_own_order() -> None:
    made = Steps(0x0102, 0x0103, [(0x0104, -2, 0x0506, 0x0107), (1, 2, 3, 4)])
    frame = made.encode()
    assert frame[4:].hex(" ") == "01 02 03 01 02 04 01 fe 05 06 01 07 01 00 02 00 03 00 04"
    read = Steps.decode(frame)
    assert (read.big, read.little) == (0x0102, 0x0103)
    assert read.steps == ((0x0104, -2, 0x0506, 0x0107), (1, 2, 3, 4))


@pytest.mark.parametrize("at", [4, 7, 14])
def test_what_is_out_of_range_is_found_in_either_order(at: int) -> None:
    frame = bytearray(Steps(1, 1, [(1, 1, 1, 1)]).encode())
    frame[at] = 2
    with pytest.raises(DecodeError, match=r"is 51[23], outside 0\.\.511"):
        Steps.decode(bytes(frame))


def test_what_is_given_is_checked_in_either_order() -> None:
    for big, little, higher in [(0x200, 1, 1), (1, 0x200, 1), (1, 1, 0x200)]:
        with pytest.raises(EncodeError, match=r"512 is outside 0\.\.511"):
            Steps(big, little, [(1, 1, 1, higher)])


@pytest.mark.parametrize("number", [U16(), BigU16()])
def test_a_list_in_one_order_is_read_at_once(number: Number) -> None:
    listed = List(4, number, 0, 9)
    assert listed.is_read
    data = listed.packed([1, 0x0203])
    assert data == b"".join(map(number.struct.pack, (1, 0x0203)))
    assert listed.numbers(b"head" + data) == (1, 0x0203)
