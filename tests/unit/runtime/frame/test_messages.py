"""Messages as values: how they are made, what they hold, how they compare, and what they refuse."""

import pickle
import pydoc
import weakref
from collections.abc import Callable, Iterator
from enum import IntEnum
from types import MappingProxyType
from typing import Any

import busservo
import lxservo
import numpy as np
import pytest
from busservo import ActionGroupRun, EncodeError, Message, Noise, Reason, ServoMove, ServoTarget
from framewire.explain import refusals
from framewire.frame.element import Element
from framewire.frame.number import U8
from hypothesis import given
from hypothesis import strategies as st

from tests.cases import CASES, CONTROLLER, HOST, BadValue, Case, each_bad_value, each_case
from tests.in_turn import in_turn
from tests.unit.runtime.frame.copies import copies


# --- Making and reading --------------------------------------------------------------------------
@each_case
def test_a_message_is_encoded_and_knows_its_place(case: Case) -> None:
    assert case.message.encode() == case.frame
    assert type(case.message.encode()) is bytes
    assert case.message.DIRECTION is case.direction
    assert case.frame[3] == case.message.COMMAND
    assert case.frame[2] in case.message.LENGTHS


@given(st.lists(st.tuples(st.integers(0, 255), st.integers(0, 65535)), min_size=1, max_size=83))
def test_a_list_can_be_read_as_columns_of_plain_numbers(pairs: list[tuple[int, int]]) -> None:
    for message in (ServoMove(1000, pairs), busservo.ServoPositions(pairs)):
        assert message.columns() == tuple(zip(*pairs, strict=True))
        assert {type(number) for column in message.columns() for number in column} == {int}


@in_turn(
    "listed",
    lambda: [
        *(list, tuple, dict, iter, np.array),
        lambda items: MappingProxyType(dict(items)),
        lambda items: (item for item in items),
        lambda items: [iter(item) for item in items],
        lambda items: [items[0], [*items[1]]],
        lambda items: dict.fromkeys(items).keys(),
        lambda items: map(tuple, items),
        lambda items: np.array(items, dtype=np.uint16),
    ],
)
def test_a_list_of_pairs_is_anything_in_order(listed: Callable[[Any], Any]) -> None:
    pairs = [(1, 800), (9, 200)]
    assert ServoMove(1000, listed(pairs)) == ServoMove(1000, pairs)
    assert busservo.ServoPositions(listed(pairs)) == busservo.ServoPositions(pairs)


@in_turn("listed", lambda: [list, tuple, iter, np.array, bytes, bytearray])
def test_a_list_of_numbers_is_anything_in_order(listed: Callable[[Any], Any]) -> None:
    assert busservo.ServoUnload(servo_ids=listed([1, 2, 250])).servo_ids == (1, 2, 250)


class Group(IntEnum):
    """Action groups of somebody's robot."""

    WAVE = 8


class Indexed:
    """An object that declares itself a whole number."""

    def __index__(self) -> int:
        return 8


@in_turn(
    "number", lambda: [8, np.int8(8), np.uint8(8), np.int64(8), np.uint64(8), Group.WAVE, Indexed()]
)
def test_a_whole_number_is_stored_as_an_int(number: Any) -> None:
    run = ActionGroupRun(group=number, times=number)
    move = ServoMove(time_ms=number, targets=[(number, 8), (8, number)])
    unload = busservo.ServoUnload(servo_ids=[7, number])
    assert run == ActionGroupRun(group=8, times=8)
    assert type(run.group) is type(run.times) is int
    assert move == ServoMove(8, [(8, 8), (8, 8)])
    assert {type(part) for target in move.targets for part in target} == {int}
    assert unload.servo_ids == (7, 8)


def test_a_field_knows_itself() -> None:
    time_ms, group = ServoMove.time_ms, busservo.ActionGroupSpeed.group
    assert (time_ms.name, time_ms.at, time_ms.low, time_ms.high) == ("time_ms", 5, 0, 65535)
    assert (time_ms.unit, time_ms.names) == ("ms", {})
    assert (group.unit, group.names) == ("", {"all": 255})
    assert ServoMove.servo_count.at == 4
    assert ServoMove.targets.counts == range(1, 84)
    assert ServoMove.targets.element is ServoTarget
    assert (ServoTarget.servo_id, ServoTarget.position) == ServoTarget.FIELDS
    assert busservo.ServoUnload.servo_ids.element is None


@in_turn(
    "field, words",
    lambda: [
        (ServoMove.time_ms, "How long the motion takes."),
        (ServoMove.targets, "The servos to turn and where to, in the order of the frame."),
        (ServoTarget.servo_id, "The servo to turn."),
        (busservo.BatteryVoltage.voltage_mv, "The voltage of the controller board."),
    ],
)
def test_help_shows_what_stands_below_a_field(field: Any, words: str) -> None:
    assert field.__doc__.startswith(words)
    assert words in pydoc.plain(pydoc.render_doc(field.owner))
    # The class of the field has a documentation of its own.
    assert words not in str(type(field).__doc__)


def test_where_there_is_no_source_a_field_has_no_documentation() -> None:
    space: dict[str, Any] = {"__name__": "nowhere", "U8": U8, "Element": Element}
    lines = ["class Lamp(Element, tuple):", "__match_args__ = ('level',)", "level = U8(0)", "'It.'"]
    exec("\n    ".join(lines), space)  # noqa: S102
    assert space["Lamp"].level.__doc__ is None


@in_turn(
    "kind, command, direction, lengths",
    lambda: [
        ("ServoMove", 3, HOST, [3 * n + 5 for n in range(1, 84)]),
        ("ActionGroupRun", 6, HOST, [5]),
        ("ActionGroupStop", 7, HOST, [2]),
        ("ActionGroupSpeed", 11, HOST, [5]),
        ("BatteryVoltageRead", 15, HOST, [2]),
        ("ServoUnload", 20, HOST, [n + 3 for n in range(1, 253)]),
        ("ServoPositionsRead", 21, HOST, [n + 3 for n in range(1, 253)]),
        ("ActionGroupStarted", 6, CONTROLLER, [5]),
        ("ActionGroupStopped", 7, CONTROLLER, [2]),
        ("ActionGroupCompleted", 8, CONTROLLER, [5]),
        ("BatteryVoltage", 15, CONTROLLER, [4]),
        ("ServoPositions", 21, CONTROLLER, [3 * n + 3 for n in range(85)]),
    ],
)
def test_a_message_is_the_one_that_the_document_describes(
    kind: str, command: int, direction: busservo.Direction, lengths: list[int]
) -> None:
    message = getattr(busservo, kind)
    assert message.COMMAND == command  # noqa: SIM300
    assert message.DIRECTION is direction
    assert [*message.LENGTHS] == lengths
    assert message in busservo.MESSAGES


# --- Comparing and keeping -----------------------------------------------------------------------
def test_messages_differ_by_class_and_by_value() -> None:
    different = {(type(case.message), case.frame) for case in CASES}
    assert len({case.message for case in CASES}) == len(different)
    assert len({*map(hash, (case.message for case in CASES))}) == len(different)
    # The same bytes, the other way.
    assert ActionGroupRun(8, 1) != busservo.ActionGroupStarted(8, 1)
    assert busservo.ActionGroupStop() != bytes.fromhex("55 55 02 07")
    noise = [Noise(data, reason) for data in (b"", b"\x55", b"\0") for reason in Reason]
    assert len({*map(hash, noise)}) == len(noise)


@each_case
def test_a_message_cannot_be_changed(case: Case) -> None:
    message: Any = case.message
    for name in (*message.__match_args__, "colour"):
        with pytest.raises(AttributeError):
            setattr(message, name, 1)
        with pytest.raises(AttributeError):
            delattr(message, name)
    assert not hasattr(message, "__dict__")


NOISE = (Noise(b"\xff", Reason.BAD_HEADER), busservo.UnknownFrame(b"UU\x02c", Reason.BAD_HEADER))
ELEMENTS = (ServoTarget(1, 800), busservo.ServoPosition(1, 800))


@in_turn("value", lambda: [*(case.message for case in CASES), *NOISE, *ELEMENTS])
def test_a_message_noise_and_an_element_can_be_copied_and_pickled(value: object) -> None:
    for twin in copies(value):
        assert twin == value
        assert type(twin) is type(value)


@each_case
def test_making_a_message_once_more_does_not_change_it(case: Case) -> None:
    message: Any = case.message
    frame = message.encode()
    message.__init__(*[1] * len(message.__match_args__))
    message.__init__()
    assert message.encode() is frame


@each_case
def test_a_message_can_be_referred_to_weakly(case: Case) -> None:
    message = busservo.decode(case.frame, case.direction)
    kept = weakref.WeakValueDictionary({1: message})
    assert kept[1] is message
    del message
    assert 1 not in kept


def test_a_pickle_of_no_legal_frame_is_no_message() -> None:
    frame = busservo.ActionGroupStop().encode()
    pickled = pickle.dumps(busservo.ActionGroupStop())
    assert frame in pickled
    with pytest.raises(busservo.DecodeError, match="bad header"):
        pickle.loads(pickled.replace(frame, b"\xaa" + frame[1:]))  # noqa: S301


# --- Elements ------------------------------------------------------------------------------------
@in_turn("kind", lambda: [ServoTarget, busservo.ServoPosition])
def test_an_element_is_a_named_tuple_like_others(kind: Any) -> None:
    element: Any = kind(servo_id=1, position=800)
    assert issubclass(kind, tuple)
    assert element == (1, 800) == kind(1, 800)
    assert hash(element) == hash((1, 800))
    assert (element.servo_id, element.position) == (1, 800)
    assert repr(element) == f"{kind.__name__}(servo_id=1, position=800)"
    assert eval(repr(element), vars(busservo).copy()) == element  # noqa: S307
    assert element._fields == element.__match_args__ == ("servo_id", "position")
    assert element._asdict() == {"servo_id": 1, "position": 800}
    assert element._replace(position=5) == kind(1, 5)
    assert type(element._replace(servo_id=2)) is kind
    with pytest.raises(TypeError):
        element._replace(colour=1)
    for name in ("servo_id", "position", "colour"):
        with pytest.raises(AttributeError):
            setattr(element, name, 1)
    assert not hasattr(element, "__dict__")


def test_the_class_of_all_messages_is_none_and_says_what_to_do_instead() -> None:
    is_all = "Message is what all messages are: "
    or_decode = "decode with one of its subclasses, or with the function `decode` of this package"
    with pytest.raises(TypeError, match=f"^{is_all}make one of its subclasses instead$"):
        Message()
    with pytest.raises(TypeError, match=f"^{is_all}{or_decode}$"):
        Message.decode(bytes.fromhex("55 55 02 07"))


# --- What no frame can carry ---------------------------------------------------------------------
@each_bad_value
def test_a_bad_value_is_refused_with_its_place(bad: BadValue) -> None:
    with pytest.raises(EncodeError) as caught:
        bad.make(**bad.fields)
    assert caught.value.path == bad.path
    assert caught.value.value == bad.value
    assert type(caught.value.value) is type(bad.value)
    assert str(caught.value) == f"{bad.path}: {bad.problem}"
    assert isinstance(caught.value, busservo.ProtocolError)
    assert isinstance(caught.value, ValueError)


class OldTruth:
    """A truth value as NumPy had it before its version 2: a number, too."""

    dtype = "bool"

    def __index__(self) -> int:
        return 1


@in_turn(
    "value",
    lambda: [
        *(np.float64(1), np.float32(1), np.True_, OldTruth(), np.array([1, 2]), np.str_("1")),
        1 + 0j,
    ],
    ids=ascii,
)
def test_what_is_no_whole_number_elsewhere_is_none_here(value: Any) -> None:
    for make, path in (
        (lambda: ActionGroupRun(value, 1), "group"),
        (lambda: ServoMove(value, [(1, 1)]), "time_ms"),
        (lambda: ServoMove(1, [(1, 1), (1, value)]), "targets[1].position"),
        (lambda: busservo.ServoUnload([1, value]), "servo_ids[1]"),
    ):
        with pytest.raises(EncodeError, match="not a whole number") as caught:
            make()
        assert caught.value.path == path
        assert caught.value.value is value


@in_turn(
    "given, said",
    lambda: [
        (2**128 - 1, f"{2**128 - 1} is outside 0..65535"),
        (2**128, "an integer of 129 bits is outside 0..65535"),
        ("x" * 58, f"'{'x' * 58}' is not a whole number, but a str"),
        ("x" * 59, f"'{'x' * 56}... is not a whole number, but a str"),
        # Python refuses to write out a number of so many digits.
        ([10**5000], "a list is not a whole number, but a list"),
        (..., "Ellipsis is not a whole number, but an ellipsis"),
        (None, "None is not a whole number, but nothing"),
    ],
    ids=lambda row: row[1],
)
def test_a_value_is_shown_as_far_as_it_helps(given: Any, said: str) -> None:
    with pytest.raises(EncodeError) as refused:
        ServoMove(given, [(1, 800)])
    assert str(refused.value) == f"time_ms: {said}"


# What is gone through as a list or as a pair, though it may not look like one, and what is not.
_numbers = st.integers(0, 255)
_odd = st.one_of(
    st.binary(min_size=2, max_size=2),
    st.text(min_size=2, max_size=2),
    st.sets(_numbers, min_size=2, max_size=2),
    st.dictionaries(_numbers, _numbers, min_size=2, max_size=2),
    st.lists(_numbers, max_size=3),
    st.tuples(_numbers, _numbers | st.none() | st.floats() | st.booleans()),
    st.none() | st.booleans() | st.integers() | st.floats(),
)


@given(st.lists(st.tuples(_numbers, _numbers) | _odd, max_size=3) | _odd)
def test_targets_mean_the_same_beside_any_kind_of_number(targets: Any) -> None:
    # Good numbers are packed at once, and others are looked at one by one; both judge alike.
    assert result_of(ServoMove, 8, targets) == result_of(ServoMove, Indexed(), targets)


def result_of(make: Callable[..., Message], *values: Any) -> Message | str:
    """Return the message of these values, or the error about them."""
    try:
        return make(*values)
    except EncodeError as error:
        return str(error)


def test_what_a_list_raises_by_itself_is_not_hidden() -> None:
    def failing() -> Iterator[tuple[int, int]]:
        yield (1, 800)
        raise TypeError("the arm has come off")

    with pytest.raises(TypeError, match="the arm has come off"):
        ServoMove(1000, failing())


# --- Errors --------------------------------------------------------------------------------------
def test_the_reasons_are_those_of_the_reference() -> None:
    words = {
        name: word
        for name, word in vars(refusals).items()
        if name.isupper() and isinstance(word, str)
    }
    assert {reason.name: reason.value for reason in lxservo.Reason} == words
    assert {reason.name: reason.value for reason in Reason} == words
