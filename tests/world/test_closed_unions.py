"""Type checkers know when a `match` has gone through all that can come, and when it has not."""

import sys
from pathlib import Path

import pytest

from tests.programs import ran

ROOT = Path(__file__).parents[2]
REPORTS = """
        case ActionGroupStarted() | ActionGroupStopped() | ActionGroupCompleted():
            return "report"
        case BatteryVoltage(voltage_mv):
            return f"{voltage_mv} mV"
        case ServoPositions(positions):
            return f"{len(positions)} servos"
"""
COMMANDS = """
        case ServoMove() | ServoUnload() | ActionGroupRun() | ActionGroupStop():
            return "command"
        case ActionGroupSpeed() | BatteryVoltageRead() | ServoPositionsRead():
            return "another"
"""
NOISE = """
        case Noise(data):
            return f"{len(data)} bytes of noise"
"""
PROGRAM = """\
from typing_extensions import assert_never, assert_type

from busservo import *
from busservo.messages import Decoded


def by_direction(frame: bytes, direction: Direction) -> None:
    assert_type(decode(frame, Direction.HOST_TO_CONTROLLER), HostMessage)
    assert_type(decode(frame, Direction.CONTROLLER_TO_HOST), ControllerMessage)
    assert_type(decode(frame, None), Decoded)
    assert_type(decode(frame, direction), Decoded)
    assert_type(StreamDecoder(None).feed(frame), list[Event])


def received(frame: bytes) -> str:
    message = decode(frame, Direction.CONTROLLER_TO_HOST)
    match message:{reports}        case _:
            assert_never(message)


def streamed(event: Event) -> str:
    match event:{reports}{commands}{noise}        case _:
            assert_never(event)
"""
CHECKERS = {
    "mypy": ["mypy", "--strict", "--no-incremental"],
    "pyright": ["pyright", "--pythonpath", sys.executable],
}


@pytest.mark.parametrize("left_out", ["", "noise", "reports", "commands"])
@pytest.mark.parametrize("checker", CHECKERS)
def test_a_match_is_known_to_be_complete(checker: str, left_out: str, tmp_path: Path) -> None:
    pytest.importorskip(checker, reason="`pip install --group lint`")
    parts = {"reports": REPORTS, "commands": COMMANDS, "noise": NOISE}
    if left_out:
        parts[left_out] = "\n"
    (tmp_path / "program.py").write_text(PROGRAM.format(**parts), encoding="utf-8")
    (tmp_path / "mypy.ini").write_text(
        f"[mypy]\nmypy_path = {ROOT / 'generated'}\n", encoding="utf-8"
    )
    (tmp_path / "pyrightconfig.json").write_text(
        f'{{"extraPaths": ["{(ROOT / "generated").as_posix()}"]}}', encoding="utf-8"
    )
    words = ("-m", *CHECKERS[checker], "program.py")
    done = ran(sys.executable, *words, status=None, cwd=tmp_path)
    assert (done.returncode != 0) == bool(left_out), done.stdout
    if left_out:
        assert "assert_never" in done.stdout or "Never" in done.stdout
