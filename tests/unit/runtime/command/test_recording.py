"""The verbs that read recordings: their times, their senders, and where they come from."""

from __future__ import annotations

import csv
import io
import json
import os
import subprocess
import sys
import time
from typing import TYPE_CHECKING

import pytest
from busservo import BatteryVoltage, BatteryVoltageRead
from busservo.__main__ import main
from framewire.command import recording
from framewire.command.progress import Progress
from framewire.command.progress_bar import progress_bar

from tests.commands import Terminal
from tests.programs import ran
from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from pathlib import Path

Capture = pytest.CaptureFixture[str]

ASK, VOLTAGE = BatteryVoltageRead().encode().hex(" "), BatteryVoltage(7500).encode().hex(" ")
STARTED = "55 55 05 06 08 01 00"
CUT_OFF = f"""\
# recorded of 'COM7' from 2026-01-02 23:59:59.750000 +0000 on
{ASK}  # 0.250000 s, host: BatteryVoltageRead()
{VOLTAGE}  # 0.375000 s, controller: BatteryVoltage(voltage_mv=7500)
55 55 05 08  # 1.250000 s, noise: too short
# quiet
{ASK}  # 2.000000 s, host: BatteryVoltageRead()
{STARTED}  # 2.500000 s, controller: ActionGroupStarted(group=8, times=1)
13  # 2.750000 s, either noise: bad header
"""
CUT = "noise       too short: ActionGroupCompleted with this length has 7 bytes | 55 55 05 08"
TOTALS = "26 bytes: 4 messages, 5 bytes of noise\n"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "line.hex"
    path.write_text(CUT_OFF)
    return path


@pytest.mark.parametrize(
    ("words", "times"),
    [
        ([], ["0.250000", "0.375000", "1.250000", "2.000000", "2.500000", "2.750000"]),
        (["-t", "zero"], ["0.250000", "0.375000", "1.250000", "2.000000", "2.500000", "2.750000"]),
        (["-t", "delta"], ["0.250000", "0.125000", "0.875000", "0.750000", "0.500000", "0.250000"]),
        (
            ["-t", "absolute"],
            [
                "00:00:00.000000",
                "00:00:00.125000",
                "00:00:01.000000",
                "00:00:01.750000",
                "00:00:02.250000",
                "00:00:02.500000",
            ],
        ),
    ],
)
def test_the_times_and_the_senders_of_a_recording_are_kept(
    log: Path, capsys: Capture, monkeypatch: pytest.MonkeyPatch, words: list[str], times: list[str]
) -> None:
    if hasattr(time, "tzset"):
        monkeypatch.setenv("TZ", "UTC")
        time.tzset()
    assert main(["decode", str(log), *words]) == 0
    output, errors = capsys.readouterr()
    assert errors == TOTALS
    assert output.splitlines() == [
        f"{at:>12}  {what}"
        for at, what in zip(
            times,
            [
                "host        BatteryVoltageRead | 55 55 02 0F",
                "controller  BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D",
                CUT,
                "host        BatteryVoltageRead | 55 55 02 0F",
                "controller  ActionGroupStarted group=8 times=1 | 55 55 05 06 08 01 00",
                "noise       bad header: a frame begins 55 55 | 13",
            ],
            strict=True,
        )
    ]


def test_each_of_several_recordings_has_a_time_of_its_own(log: Path, capsys: Capture) -> None:
    log.write_text(CUT_OFF + CUT_OFF.replace("2026", "2027", 1))
    assert main(["decode", str(log), "-t", "delta"]) == 0
    times = [line.split()[0] for line in capsys.readouterr().out.splitlines()]
    assert times == 2 * ["0.250000", "0.125000", "0.875000", "0.750000", "0.500000", "0.250000"]


def test_json_and_csv_say_the_same(log: Path, capsys: Capture) -> None:
    assert main(["decode", str(log), "--json"]) == 0
    records = [json.loads(line) for line in capsys.readouterr().out.splitlines()]
    assert records[2] == {
        "offset": 10,
        "time": 1.25,
        "from": "controller",
        "noise": "55 55 05 08",
        "reason": "too short",
    }
    assert records[4] == {
        "offset": 18,
        "time": 2.5,
        "from": "controller",
        "direction": "controller_to_host",
        "message": "ActionGroupStarted",
        "fields": {"group": 8, "times": 1},
        "hex": "55 55 05 06 08 01 00",
    }
    assert records[5]["from"] == "either"
    assert main(["decode", str(log), "--csv"]) == 0
    text = capsys.readouterr().out
    rows = [*csv.DictReader(io.StringIO(text, newline=""), strict=True)]
    for row, record in zip(rows, records, strict=True):
        assert int(row["offset"]) == record["offset"]
        assert float(row["time"]) == record["time"]
        assert (row["from"], row["message"]) == (record["from"], record.get("message", ""))
        assert (json.loads(row["fields"]) if row["fields"] else None) == record.get("fields")
        assert row["hex"] == record.get("hex", record.get("noise"))
        assert row["reason"] == record.get("reason", "")


def test_csv_marks_what_either_end_may_have_sent(capsys: Capture) -> None:
    assert main(["decode", STARTED, "--csv"]) == 0
    (row,) = csv.DictReader(io.StringIO(capsys.readouterr().out, newline=""))
    assert (row["time"], row["from"], row["message"], row["or"]) == (
        "",
        "either",
        "ActionGroupRun",
        "ActionGroupStarted",
    )


@pytest.mark.parametrize(
    ("text", "words", "expected"),
    [
        (ASK, ["-t", "delta"], "holds no times: the first column is the byte at which each begins"),
        (f"{ASK}  # 1 s, host: a", ["-t", "absolute"], "does not say when it began: times are sec"),
        (f"{ASK}  # 1 s, host: a", ["-t", "delta"], None),
        (ASK, [], None),
        ("", ["-t", "zero"], None),
    ],
)
def test_missing_times_are_reported(
    log: Path, capsys: Capture, text: str, words: list[str], expected: str | None
) -> None:
    log.write_text(text)
    assert main(["decode", str(log), *words]) == 0
    *notes, totals = capsys.readouterr().err.splitlines()
    assert [note.startswith(f"{log} {expected}") for note in notes] == (
        [] if expected is None else [True]
    )
    assert "noise" in totals


@pytest.mark.parametrize(
    ("data", "expected"),
    [
        ("55 55 01 07 01 20 03 E8 03 E8", "looks like the LX-16A bus servo protocol"),
        ("55 55 02 01 55 55 02 0D", "looks like the dialect of LeArm and uHand boards"),
        (b"$GPGGA,123519,N\r\n".hex(), 'is text: "$GPGGA,123519,N"'),
        ("55 55 02 01 55 55 04 0F 4C 1D", None),
        ("13 13 13", None),
    ],
)
def test_what_is_mostly_noise_may_be_another_protocol_or_text(
    capsys: Capture, data: str, expected: str | None
) -> None:
    assert main(["decode", data]) == 0
    _, *hints = capsys.readouterr().err.splitlines()
    assert hints == ([] if expected is None else [f"hint: most of it is noise; it {expected}"])


def test_a_pipe_that_pauses_within_a_byte_holds_hex_all_the_same() -> None:
    with subprocess.Popen(
        [sys.executable, "-m", "busservo", "decode", "--direction", "host"],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as decode:
        assert decode.stdin is not None
        assert decode.stdout is not None
        os.write(decode.stdin.fileno(), b"55 55 02 07\n5")
        # It has read that far, and has not waited for more to say so.
        assert decode.stdout.readline() == b"     0  host        ActionGroupStop | 55 55 02 07\n"
        rest, errors = decode.communicate(b"5 55 02 07", timeout=GENEROUS)
    assert rest.splitlines() == [b"     4  host        ActionGroupStop | 55 55 02 07"]
    assert errors.splitlines() == [b"8 bytes: 2 messages, 0 bytes of noise"]


def test_what_is_hex_at_first_and_then_is_not_is_refused(log: Path, capsys: Capture) -> None:
    log.write_bytes(bytes.fromhex(ASK).hex().encode() + b"\n\x00\x01")
    assert main(["decode", str(log)]) == 2
    errors = capsys.readouterr().err
    assert errors.startswith(f"busservo: error: {log}, line 2: no hex: '\\x00'")
    assert errors.endswith("raw bytes need --format raw, in Python form='raw'\n")
    assert main(["decode", str(log), "--format", "raw", "--strict"]) == 1


def test_a_recording_can_be_replayed_from_a_pipe(log: Path) -> None:
    words = ("-m", "busservo", "replay", "--dry-run", "--skip-noise", "-")
    shown = ran(sys.executable, *words, input=log.read_text())
    assert [line.split()[1:3] for line in shown.stdout.splitlines()] == 2 * [
        ["host", "BatteryVoltageRead"]
    ]
    left, totals = shown.stderr.splitlines()
    assert left == "left out: 2 frames of controller, 2 pieces of noise"
    assert totals.startswith("2 frames, 8 bytes in ")


@pytest.mark.parametrize(
    ("done", "size", "seconds", "expected"),
    [
        (0, 80_000_000, 0.0, "[....................]   0%  0.0 of 80.0 MB read"),
        (
            20_000_000,
            80_000_000,
            2.0,
            "[#####...............]  25%  20.0 of 80.0 MB read, 10.0 MB/s, 6 s left",
        ),
        (
            1_000_000,
            1_000_000_000,
            8.0,
            "[....................]   0%  1.0 of 1000.0 MB read, 0.1 MB/s, 2:13 h left",
        ),
        (
            8_000_000,
            80_000_000,
            8.4,
            "[##..................]  10%  8.0 of 80.0 MB read, 1.0 MB/s, 1:16 min left",
        ),
        (
            80_000_000,
            80_000_000,
            8.0,
            "[####################] 100%  80.0 of 80.0 MB read, 10.0 MB/s",
        ),
        # A file that grows while it is read.
        (90, 80, 0.1, "[####################] 100%  0.0 of 0.0 MB read"),
        (3_000_000, 0, 1.5, "3.0 MB read, 2.0 MB/s"),
    ],
)
def test_the_bar_shows_share_rate_and_time_left(
    done: int, size: int, seconds: float, expected: str
) -> None:
    assert progress_bar(done, size, seconds) == expected


def test_the_line_of_progress_leaves_room_for_what_ctrl_c_prints() -> None:
    terminal = Terminal()
    Progress(terminal).show(100 * "x")
    assert terminal.getvalue() == f"\r{77 * 'x'}"


def test_a_long_file_says_how_far_it_has_been_read(
    log: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(recording, "PROGRESS_INTERVAL", 0.0)
    monkeypatch.chdir(log.parent)
    log.write_text(CUT_OFF + 300_000 * "#\n")
    assert main(["decode", log.name]) == 0
    shown = terminal.getvalue()
    assert f"\r[##..................]  11%  0.1 of 0.6 MB read: {log.name}" in shown
    assert shown.endswith(f"\r{TOTALS}")
