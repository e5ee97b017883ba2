"""Edges that mutation of the code has shown to be unguarded; docs/testing.md tells how."""

import pytest
from busservo import DecodeError, EncodeError, Reason, ServoMove
from framegen.codec import NotAFrame, decode, describe_range, encode
from framegen.layout import derive
from framegen.values import Citation, Direction

from tests.specimens import BUSSERVO, DEMO, data_of, layout_of, loaded_of


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        (range(4), "0, 1, 2, 3"),
        (range(5), "0..4"),
        (range(0, 10, 2), "0, 2, 4 .. 8"),
    ],
)
def test_five_numbers_are_too_many_to_be_listed(numbers: range, words: str) -> None:
    assert describe_range(numbers) == words


def test_a_citation_without_a_place_is_its_source() -> None:
    assert str(Citation("vendor", "")) == "vendor"


def test_an_error_keeps_what_it_was_made_of() -> None:
    with pytest.raises(EncodeError) as refused:
        ServoMove(70000, [(1, 800)])
    assert refused.value.args == ("time_ms", 70000, "70000 is outside 0..65535")

    with pytest.raises(DecodeError) as unread:
        ServoMove.decode(b"\x55\x56")
    expected = "a frame begins 55 55"
    assert unread.value.args == (Reason.BAD_HEADER, 1, expected)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        ("55 55", "bytes, bytearray or memoryview expected, not str; bytes.fromhex() reads hex"),
        (7, "bytes, bytearray or memoryview expected, not int"),
    ],
)
def test_what_is_no_bytes_is_named(given: object, said: str) -> None:
    with pytest.raises(TypeError) as refused:
        ServoMove.decode(given)  # type: ignore[arg-type]
    assert str(refused.value) == said


def test_each_field_of_an_element_stands_behind_the_one_before() -> None:
    data = data_of(BUSSERVO)
    message = data["messages"]["ServoPositions"]
    message["fields"]["positions"]["fields"]["load"] = {"type": "u8", "about": "Its load."}
    message["length"] = "4 * servo_count + 3"
    spec = loaded_of(data).spec
    assert spec is not None
    repeat = derive(spec).messages["ServoPositions"].repeat
    assert repeat is not None
    assert [(field.name, field.offset) for field in repeat.fields] == [
        ("servo_id", 0),
        ("position", 1),
        ("load", 3),
    ]


def test_a_bare_number_in_a_list_has_the_name_of_the_list() -> None:
    repeat = layout_of(data_of(BUSSERVO)).messages["ServoUnload"].repeat
    assert repeat is not None
    assert [field.name for field in repeat.fields] == ["servo_ids"]
    assert repeat.field is repeat.fields[0].field


def test_a_list_without_declared_counts_may_be_empty() -> None:
    data = data_of(BUSSERVO)
    del data["messages"]["ServoUnload"]["fields"]["servo_ids"]["count"]
    repeat = layout_of(data).messages["ServoUnload"].repeat
    assert repeat is not None
    assert (repeat.low, repeat.high) == (0, 252)


def test_a_length_above_127_is_no_negative_number() -> None:
    layout = layout_of(data_of(BUSSERVO))
    values = {"servo_ids": [*range(252)]}
    frame = encode(layout, layout.messages["ServoUnload"], values)
    assert frame[2] == 255
    assert decode(layout, Direction("host", "controller"), frame).values == values


@pytest.mark.parametrize(
    ("text", "expected"),
    [
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
def test_what_is_no_frame_is_told_in_full(text: str, expected: str) -> None:
    layout = layout_of(data_of(DEMO))
    with pytest.raises(NotAFrame) as refused:
        decode(layout, Direction("gateway", "station"), bytes.fromhex(text))
    assert refused.value.expected == expected
