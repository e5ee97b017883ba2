"""A run records the line while it goes on, and never overwrites a recording."""

from pathlib import Path

import pytest
from busservo.recordings import read
from framegen.reading.yamltree import Unusable

from tests.contract.independent import faults
from tests.contract.independent.board import Board
from tests.contract.independent.ports import VirtualPort
from tests.lines.devices import by_the_reference, lost_after
from tests.lines.timed_line import TimedLine
from tests.unit.conformance.device.runs import model_of, run

MODEL = model_of()


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
