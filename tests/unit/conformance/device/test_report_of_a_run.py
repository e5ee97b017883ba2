"""The report of a run: in text, step by step and the first failure with its bytes; and as JSON.

And its recording: of the line while it goes on, in place of no other.
"""

import json
from argparse import ArgumentParser
from pathlib import Path

import pytest
from busservo.recordings import read
from framegen.conformance import firmware
from framegen.conformance.device.permission import permit
from framegen.conformance.device.queries import commands
from framegen.conformance.device.recording import Recording
from framegen.conformance.device.session import Session, Timing
from framegen.reading.yamltree import Unusable

from tests.contract.independent import faults
from tests.contract.independent.board import Board
from tests.contract.independent.ports import VirtualPort
from tests.lines.devices import by_the_reference, lost_after
from tests.lines.timed_line import TimedLine
from tests.unit.conformance.device.runs import model_of, run

MODEL = model_of()
REPORT = """\
Hiwonder bus servo controller: controller at a line, 9600 8N1
will send: BatteryVoltageRead, ServoPositionsRead
will not send: ServoMove, ActionGroupRun, ActionGroupStop, ActionGroupSpeed, ServoUnload \
(--allow NAME sends its examples)
ok       BatteryVoltageRead, example 1 (0.012 s)
ok       ServoPositionsRead, example 1 (0.037 s)
FAIL     ServoPositionsRead, one element
         no frame: no ServoPositions within 0.265 s; what came is none: count mismatch at byte 4: \
a length of 6 makes servo_count 1, not 2
         note: noise, count mismatch: 8 bytes, 55 55 06 15 02 01 03 00
ok       ServoPositionsRead, two elements (0.021 s)
ok       ServoPositionsRead, 84 elements (0.119 s)
         note: ServoPositions reports 6 of 84
ok       BatteryVoltageRead, example 1, twice in a row (0.012 s, 0.012 s)
ok       ServoPositionsRead, example 1, twice in a row (0.037 s, 0.037 s)
ok       BatteryVoltageRead and ServoPositionsRead at once (0.012 s, 0.042 s)

The first that failed, ServoPositionsRead, one element:
    0.000 s  host        55 55 04 15 01 01
                         ServoPositionsRead servo_ids=1
    0.017 s  controller  55 55 06 15 02 01 03 00
                         noise, count mismatch at byte 4: a length of 6 makes servo_count 1, not 2
  no frame: no ServoPositions within 0.265 s; what came is none: count mismatch at byte 4: \
a length of 6 makes servo_count 1, not 2

7 of 8 steps passed
"""


def test_a_run_is_reported_step_by_step() -> None:
    wrong = {3: faults.miscounted(1)}
    board = Board(baud=9600, thinks=0.002, faults=wrong.get, servos=range(1, 7))
    assert run(MODEL, VirtualPort(board), form="text").out == REPORT


def test_json_holds_all_of_a_run() -> None:
    wrong = {2: faults.dropped}
    board = Board(baud=9600, thinks=0.002, faults=wrong.get, servos=range(1, 7))
    report = run(MODEL, VirtualPort(board)).report
    steps = report.pop("steps")
    assert report == {
        "protocol": "busservo",
        "version": MODEL.spec.protocol.version,
        "device": "controller",
        "port": "a line",
        "baud": 9600,
        "address": None,
        "will_send": ["BatteryVoltageRead", "ServoPositionsRead"],
        "will_not_send": [
            "ServoMove",
            "ActionGroupRun",
            "ActionGroupStop",
            "ActionGroupSpeed",
            "ServoUnload",
        ],
        "passed": False,
        "stopped": None,
        "unsolicited": [],
    }
    assert steps[0] == {
        "title": "BatteryVoltageRead, example 1",
        "malformed": False,
        "passed": True,
        "not_sent": None,
        "faults": [],
        "notes": [],
        "bursts": [
            {
                "at": 0.3,
                "sent": [{"hex": "55 55 02 0F", "what": "BatteryVoltageRead"}],
                "received": [
                    {
                        "at": 0.312417,
                        "kind": "message",
                        "hex": "55 55 04 0F 01 00",
                        "what": "BatteryVoltage voltage_mv=1",
                    }
                ],
                "reply_seconds": [0.012417],
            }
        ],
    }
    assert steps[1]["faults"] == [{"kind": "silence", "text": "no ServoPositions within 0.285 s"}]


def test_a_run_that_ends_with_the_line_is_still_reported_as_json(
    capsys: pytest.CaptureFixture[str],
) -> None:
    line = lost_after(3, by_the_reference(MODEL))
    parser = ArgumentParser()
    firmware.add_arguments(parser)
    arguments = parser.parse_args(["--port", "a line"])
    arguments.format, arguments.timeout = "json", None
    with pytest.raises(Unusable):
        firmware.run(MODEL, arguments, connect=lambda *_: line, clock=line.clock)
    report = json.loads(capsys.readouterr().out)
    assert report["stopped"] == "a line: the cable was pulled"
    assert [step["passed"] for step in report["steps"]] == [True, True, True]
    assert not report["passed"]


def test_a_session_writes_nothing_that_is_not_allowed() -> None:
    line = TimedLine()
    command = commands(permit(MODEL, ["ServoMove"]))[0]
    with Recording(MODEL, None) as recording:
        session = Session(line, permit(MODEL, []), Timing(9600, 10, 0.25), recording, line.clock)
        with pytest.raises(AssertionError, match="must not be sent"):
            session.send((command,))
    assert line.written == []


def test_every_byte_both_ways_is_recorded_in_its_order_with_its_time(tmp_path: Path) -> None:
    log = tmp_path / "run.hex"
    scripts = {2: faults.miscounted(1), 3: faults.cut(7), 4: faults.preceded(bytes(3))}
    board = Board(baud=9600, faults=scripts.get, servos=range(1, 7))
    done = run(MODEL, VirtualPort(board), "--malformed", "--log", str(log))
    entries = list(read(log))
    data = {"host": b"", "controller": b""}
    for entry in entries:
        event = entry.event
        data[str(entry.sender)] += getattr(event, "data", b"") or event.encode()  # type: ignore[union-attr]
    assert data["host"] == b"".join(done.written)
    assert data["controller"] == b"".join(said.data for said in board.said)
    times = [entry.time or 0.0 for entry in entries]
    assert times == sorted(times)
    assert 0.3 <= times[0] < times[1] < times[-1]


def test_it_says_what_is_tried_and_where_the_line_fell_silent_in_a_frame(
    tmp_path: Path,
) -> None:
    log = tmp_path / "run.hex"
    board = Board(baud=9600, faults={1: faults.cut(5)}.get)
    run(MODEL, VirtualPort(board), "--malformed", "--log", str(log))
    lines = log.read_text(encoding="ascii").splitlines()
    assert lines[0].startswith("# recorded of 'a line' from 20")
    assert lines[1] == "# BatteryVoltageRead, example 1"
    assert lines[2].endswith(" s, host: BatteryVoltageRead")
    assert lines[2].startswith("55 55 02 0F  # 0.300000 s")
    assert lines[3].startswith("55 55 04 0F 01  # ")
    assert lines[3].endswith(" s, noise: too short")
    assert lines[4] == "# quiet"
    bad = [line for line in lines if " s, host noise: " in line]
    assert [line.rpartition(": ")[2] for line in bad[:3]] == [
        "too short",
        "too short",
        "length mismatch",
    ]


def test_an_existing_recording_is_kept_and_nothing_is_sent(tmp_path: Path) -> None:
    log = tmp_path / "run.hex"
    log.write_text("55 55 02 0F\n", encoding="ascii")
    line = TimedLine(by_the_reference(MODEL))
    with pytest.raises(Unusable, match="it holds 12 bytes, and a recording is never") as caught:
        run(MODEL, line, "--log", str(log))
    assert caught.value.hint == "give another name, or remove it"
    assert (log.read_text(encoding="ascii"), line.written) == ("55 55 02 0F\n", [])


def test_a_recording_that_cannot_be_made_is_reported(tmp_path: Path) -> None:
    line = TimedLine(by_the_reference(MODEL))
    with pytest.raises(Unusable, match="cannot be written: "):
        run(MODEL, line, "--log", str(tmp_path / "no folder" / "run.hex"))
    assert line.written == []


def test_the_recording_of_a_lost_line_is_kept(tmp_path: Path) -> None:
    log = tmp_path / "run.hex"
    line = lost_after(2, by_the_reference(MODEL))
    with pytest.raises(Unusable, match="a line: the cable was pulled") as caught:
        run(MODEL, line, "--log", str(log))
    assert caught.value.hint == "check the cable and the power, then run this again"
    assert [type(entry.event).__name__ for entry in read(log)][:4] == [
        "BatteryVoltageRead",
        "BatteryVoltage",
        "ServoPositionsRead",
        "ServoPositions",
    ]
    assert line.closed
