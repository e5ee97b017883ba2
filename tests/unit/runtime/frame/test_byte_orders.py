"""The byte order of numbers: that of most of them; in either one, a list is read at once."""

import pytest
from framewire.frame import big, little
from framewire.frame.lists import List
from framewire.frame.number import ANY_ORDER, I8, U8, Number, order_of


def test_the_order_is_that_of_most_numbers() -> None:
    assert order_of([]) == order_of([U8(), I8()]) == ANY_ORDER
    assert order_of([U8(), little.U16(), little.I16(), big.U16()]) == "<"
    assert order_of([big.U16(), little.U16(), U8(), big.U16()]) == ">"


@pytest.mark.parametrize("number", [little.U16(), big.U16()])
def test_a_list_in_one_order_is_read_at_once(number: Number) -> None:
    listed = List(4, number, 0, 9)
    assert listed.is_read
    data = listed.packed([1, 0x0203])
    assert data == b"".join(map(number.struct.pack, (1, 0x0203)))
    assert listed.numbers(b"head" + data) == (1, 0x0203)
