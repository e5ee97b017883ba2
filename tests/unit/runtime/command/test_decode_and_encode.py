"""`decode` and `encode`: where bytes come from, what is printed, and how far it has come."""

import csv
import io
import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, ServoUnload
from busservo.__main__ import main
from framewire.command import recording
from framewire.command.progress import Progress
from framewire.command.progress_bar import progress_bar

from tests.commands import Terminal, records, run
from tests.in_turn import in_turn
from tests.timeouts import GENEROUS

STOP = "55 55 02 07"
SHOWN = f"     0  host        ActionGroupStop | {STOP}\n"
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
SAID = [
    "host        BatteryVoltageRead | 55 55 02 0F",
    "controller  BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D",
    "noise       too short: ActionGroupCompleted with this length has 7 bytes | 55 55 05 08",
    "host        BatteryVoltageRead | 55 55 02 0F",
    "controller  ActionGroupStarted group=8 times=1 | 55 55 05 06 08 01 00",
    "noise       bad header: a frame begins 55 55 | 13",
]
TOTALS = "26 bytes: 4 messages, 5 bytes of noise\n"


@pytest.fixture
def log(tmp_path: Path) -> Path:
    path = tmp_path / "line.hex"
    path.write_text(CUT_OFF)
    return path


# ------------------------------------------------------------------ where bytes come from
def test_the_bytes_may_be_words_or_a_file_or_standard_input(tmp_path: Path) -> None:
    hexed, raw = tmp_path / "stop.log", tmp_path / "stop.bin"
    hexed.write_text(STOP)
    raw.write_bytes(bytes.fromhex(STOP))
    ways: list[list[object]] = [[hexed], [raw], ["--file", hexed], ["--file", raw], [STOP]]
    ways += [[*STOP.split()], [], ["-"], ["--file", "-"], ["--format", "raw"]]
    for words in ways:
        shown = run("decode", "--direction", "host", *words, given=raw.read_bytes())
        assert (shown.status, shown.out) == (0, SHOWN), words


def test_long_raw_input_is_read_in_pieces(tmp_path: Path) -> None:
    recorded = tmp_path / "long.bin"
    recorded.write_bytes(ServoUnload(range(200)).encode() * 1000)
    status, output, errors = run("decode", recorded)
    assert (status, output.count("ServoUnload servo_ids=0,1,2,")) == (0, 1000)
    assert "1000 messages, 0 bytes of noise" in errors


def test_a_pipe_that_pauses_within_a_byte_holds_hex_all_the_same() -> None:
    words = [sys.executable, "-m", "busservo", "decode", "--direction", "host"]
    pipe = subprocess.PIPE
    with subprocess.Popen(words, stdin=pipe, stdout=pipe, stderr=pipe) as decode:
        assert decode.stdin is not None
        assert decode.stdout is not None
        os.write(decode.stdin.fileno(), b"55 55 02 07\n5")
        # It has read that far, and has not waited for more to say so.
        assert decode.stdout.readline() == SHOWN.encode()
        rest, errors = decode.communicate(b"5 55 02 07", timeout=GENEROUS)
    assert rest.splitlines() == [b"     4  host        ActionGroupStop | 55 55 02 07"]
    assert errors.splitlines() == [b"8 bytes: 2 messages, 0 bytes of noise"]


def test_what_is_hex_at_first_and_then_is_not_is_refused(log: Path) -> None:
    log.write_bytes(ASK.encode() + b"\n\x00\x01")
    status, _, errors = run("decode", log)
    assert status == 2
    assert errors.startswith(f"busservo: error: {log}, line 2: no hex: '\\x00'")
    assert errors.endswith("raw bytes need --format raw, in Python form='raw'\n")
    assert run("decode", log, "--format", "raw", "--strict").status == 1


# ------------------------------------------------------------------ what is printed
ZERO = ["0.250000", "0.375000", "1.250000", "2.000000", "2.500000", "2.750000"]
DELTA = ["0.250000", "0.125000", "0.875000", "0.750000", "0.500000", "0.250000"]
SECONDS = ["0.000000", "0.125000", "1.000000", "1.750000", "2.250000", "2.500000"]


@pytest.mark.parametrize(
    ("words", "times"),
    [
        ([], ZERO),
        (["-t", "zero"], ZERO),
        (["-t", "delta"], DELTA),
        (["-t", "absolute"], [f"00:00:0{each}" for each in SECONDS]),
    ],
)
def test_the_times_and_the_senders_of_a_recording_are_kept(
    log: Path, monkeypatch: pytest.MonkeyPatch, words: list[str], times: list[str]
) -> None:
    if hasattr(time, "tzset"):
        monkeypatch.setenv("TZ", "UTC")
        time.tzset()
    lines = [f"{at:>12}  {what}\n" for at, what in zip(times, SAID, strict=True)]
    assert run("decode", log, *words) == (0, "".join(lines), TOTALS)


def test_each_of_several_recordings_has_a_time_of_its_own(log: Path) -> None:
    log.write_text(CUT_OFF + CUT_OFF.replace("2026", "2027", 1))
    lines = run("decode", log, "-t", "delta").out.splitlines()
    assert [line.split()[0] for line in lines] == 2 * DELTA


def as_csv(*words: object) -> list[dict[str, str]]:
    text = io.StringIO(run("decode", "--csv", *words).out, newline="")
    return [*csv.DictReader(text, strict=True)]


def test_json_and_csv_say_the_same(log: Path) -> None:
    found = records("decode", log, "--json")
    begun: list[dict[str, Any]] = [
        {"offset": 10, "time": 1.25, "from": "controller"},
        {"offset": 18, "time": 2.5, "from": "controller", "direction": "controller_to_host"},
    ]
    started = {"message": "ActionGroupStarted", "fields": {"group": 8, "times": 1}, "hex": STARTED}
    assert found[2] == {**begun[0], "noise": "55 55 05 08", "reason": "too short"}
    assert found[4] == {**begun[1], **started}
    assert found[5]["from"] == "either"
    for row, record in zip(as_csv(log), found, strict=True):
        assert int(row["offset"]) == record["offset"]
        assert float(row["time"]) == record["time"]
        assert (row["from"], row["message"]) == (record["from"], record.get("message", ""))
        assert (json.loads(row["fields"]) if row["fields"] else None) == record.get("fields")
        assert row["hex"] == record.get("hex", record.get("noise"))
        assert row["reason"] == record.get("reason", "")


@in_turn(
    "text, words, expected",
    lambda: [
        (ASK, ["-t", "delta"], "holds no times: the first column is the byte at which each begins"),
        (f"{ASK}  # 1 s, host: a", ["-t", "absolute"], "does not say when it began: times are sec"),
        (f"{ASK}  # 1 s, host: a", ["-t", "delta"], None),
        (ASK, [], None),
        ("", ["-t", "zero"], None),
    ],
)
def test_missing_times_are_reported(
    log: Path, text: str, words: list[str], expected: str | None
) -> None:
    log.write_text(text)
    status, _, errors = run("decode", log, *words)
    *notes, totals = errors.splitlines()
    assert (status, "noise" in totals) == (0, True)
    begins = [note.startswith(f"{log} {expected}") for note in notes]
    assert begins == ([] if expected is None else [True])


@in_turn(
    "data, expected",
    lambda: [
        ("55 55 01 07 01 20 03 E8 03 E8", "looks like the LX-16A bus servo protocol"),
        ("55 55 02 01 55 55 02 0D", "looks like the dialect of LeArm and uHand boards"),
        (b"$GPGGA,123519,N\r\n".hex(), 'is text: "$GPGGA,123519,N"'),
        ("55 55 02 01 55 55 04 0F 4C 1D", None),
        ("13 13 13", None),
    ],
)
def test_mostly_noise_may_be_another_protocol_or_text(data: str, expected: str | None) -> None:
    _, *hints = run("decode", data).err.splitlines()
    assert hints == ([] if expected is None else [f"hint: most of it is noise; it {expected}"])


def test_a_frame_can_be_hex_or_bytes_themselves(capfdbinary: pytest.CaptureFixture[bytes]) -> None:
    assert main(["encode", "action_group-stop"]) == 0
    assert capfdbinary.readouterr().out == f"{STOP}\n".encode()
    assert main(["encode", "--raw", "ActionGroupStop"]) == 0
    assert capfdbinary.readouterr().out == bytes.fromhex(STOP)


def test_numbers_may_have_any_base_and_values_their_names() -> None:
    shown = run("encode", "ServoMove", "time_ms=0x3E8", "targets=1:0b11,9:0o17").out
    assert shown == "55 55 0B 03 02 E8 03 01 03 00 09 0F 00\n"
    assert run("encode", "ServoPositions", "positions=1:absent").out.endswith("01 FF FF\n")


def test_without_a_verb_the_verbs_are_listed() -> None:
    status, output, errors = run()
    assert (status, output, "\nverbs:\n" in errors) == (2, "", True)
    status, _, errors = run("dcode")
    assert (status, "there is no verb 'dcode'; there are " in errors) == (2, True)


# ------------------------------------------------------------------ how far it has come
@in_turn(
    "done, size, seconds, share, said",
    lambda: [
        (0, 80_000_000, 0.0, "[....................]   0%  ", "0.0 of 80.0 MB read"),
        (
            *(20_000_000, 80_000_000, 2.0, "[#####...............]  25%  "),
            "20.0 of 80.0 MB read, 10.0 MB/s, 6 s left",
        ),
        (
            *(1_000_000, 1_000_000_000, 8.0, "[....................]   0%  "),
            "1.0 of 1000.0 MB read, 0.1 MB/s, 2:13 h left",
        ),
        (
            *(8_000_000, 80_000_000, 8.4, "[##..................]  10%  "),
            "8.0 of 80.0 MB read, 1.0 MB/s, 1:16 min left",
        ),
        (
            *(80_000_000, 80_000_000, 8.0, "[####################] 100%  "),
            "80.0 of 80.0 MB read, 10.0 MB/s",
        ),
        # A file that grows while it is read.
        (90, 80, 0.1, "[####################] 100%  ", "0.0 of 0.0 MB read"),
        (3_000_000, 0, 1.5, "", "3.0 MB read, 2.0 MB/s"),
    ],
)
def test_the_bar_shows_share_rate_and_time_left(
    done: int, size: int, seconds: float, share: str, said: str
) -> None:
    assert progress_bar(done, size, seconds) == share + said


def test_the_line_of_progress_leaves_room_for_what_ctrl_c_prints() -> None:
    terminal = Terminal()
    Progress(terminal).show(100 * "x")
    assert terminal.getvalue() == f"\r{77 * 'x'}"


def test_a_long_file_says_how_far_it_is_read(log: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(recording, "PROGRESS_INTERVAL", 0.0)
    monkeypatch.chdir(log.parent)
    log.write_text(CUT_OFF + 300_000 * "#\n")
    assert main(["decode", log.name]) == 0
    shown = terminal.getvalue()
    assert f"\r[##..................]  11%  0.1 of 0.6 MB read: {log.name}" in shown
    assert shown.endswith(f"\r{TOTALS}")
