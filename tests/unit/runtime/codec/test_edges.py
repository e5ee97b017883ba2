"""Edges that mutation of the code has shown to be untested; see docs/testing.md."""

import pytest
from framegen.language.values import Citation, Direction
from framegen.model.codec import NotAFrame, decode, encode
from framewire.frame.pluralize import describe_range

from tests.factories import BUSSERVO, DEMO, compiled_file, data_of, layout_of
from tests.in_turn import in_turn
from tests.mutations.places import GONE, having


def test_five_numbers_are_too_many_to_be_listed() -> None:
    numbers = (range(4), range(5), range(0, 10, 2))
    assert [*map(describe_range, numbers)] == ["0, 1, 2, 3", "0..4", "0, 2, 4 .. 8"]


def test_a_citation_without_a_place_is_its_source() -> None:
    assert str(Citation("vendor", "")) == "vendor"


def test_a_bare_number_in_a_list_has_the_name_of_the_list() -> None:
    items = compiled_file(BUSSERVO).model.messages["ServoUnload"].items
    assert items is not None
    assert [field.name for field in items.fields] == ["servo_ids"]
    assert items.field is items.fields[0].field


def test_a_list_without_declared_counts_may_be_empty() -> None:
    data = having(data_of(BUSSERVO), {"messages.ServoUnload.fields.servo_ids.count": GONE})
    items = layout_of(data).messages["ServoUnload"].items
    assert items is not None
    assert (items.low, items.high) == (0, 252)


def test_a_length_above_127_is_no_negative_number() -> None:
    layout = compiled_file(BUSSERVO).model
    values = {"servo_ids": [*range(252)]}
    frame = encode(layout.messages["ServoUnload"], values)
    assert frame[2] == 255
    assert decode(layout, Direction("host", "controller"), frame).values == values


@in_turn(
    "text, expected",
    lambda: [
        ("C3", "a frame begins C3 5A A5"),
        ("C3 5B", "a frame begins C3 5A A5"),
        ("C3 5A A5 10 00", "the shortest frame has 6 bytes"),
        ("C3 5A A5 20 00 00", "no message gateway -> station has the kind 32"),
        ("C3 5A A5 11 00 01", "StationRead has a size of 0, not 1"),
        ("C3 5A A5 10 00 06", "a size of 6 makes 12 bytes"),
        ("C3 5A A5 11 00 00 00", "a size of 0 makes 6 bytes"),
        ("C3 5A A5 10 00 06 00 00 02 01 00 00", "a size of 6 makes vent_count 1, not 2"),
        ("C3 5A A5 10 00 06 00 00 01 01 03 85", "vents[0].angle is 901, outside -900..900"),
    ],
)
def test_a_refused_frame_is_described_in_full(text: str, expected: str) -> None:
    layout = compiled_file(DEMO).model
    with pytest.raises(NotAFrame) as refused:
        decode(layout, Direction("gateway", "station"), bytes.fromhex(text))
    assert refused.value.expected == expected
