"""Positions: which servos are there, holding them, and going back; in any words of the spec."""

import importlib
import re
from collections.abc import Iterator
from typing import Any

import busservo
import pytest
from busservo import Controller, ServoMove, ServoPosition, ServoPositions
from busservo_simulator import VirtualController

from tests.factories import DEMO, library, library_of
from tests.handed import program_of
from tests.in_turn import in_turn
from tests.lines import timed_line
from tests.lines.both_clients import PORT_TALKS, Talk
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.timeouts import LIVE

Positions = list[tuple[int, int]]

OFF = ServoPosition.POSITION_ABSENT


def moves(line: VirtualLine) -> list[ServoMove]:
    return [each for each in line.received if isinstance(each, ServoMove)]


def client_of(line: VirtualLine, **given: Any) -> Any:
    return client_on(line, Controller, settle=None, **given)


@in_turn(
    "position, signed, absent",
    lambda: [
        *((each, each, False) for each in (0, 500, 1000, 32767)),
        (32768, -32768, False),
        (65531, -5, False),
        (65534, -2, False),
        (65535, -1, True),
    ],
)
def test_a_position_stays_raw_and_has_its_meaning_beside_it(
    position: int, signed: int, absent: bool
) -> None:
    [read] = ServoPositions([(4, position)]).positions
    assert (read.position, read.signed_position, read.absent) == (position, signed, absent)
    assert read == (4, position)
    assert repr(read) == f"ServoPosition(servo_id=4, position={position})"
    for name in ("signed_position", "absent"):
        with pytest.raises(AttributeError):
            setattr(read, name, 1)


def test_silence_while_looking_for_servos_is_an_error() -> None:
    answered = ServoPositions([(1, 500)])
    line = VirtualLine(lambda _: [] if line.received[1:] else [answered])
    with client_of(line) as controller, pytest.raises(busservo.NoReplyError):
        controller.present_servos(range(1, 100))


# ------------------------------------------------------------------ holding, and going back
def answering(positions: Positions) -> VirtualLine:
    """Return a line to a board that answers every question about positions alike."""
    reply = [ServoPositions(positions)]
    return VirtualLine(lambda it: reply if isinstance(it, busservo.ServoPositionsRead) else [])


def test_nothing_is_sent_where_one_of_those_to_hold_is_not_there() -> None:
    line = answering([(1, 500), (2, OFF), (4, 600)])
    with client_of(line) as controller, pytest.raises(busservo.AbsentError) as refused:
        controller.hold_servos([1, 2, 3, 4])
    assert moves(line) == []
    assert refused.value.missing == (2, 3)
    assert refused.value.arrived == ((1, 500), (4, 600))
    assert isinstance(refused.value, busservo.IncompleteReplyError)
    problem = "nothing was sent, since these are off or missing: servo_ids 2, 3; "
    assert str(refused.value) == problem + "2 did arrive"


@in_turn(
    "limits, read, targets",
    lambda: [
        ((0, 1000), [(1, 65531), (2, 1003), (3, 500)], [(1, 0), (2, 1000), (3, 500)]),
        ((0, 1000), [(1, 65486), (2, 1050)], [(1, 0), (2, 1000)]),
        ((500, 2500), [(1, 400), (2, 2600)], [(1, 500), (2, 2500)]),
        (None, [(1, 65531), (2, 1003), (3, 40000)], [(1, 0), (2, 1003), (3, 40000)]),
    ],
)
def test_what_is_at_its_stop_is_held_and_replayed_inside_the_limits(
    limits: Any, read: Positions, targets: Positions
) -> None:
    line = answering(read)
    with client_of(line, limits=limits) as controller:
        controller.hold_servos([number for number, _ in read], time_ms=40)
        pose = ServoPositions([*read, (9, OFF)]).positions
        assert controller.targets_of(pose) == targets
    assert moves(line) == [ServoMove(time_ms=40, targets=targets)]


@in_turn(
    "limits, position, expected",
    lambda: [
        ((0, 1000), 1051, "limits=(500, 2500) is for PWM servo boards, limits=None for any"),
        ((0, 1000), 65485, "position: 65485 is outside the limits 0..1000; limits=None"),
        ((500, 2500), 399, "limits=(0, 1000) is for what is usual, limits=None for any"),
        ((500, 2500), 65531, "limits=None sends anything"),
    ],
)
def test_what_is_far_outside_the_limits_is_not_sent_somewhere_else(
    limits: tuple[int, int], position: int, expected: str
) -> None:
    read = [(1, 500), (2, position)]
    line = answering(read)
    with client_of(line, limits=limits) as controller:
        with pytest.raises(busservo.LimitError) as refused:
            controller.hold_servos([1, 2])
        with pytest.raises(busservo.LimitError):
            controller.targets_of(ServoPositions(read).positions)
    assert str(refused.value).startswith("positions[1].position: ")
    assert expected in str(refused.value)
    assert moves(line) == []


@pytest.mark.parametrize("talk", PORT_TALKS)
def test_the_same_at_a_port(talk: Talk) -> None:
    async def work(controller: Any) -> None:
        assert await controller.present_servos() == (1, 2, 3)
        await controller.hold_servos([1, 2])
        with pytest.raises(busservo.AbsentError):
            await controller.hold_servos([1, 7])
        pose = [ServoPosition(1, OFF), ServoPosition(2, 65531)]
        assert controller.targets_of(pose) == [(2, 0)]

    with VirtualController("tcp", servos=[1, 2, 3]) as board:
        talk(board.port, work, **LIVE)


# ------------------------------------------------------------------ in words of another protocol
@pytest.fixture(scope="module")
def blinds() -> Iterator[Any]:
    """Return the library of a protocol that shares no name with the one that this was made for."""
    with library(library_of(DEMO.with_name("blinds.yaml"))) as made:
        yield made


def motor(blinds: Any, heights: dict[int, int]) -> Any:
    """Return a device with blinds at these heights, which go where they are sent."""

    class Motor(blinds.Device):  # type: ignore[misc]
        def on_blinds_read(self, message: Any) -> Any:
            there = [(each, heights[each]) for each in message.blind_ids if each in heights]
            return blinds.BlindsState(there)

        def on_blinds_roll(self, message: Any) -> None:
            heights.update({each.blind_id: each.height for each in message.heights})

        def on_blinds_release(self, message: Any) -> None:
            heights.update(dict.fromkeys(message.blind_ids, 0))

    return Motor()


def test_present_actuators_are_found_held_and_released(blinds: Any) -> None:
    heights = {4: 200, 9: 300}
    with timed_line.client_of(motor(blinds, heights)) as hub:
        assert hub.present() == (4, 9)
        found = hub.read_heights([4, 9])
        assert [(each.blind_id, each.height) for each in found] == [(4, 200), (9, 300)]
        hub.blinds_release([4])
        assert heights == {4: 0, 9: 300}
        hub.roll(hub.heights_of(found), roll_ms=10).wait()
        assert heights == {4: 200, 9: 300}
        hub.hold([9], roll_ms=10).wait()
        with pytest.raises(blinds.AbsentError, match="5"):
            hub.hold([4, 5])


def examined(device: Any) -> dict[str, Any]:
    """Return what the doctor finds out about a device."""
    checks, diagnosis = (
        importlib.import_module(f"framewire.command.checks.{name}")
        for name in ("checks", "diagnosis")
    )
    line, program = timed_line.DeviceLine(device), program_of("blinds")
    link = program.library.link
    given = {"baud": link.baud, "local_echo": link.local_echo, "clock": line.clock}
    opener = {"opener": lambda _port, _baud: line, "hid_devices": list}
    case = diagnosis.Diagnosis(program, "loop://", **given, **opener)
    every = checks.checks_of(program.library)
    return {check.id: result for check, result in checks.examine(case, every)}


# No question of this protocol suits any device: each names those that it is about.
@in_turn(
    "heights, state, seen",
    lambda: [
        ({4: 200, 9: 300}, "passed", "blinds that are there: 4, 9"),
        ({}, "failed", "blinds that are there: none"),
        (None, "failed", "was not answered, though asked 3 times"),
    ],
)
def test_the_doctor_finds_present_actuators(
    blinds: Any, heights: dict[int, int] | None, state: str, seen: str
) -> None:
    found = examined(blinds.Device() if heights is None else motor(blinds, heights))
    present = found["present"]
    assert "rate" not in found
    assert present.state == state
    assert present.seen.endswith(seen) if heights is None else present.seen == seen
    assert {*re.findall(r"check `([^`]+)`", present.advice or "")} <= {*found}
