"""Single frames: what `decode` reads, what it refuses and why, and round trips."""

import re
from typing import Any

import busservo
import pytest
from busservo import MESSAGES, DecodeError, Direction, Message, ProtocolError, strategies
from hypothesis import given
from hypothesis import strategies as st

from tests.cases import CONTROLLER, EITHER, HOST, BadFrame, Case, each_bad_frame, each_case
from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.strategies import damaged_frames


def commands(*directions: Direction) -> str:
    """Return the commands of some directions, as an error lists them."""
    found = {kind.COMMAND for kind in MESSAGES if kind.DIRECTION in directions}
    return ", ".join(map(str, sorted(found)))


each_message = in_turn("kind", lambda: MESSAGES, ids=lambda kind: kind.__name__)


def strategy_of(kind: type[Message]) -> st.SearchStrategy[Message]:
    """Return the strategy that busservo.strategies names after a message."""
    name = re.sub(r"(?<!^)(?=[A-Z])", "_", kind.__name__).lower()
    strategy: st.SearchStrategy[Message] = getattr(strategies, name)()
    return strategy


# --- Frames --------------------------------------------------------------------------------------
@each_case
def test_a_frame_is_decoded_by_its_direction(case: Case) -> None:
    assert busservo.decode(case.frame, case.direction) == case.message


class Derived(bytes):
    """A class of bytes that redefines how it is copied."""

    def __bytes__(self) -> bytes:
        return b"other bytes"


@each_case
def test_a_frame_is_any_kind_of_bytes_and_plain_bytes_are_kept(case: Case) -> None:
    for convert in (bytes, bytearray, memoryview, Derived):
        frame = convert(case.frame)
        for message in (busservo.decode(frame, case.direction), type(case.message).decode(frame)):
            assert message == case.message
            assert type(message.encode()) is bytes


@in_turn(
    "frame, kind",
    lambda: [
        ("55 55 02 07", "str; bytes.fromhex() reads hex"),
        *((None, "NoneType"), (4, "int"), ([0x55, 0x55, 2, 7], "list"), (object(), "object")),
    ],
)
def test_what_is_no_bytes_is_no_frame(frame: Any, kind: str) -> None:
    said = re.escape(f"bytes, bytearray or memoryview expected, not {kind}")
    for read in (lambda data: busservo.decode(data, HOST), busservo.ActionGroupStop.decode):
        with pytest.raises(TypeError, match=f"^{said}$"):
            read(frame)


@pytest.mark.parametrize("direction", ["host_to_controller", "host", 0, False, MESSAGES])
def test_what_is_no_direction_is_refused(direction: Any) -> None:
    with pytest.raises(TypeError, match="a Direction expected, such as "):
        busservo.decode(b"", direction)


# --- Bad frames ----------------------------------------------------------------------------------
@each_bad_frame
def test_a_bad_frame_is_refused_with_reason_and_offset(bad: BadFrame) -> None:
    with pytest.raises(DecodeError) as caught:
        busservo.decode(bad.frame, bad.direction)
    assert (caught.value.reason, caught.value.offset) == (bad.reason, bad.offset)
    assert str(caught.value).startswith(f"{bad.reason.value} at byte {bad.offset}: ")
    assert isinstance(caught.value, ProtocolError)
    assert isinstance(caught.value, ValueError)


SIZE = "length mismatch at byte 2: the length is"
BATTERY = "2 (BatteryVoltageRead) or 4 (BatteryVoltage)"
OTHER = "unknown command at byte 3: the command is 99, and only"


@in_turn(
    "frame, direction, text",
    lambda: [
        ("55 54", HOST, "bad header at byte 1: a frame begins 55 55"),
        ("55", HOST, "too short at byte 1: a frame begins 55 55"),
        ("55 55 02", HOST, "too short at byte 3: the shortest frame has 4 bytes"),
        ("55 55 05 06", HOST, "too short at byte 4: ActionGroupRun with this length has 7 bytes"),
        ("55 55 01 63", HOST, f"{SIZE} 1, and must be 2..255"),
        ("55 55 01 07", HOST, f"{SIZE} 1, and must be 2 (ActionGroupStop)"),
        ("55 55 09 03", HOST, f"{SIZE} 9, and must be 8, 11, 14 .. 254 (ServoMove)"),
        ("55 55 03 14", HOST, f"{SIZE} 3, and must be 4..255 (ServoUnload)"),
        ("55 55 05 0F", EITHER, f"{SIZE} 5, and must be {BATTERY}"),
        ("55 55 06 06", EITHER, f"{SIZE} 6, and must be 5 (ActionGroupRun, ActionGroupStarted)"),
        ("55 55 02 63", CONTROLLER, f"{OTHER} {commands(CONTROLLER)} can be here"),
        ("55 55 02 63", EITHER, f"{OTHER} {commands(HOST, CONTROLLER)} can be here"),
        (
            "55 55 02 07 00",
            CONTROLLER,
            "trailing bytes at byte 4: ActionGroupStopped with this length has 4 bytes, not 5",
        ),
        (
            "55 55 06 15 02 01 02 03",
            CONTROLLER,
            "count mismatch at byte 4: with this length the count is 01, not 02",
        ),
    ],
)
def test_a_refusal_says_what_was_expected(
    frame: str, direction: Direction | None, text: str
) -> None:
    with pytest.raises(DecodeError) as caught:
        busservo.decode(bytes.fromhex(frame), direction)
    assert str(caught.value) == text
    assert caught.value.problem == text.partition(": ")[2]


def test_a_class_says_what_no_frame_can_be() -> None:
    with pytest.raises(DecodeError) as caught:
        busservo.ActionGroupStop.decode(bytes.fromhex("55 55 01 63"))
    text = "length mismatch at byte 2: the length is 1, and must be at least 2"
    assert str(caught.value) == text


# --- There and back ------------------------------------------------------------------------------
@each_message
@given(data=st.data())
def test_every_message_survives_the_way_there_and_back(
    kind: type[Message], data: st.DataObject
) -> None:
    message = data.draw(strategy_of(kind))
    frame = message.encode()
    assert type(message) is kind
    assert frame[2] == len(frame) - 2
    assert frame[2] in kind.LENGTHS
    assert frame[3] == kind.COMMAND
    assert kind.decode(frame) == busservo.decode(frame, kind.DIRECTION) == message
    assert kind.decode(frame).encode() == frame


@each_message
@few_each
@given(frame=damaged_frames() | st.binary(max_size=12))
def test_any_bytes_are_the_message_of_a_class_or_a_decode_error(
    kind: type[Message], frame: bytes
) -> None:
    message = None
    try:
        message = kind.decode(frame)
    except DecodeError as caught:
        error = caught
    if message is None:
        assert 0 <= error.offset <= len(frame)
    else:
        assert type(message) is kind
        assert message.encode() == frame
