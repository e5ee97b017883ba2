"""The report of a run: in text, step by step and the first failure with its bytes; and as JSON."""

import json
from argparse import ArgumentParser

import pytest
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
