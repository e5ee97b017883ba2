"""Recordings of every kind that the project makes, audited as the library reads them."""

from collections import Counter
from pathlib import Path

import pytest
from busservo import Controller, Message, Noise, NoReplyError, UnknownFrame, strategies
from busservo.recordings import read
from busservo_simulator import Faults
from framegen.audit.audit import Audit
from framewire.command.checks.checks import examine
from framewire.command.checks.report import Report
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.independent.board import Board
from tests.contract.independent.ports import VirtualPort
from tests.factories import BUSSERVO, ROOT, compiled_file
from tests.lines.patient import CHECKS, board_with, diagnosis_of
from tests.lines.tallied_line import audited
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.unit.conformance.device.runs import run
from tests.unit.runtime.command.checks.conftest import nothing_else_comes

__all__ = ["nothing_else_comes"]
MODEL = compiled_file(BUSSERVO).model


def agree(path: Path) -> Audit:
    """Hold the audit to what the library reads, and return it."""
    entries = [*read(path)]
    found = audited(MODEL, path.read_bytes())
    known = [entry.event for entry in entries if not isinstance(entry.event, Noise)]
    messages = Counter(type(event).__name__ for event in known)
    seen = {name: each.seen for name, each in found.coverage.messages.items() if each.seen}
    assert seen == dict(messages)
    # What a client sends is never noise, but malformed on purpose.
    bad: dict[bool, list[Noise]] = {True: [], False: []}
    for entry in entries:
        if isinstance(entry.event, Noise):
            bad[entry.sender == "host"].append(entry.event)
    assert found.malformed == len(bad[True])
    unknown = sum(isinstance(event, UnknownFrame) for event in bad[False])
    assert unknown == sum(each.times for each in found.misfits if each.kind == "unknown command")
    assert sum(each.size for each in found.misfits) == sum(len(each.data) for each in bad[False])
    return found


@pytest.mark.usefixtures("nothing_else_comes")
def test_a_doctor_s_report(tmp_path: Path) -> None:
    path = tmp_path / "report.hex"
    with board_with(Faults(noise=0.3, seed=1)) as board:
        diagnosis = diagnosis_of(board)
        Report(path).write(diagnosis, [*examine(diagnosis, CHECKS)], "LSC-32")
    found = agree(path)
    assert found.recordings[0].device == "LSC-32"
    asked = found.conversations.by_request["BatteryVoltageRead"]
    assert asked.answered > 0
    assert len(asked.seconds) == asked.answered
    assert "BatteryVoltageRead" in [each.message.name for each in found.raised]


def test_a_client_s_trace(tmp_path: Path) -> None:
    line, path = VirtualLine(), tmp_path / "line.hex"
    with client_on(line, Controller, reply_timeout=0.25, trace=path) as controller:
        line.say(bytes.fromhex("55 00 55 55 02 07 55 55 05 08"))
        with pytest.raises(NoReplyError):
            controller.read_battery_voltage()
    found = agree(path)
    asked = found.conversations.by_request["BatteryVoltageRead"]
    assert (asked.requests, asked.unanswered) == (1, 0 if asked.answered else 1)


def test_the_recording_of_a_run_of_conform(tmp_path: Path) -> None:
    log = tmp_path / "run.hex"
    run(MODEL, VirtualPort(Board(baud=9600, servos=range(1, 7))), "--malformed", "--log", str(log))
    found = agree(log)
    # What was malformed on purpose is no finding.
    assert found.malformed > 0
    assert found.fits


def test_a_recording_that_broke_off() -> None:
    found = agree(ROOT / "tests" / "captures" / "cut_off.hex")
    assert [each.what for each in found.misfits] == ["too short in ActionGroupCompleted"]


@given(st.lists(strategies.messages(), min_size=1, max_size=8))
def test_what_a_line_says_of_its_sender_is_believed(messages: list[Message]) -> None:
    text = "".join(
        f"{each.encode().hex(' ')}  # {at}.5 s, {each.DIRECTION.sender}: a\n"
        for at, each in enumerate(messages)
    )
    found = audited(MODEL, text)
    seen = {name: each.seen for name, each in found.coverage.messages.items() if each.seen}
    assert seen == dict(Counter(type(each).__name__ for each in messages))
    assert found.fits
