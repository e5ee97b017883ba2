"""Poses of a protocol that shares no name with the one that they were made for."""

import importlib
import re
from collections.abc import Iterator
from types import ModuleType
from typing import Any

import pytest

from tests.factories import DEMO, library, library_of
from tests.handed import handed_by, program_of
from tests.lines.timed_line import DeviceLine, client_of


@pytest.fixture(scope="module")
def blinds() -> Iterator[ModuleType]:
    files = library_of(DEMO.with_name("blinds.yaml"))
    with library(files) as made:
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
    with client_of(motor(blinds, heights)) as hub:
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


def test_verbs_name_actuators_in_the_words_of_the_spec(blinds: ModuleType) -> None:
    positions = importlib.import_module("framewire.command.positions")
    pose = positions.the_pose(handed_by(blinds.__name__))
    assert positions.listed(pose, [4]) == "blind 4"
    assert positions.listed(pose, [4, 9]) == "blinds 4, 9"
    assert list(pose.ids) == [*range(1, 21)]


def examined(blinds: ModuleType, device: Any) -> dict[str, Any]:
    """Return what the doctor finds out about a device."""
    checks, diagnosis = (
        importlib.import_module(f"framewire.command.checks.{name}")
        for name in ("checks", "diagnosis")
    )
    line = DeviceLine(device)
    program = program_of(blinds.__name__)
    case = diagnosis.Diagnosis(
        program,
        "loop://",
        baud=program.library.link.baud,
        local_echo=program.library.link.local_echo,
        opener=lambda _port, _baud: line,
        clock=line.clock,
        hid_devices=list,
    )
    every = checks.checks_of(program.library)
    return {check.id: result for check, result in checks.examine(case, every)}


# No question of this protocol suits any device: each names those that it is about.
@pytest.mark.parametrize(
    ("heights", "state", "seen"),
    [
        ({4: 200, 9: 300}, "passed", "blinds that are there: 4, 9"),
        ({}, "failed", "blinds that are there: none"),
    ],
)
def test_the_doctor_finds_present_actuators(
    blinds: ModuleType, heights: dict[int, int], state: str, seen: str
) -> None:
    found = examined(blinds, motor(blinds, heights))
    assert "rate" not in found
    assert (found["present"].state, found["present"].seen) == (state, seen)


def test_the_doctor_finds_that_nobody_answers(blinds: ModuleType) -> None:
    found = examined(blinds, blinds.Device())
    assert found["present"].state == "failed"
    assert "was not answered, though asked 3 times" in found["present"].seen
    assert {*re.findall(r"check `([^`]+)`", found["present"].advice)} <= {*found}
