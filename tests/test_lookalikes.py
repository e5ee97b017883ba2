"""The library names the protocols that are easily taken for it: by their frames, in any company."""

from pathlib import Path

import pytest
from busservo import Message, strategies
from busservo._codec import lookalikes
from framegen.explanation.lookalikes import recognise
from framegen.model.model import Model
from framegen.targets.python.library_view import LibraryView
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, data_of, files_of, layout_of, library

LAYOUT = layout_of(data_of(BUSSERVO))
SERVO_BUS = "LX-16A bus servo protocol"
DIALECT = "The dialect of LeArm and uHand boards"


def servo_bus_frame(servo_id: int, command: int, parameters: bytes = b"") -> bytes:
    """Return a frame as published for the LX-16A: 55 55 ID LEN CMD parameters CHECKSUM."""
    summed = bytes([servo_id, len(parameters) + 3, command]) + parameters
    return b"\x55\x55" + summed + bytes([~sum(summed) & 0xFF])


MOVE = servo_bus_frame(1, 1, bytes.fromhex("20 03 E8 03"))
ASK = servo_bus_frame(7, 28)


@pytest.mark.parametrize(
    ("data", "title"),
    [
        (MOVE, SERVO_BUS),
        (ASK + MOVE + ASK, SERVO_BUS),
        # Cut at both ends, as whatever is listened to in the middle is.
        (MOVE[4:] + 2 * MOVE + MOVE[:5], SERVO_BUS),
        (MOVE[:-1] + bytes([MOVE[-1] ^ 1]), None),
        (b"\x00" * 11 + MOVE, None),
        (bytes.fromhex("55 55 02 01"), DIALECT),
        (bytes.fromhex("55 55 05 0A 01 02 03"), DIALECT),
        # A message of ours has command 8, too, and this is one.
        (bytes.fromhex("55 55 05 08 01 02 00"), None),
        (bytes.fromhex("55 55 02 63"), None),
        # A false header in front of frames of ours says that 85 bytes follow, and a command.
        (b"\x55" + 30 * bytes.fromhex("55 55 02 0F"), None),
        (bytes.fromhex("55 55 02 07"), None),
        (b"", None),
        (b"\x55", None),
        (2000 * b"\x55", None),
        (20 * bytes(range(256)), None),
    ],
)
def test_the_frames_of_a_look_alike_are_recognised(data: bytes, title: str | None) -> None:
    assert lookalikes.recognise(data) == title


@given(st.lists(strategies.messages(), max_size=5))
def test_what_is_of_this_protocol_is_never_taken_for_another(messages: list[Message]) -> None:
    assert lookalikes.recognise(b"".join(message.encode() for message in messages)) is None


def examples(model: Model) -> list[tuple[bytes, str]]:
    return [
        (example.hex, each.title)
        for each in model.spec.lookalikes.values()
        for example in each.examples
    ]


@pytest.mark.parametrize(("data", "title"), examples(LAYOUT))
def test_the_generator_recognises_the_same(data: bytes, title: str) -> None:
    found = recognise(LAYOUT.plain, data)
    assert found is not None
    assert found.lookalike.title == lookalikes.recognise(data) == title


def test_another_protocol_has_look_alikes_of_its_own(tmp_path: Path) -> None:
    layout = layout_of(data_of(DEMO))
    with library(files_of(data_of(DEMO)), tmp_path) as made:
        found = __import__(f"{made.__name__}._codec.lookalikes", fromlist=["recognise"])
        for data, title in examples(layout):
            assert found.recognise(data) == title
            assert found.recognise(data[:-1]) is None


def test_a_spec_without_look_alikes_has_none() -> None:
    data = {key: value for key, value in data_of(BUSSERVO).items() if key != "lookalikes"}
    assert LibraryView(layout_of(data)).lookalikes.endswith(" = ()")
