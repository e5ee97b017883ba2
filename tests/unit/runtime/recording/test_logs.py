"""Logs of other programs are read by the library, the commands and framegen, as a table says."""

import io
import json

import pytest
from busservo import Direction, recordings
from busservo.__main__ import main
from busservo.recordings import RecordingError
from framegen.cli import main as framegen_main
from framewire.codec.event_bytes import bytes_of
from framewire.codec.hextext import read_hex
from framewire.recording.form import LogError, log_lines, without_log

from tests.factories import BUSSERVO
from tests.hex_cases import HEX, LOGS, NO_HEX, NO_LOGS
from tests.in_turn import in_turn

STOP, VOLTAGE = "55 55 02 07", "55 55 04 0F 4C 1D"
BOTH = f"12:00:59.5 TX: {STOP}\n12:01:00.25 RX: 55 55 04\n12:01:00.5 RX: 0F 4C 1D\n"


def said(text: str) -> list[tuple[str, str]]:
    log = log_lines(text)
    assert log is not None, text
    lines = [log.read(line) for line in text.split("\n")]
    return [(way, read_hex(hex_).hex()) for line in lines for hex_, _, way in line]


@in_turn("text, pieces", lambda: LOGS)
def test_each_line_of_a_log_says_its_bytes_and_their_way(
    text: str, pieces: list[tuple[str, str]]
) -> None:
    assert said(text) == pieces
    data = bytes.fromhex("".join(hex_ for _, hex_ in pieces))
    assert read_hex(without_log(text)) == data
    entries = list(recordings.read(io.BytesIO(text.encode())))
    size = sum(len(bytes_of(entry.event)) for entry in entries)
    assert (size, entries[-1].offset + len(bytes_of(entries[-1].event))) == (len(data),) * 2
    # Who sends is known where each line says it.
    if all(way for way, _ in pieces):
        senders = {{"tx": "host", "rx": "controller"}[way] for way, _ in pieces}
        assert {entry.sender for entry in entries} == senders


@in_turn("text, line, problem", lambda: NO_LOGS)
def test_what_is_not_clear_is_refused_in_its_line(
    text: str, line: int, problem: str, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(RecordingError, match=rf"^line {line}: .*{problem}"):
        list(recordings.read(io.BytesIO(text.encode()), form="hex"))
    assert main(["decode", text]) == 2
    assert problem in capsys.readouterr().err
    assert main(["explain", text]) == 2
    assert problem in capsys.readouterr().err
    assert framegen_main(["explain", str(BUSSERVO), text]) == 2
    assert "Traceback" not in capsys.readouterr().err


@in_turn("text", lambda: [text for text, _ in HEX] + NO_HEX)
def test_hex_is_no_log(text: str) -> None:
    assert log_lines(text) is None
    assert without_log(text) == text


def test_the_command_says_times_and_senders(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["decode", "--json", BOTH]) == 0
    found = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert [(each["time"], each["from"]) for each in found] == [(0, "host"), (1, "controller")]
    assert main(["explain", "TX:", *STOP.split()]) == 0
    assert "ActionGroupStop" in capsys.readouterr().out
    assert framegen_main(["explain", str(BUSSERVO), f"[12:01:02] {STOP}"]) == 0


def test_lines_without_a_way_are_one_stream_of_the_given_end() -> None:
    text = "[23:59:59] 55 55\n[00:00:01.5] 02 07\n"
    # Either end may send such a message.
    for direction, sender in ((None, None), (Direction.HOST_TO_CONTROLLER, "host")):
        (entry,) = recordings.read(io.BytesIO(text.encode()), direction=direction)
        assert (entry.time, entry.line, entry.sender) == (2.5, 2, sender)


def test_a_clock_with_days_counts_them() -> None:
    text = "[2026-02-28 23:00:00] 55\n[2026-03-01T01:00:00.5] 02"
    log = log_lines(text)
    assert log is not None
    assert [log.read(line)[0][1] for line in text.split("\n")] == [0, 7200.5]
    with pytest.raises(LogError, match="2026-02-30 is no day"):
        log.read("[2026-02-30 23:00:00] 55")
