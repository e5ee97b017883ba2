"""Edges that mutation of the code has shown to be untested; see docs/testing.md."""

import busservo
import pytest
from busservo import (
    DecodeError,
    EncodeError,
    Message,
    Noise,
    Reason,
    ServoMove,
    StreamDecoder,
)
from framegen.language.values import Citation, Direction
from framegen.model.codec import NotAFrame, decode, encode
from framegen.model.model import derive
from framewire.frame.pluralize import describe_range

from tests.cases import CASES
from tests.factories import BUSSERVO, DEMO, compiled_file, compiled_of, data_of, layout_of
from tests.in_turn import in_turn
from tests.mutations.places import GONE, having

COMMANDS = ", ".join(map(str, sorted({kind.COMMAND for kind in busservo.MESSAGES})))


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
    spec = compiled_of(data).read
    assert spec is not None
    repeat = derive(spec).messages["ServoPositions"].items
    assert repeat is not None
    assert [(field.name, field.at) for field in repeat.fields] == [
        ("servo_id", 0),
        ("position", 1),
        ("load", 3),
    ]


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


# ------------------------------------------------------------------ the library


def test_the_class_of_all_messages_says_what_to_do_instead() -> None:
    with pytest.raises(TypeError) as unmade:
        Message()
    assert str(unmade.value) == (
        "Message is what all messages are: make one of its subclasses instead"
    )
    with pytest.raises(TypeError) as unread:
        Message.decode(b"\x55\x55\x02\x07")
    assert str(unread.value) == (
        "Message is what all messages are: decode with one of its subclasses, "
        "or with the function `decode` of this package"
    )


def test_what_differs_is_spread_over_a_table() -> None:
    """Frames that are equal in both directions, and noise of one reason and another, too."""
    messages = [case.message for case in CASES]
    assert len({*map(hash, messages)}) == len({*messages})
    noise = [Noise(data, reason) for data in (b"", b"\x55", b"\0") for reason in Reason]
    assert len({*map(hash, noise)}) == len(noise)


@pytest.mark.parametrize(
    ("given", "said"),
    [
        (2**128 - 1, f"{2**128 - 1} is outside 0..65535"),
        (2**128, "an integer of 129 bits is outside 0..65535"),
        ("x" * 58, f"'{'x' * 58}' is not a whole number, but a str"),
        ("x" * 59, f"'{'x' * 56}... is not a whole number, but a str"),
        # Python refuses to write out a number of so many digits.
        ([10**5000], "a list is not a whole number, but a list"),
        (..., "Ellipsis is not a whole number, but an ellipsis"),
        (None, "None is not a whole number, but nothing"),
    ],
)
def test_a_value_is_shown_as_far_as_it_helps(given: object, said: str) -> None:
    with pytest.raises(EncodeError) as refused:
        ServoMove(given, [(1, 800)])  # type: ignore[arg-type]
    assert str(refused.value) == f"time_ms: {said}"


class OldTruth:
    """A truth value as NumPy had it before its version 2: a number, too."""

    dtype = "bool"

    def __index__(self) -> int:
        return 1

    def __repr__(self) -> str:
        return "True"


def test_a_truth_value_that_is_a_number_is_refused() -> None:
    with pytest.raises(EncodeError) as refused:
        ServoMove(OldTruth(), [(1, 800)])  # type: ignore[arg-type]
    assert str(refused.value) == "time_ms: True is a truth value, not a whole number"


@pytest.mark.parametrize(
    ("frame", "said"),
    [
        ("55", "a frame begins 55 55"),
        ("55 55", "the shortest frame has 4 bytes"),
        ("55 55 02 63", f"the command is 99, and only {COMMANDS} can be here"),
        (
            "55 55 06 06 08 01 00",
            "the length is 6, and must be 5 (ActionGroupRun, ActionGroupStarted)",
        ),
        (
            "55 55 02 15",
            (
                "the length is 2, and must be 4..255 (ServoPositionsRead) "
                "or 3, 6, 9 .. 255 (ServoPositions)"
            ),
        ),
        ("55 55 02 07 00", "ActionGroupStop with this length has 4 bytes, not 5"),
    ],
)
def test_the_problem_of_a_refused_frame_is_complete(frame: str, said: str) -> None:
    with pytest.raises(DecodeError) as refused:
        busservo.decode(bytes.fromhex(frame), None)
    assert refused.value.problem == said


def test_each_unknown_frame_is_counted() -> None:
    decoder = StreamDecoder(None)
    decoder.feed(bytes.fromhex("55 55 03 01 2A 55 55 03 02 2A"))
    assert decoder.counters.unknown_frames == 2


def test_bytes_of_a_class_of_ones_own_are_bytes() -> None:
    class Own(bytes):
        __slots__ = ()

    frame = ServoMove(1000, [(1, 800)]).encode()
    assert busservo.decode(Own(frame), None) == ServoMove(1000, [(1, 800)])
    assert StreamDecoder(None).feed(Own(frame)) == [ServoMove(1000, [(1, 800)])]


def test_lazily_imported_names_are_listed() -> None:
    assert {*busservo.__all__} <= {*dir(busservo)}
    slip = "Contoller"
    with pytest.raises(AttributeError, match=f"has no attribute '{slip}'"):
        getattr(busservo, slip)
