"""`decode --parquet`, `--arrow`, `--csv-tables`: what the library makes, and nothing by halves."""

import csv
import io
import re
import sys
from datetime import datetime
from pathlib import Path
from typing import Any

import lxservo
import lxservo.__main__
import pytest
from busservo import ActionGroupStop, Direction, ServoPositions, ServoPositionsRead, tables
from busservo.__main__ import main
from framewire.command import csv_tables
from framewire.command import recording as reading
from framewire.tables.extra import are_there

from tests.commands import run
from tests.in_turn import in_turn

CAPTURES = Path(__file__).parents[3] / "captures"
CUT_OFF, NOISY = CAPTURES / "cut_off.hex", CAPTURES / "noisy_line.bin"
HOST: dict[str, Any] = {"direction": Direction.HOST_TO_CONTROLLER}

each_form = pytest.mark.parametrize("option", ["--parquet", "--arrow", "--csv-tables"])


def files_in(target: Path) -> dict[str, bytes]:
    files = [target] if target.is_file() else target.iterdir()
    return {file.name: file.read_bytes() for file in files}


def counts_in(output: str) -> dict[str, int]:
    """Return how many rows each table is said to have, by the name of its file or message."""
    found = re.findall(r"^  (\S+) +(\d+) rows?$", output, re.MULTILINE)
    return {Path(name).stem: int(count) for name, count in found}


@pytest.mark.parametrize(
    ("capture", "words", "how"),
    [(CUT_OFF, [], {}), (NOISY, [], {}), (NOISY, ["--direction", "host"], HOST)],
)
def test_files_hold_what_the_library_writes_and_the_totals_are_those_of_what_is_printed(
    tmp_path: Path, capture: Path, words: list[str], how: dict[str, Any]
) -> None:
    totals = run("decode", capture, *words, "--json").err
    folder, file = tmp_path / "tables", tmp_path / "line.arrow"
    rows = tables.write_parquet(capture, tmp_path / "expected", **how)
    status, output, errors = run("decode", capture, *words, "--parquet", folder)
    assert (status, counts_in(output), errors) == (0, rows, totals)
    assert files_in(folder) == files_in(tmp_path / "expected")
    assert tables.write_arrow(capture, tmp_path / "expected.arrow", **how) == rows
    status, output, errors = run("decode", capture, *words, "--arrow", file)
    assert (status, counts_in(output), errors) == (0, rows, totals)
    assert file.read_bytes() == (tmp_path / "expected.arrow").read_bytes()


def as_rows(file: Path) -> list[dict[str, str]]:
    return [*csv.DictReader(file.read_text("utf-8").splitlines(), strict=True)]


def test_csv_tables_have_as_many_rows_as_is_said_and_their_noise_adds_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Nothing but the standard library is needed, and however few rows are held, all are written.
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "numpy", None)
    monkeypatch.setattr(csv_tables, "_HELD", 5)
    folder = tmp_path / "deep" / "tables"
    # Into one folder: the tables of an earlier capture are replaced.
    for words in ([CUT_OFF], [NOISY], [NOISY, "--direction", "host"]):
        totals = run("decode", *words).err
        status, output, errors = run("decode", *words, "--csv-tables", folder)
        found = {file.stem: as_rows(file) for file in folder.iterdir()}
        assert (status, errors) == (0, totals)
        assert counts_in(output) == {name: len(rows) for name, rows in found.items()}
        noise = sum(int(row["size"]) for row in found.pop("noise"))
        assert f", {noise} byte{'' if noise == 1 else 's'} of noise" in totals
        events = {row["offset"] for rows in found.values() for row in rows}
        assert f": {len(events)} messages, " in totals


def test_a_csv_table_is_the_same_bytes_everywhere(tmp_path: Path) -> None:
    log, folder = tmp_path / "line.hex", tmp_path / "tables"
    events = [
        (ServoPositions([(1, 500), (7, 65535)]), "controller"),
        (ServoPositionsRead([3]), "host"),
        (ActionGroupStop(), "either"),
    ]
    lines = (
        f"{message.encode().hex(' ')}  # {at}.5 s, {who}: x\n"
        for at, (message, who) in enumerate(events)
    )
    began = "# recorded of 'COM7' from 2026-01-02 09:08:07.250000 +0000 on\n"
    log.write_text(began + "".join(lines))
    folder.mkdir()
    (folder / "ServoPositions.csv.part").write_text("what a stopped run has left")
    (folder / "ServoMove.csv").write_text("of an earlier capture")
    assert run("decode", log, "--csv-tables", folder).status == 0
    head, clock = b"offset,size,direction,time,clock", b"2026-01-02T09:08:%02d.750000Z"
    reply, request = b"controller_to_host", b"host_to_controller"
    found = {name: data.split(b"\r\n") for name, data in files_in(folder).items()}
    assert found == {
        "ServoPositions.csv": [
            head + b",index,positions.servo_id,positions.position",
            b"0,11,%s,0.500000,%s,0,1,500" % (reply, clock % 7),
            b"0,11,%s,0.500000,%s,1,7,65535" % (reply, clock % 7),
            b"",
        ],
        "ServoPositionsRead.csv": [
            head + b",index,servo_ids",
            b"11,6,%s,1.500000,%s,0,3" % (request, clock % 8),
            b"",
        ],
        "ActionGroupStop.csv": [head, b"17,4,,2.500000,%s" % (clock % 9), b""],
    }
    (row,) = as_rows(folder / "ServoPositionsRead.csv")
    assert datetime.fromisoformat(row["clock"].replace("Z", "+00:00")).timestamp() == 1767344888.75


def test_an_arrow_file_of_standard_input(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Pipe(io.BytesIO):
        def seekable(self) -> bool:
            return False

    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(Pipe(NOISY.read_bytes())))
    assert main(["decode", "--arrow", str(tmp_path / "a.arrow")]) == 0
    assert run("decode", NOISY, "--arrow", tmp_path / "b.arrow").status == 0
    assert (tmp_path / "a.arrow").read_bytes() == (tmp_path / "b.arrow").read_bytes()


def test_strict_tells_noise_by_the_exit_status(tmp_path: Path) -> None:
    assert run("decode", NOISY, "--strict", "--parquet", tmp_path / "a").status == 1
    assert run("decode", "55550207", "--strict", "--arrow", tmp_path / "b").status == 0
    assert run("decode", "555502", "--strict", "--arrow", tmp_path / "b").status == 1


@each_form
def test_a_capture_of_nothing_makes_no_table(tmp_path: Path, option: str) -> None:
    (tmp_path / "empty.bin").write_bytes(b"")
    ended = run("decode", tmp_path / "empty.bin", option, tmp_path / "out")
    assert ended == (0, "", "0 bytes: 0 messages, 0 bytes of noise\n")
    assert option == "--arrow" or files_in(tmp_path / "out") == {}


TO_HEX = "reads as bytes in hex: give"
TO_OUTPUT = "tables cannot be written to standard output: name"
HOLDS = "taken cannot be written: it holds 'notes.txt', which is no"


@in_turn(
    "words, expected",
    lambda: [
        ("--json --parquet t", "argument --parquet: not allowed with argument --json"),
        ("--parquet t --arrow f", "argument --arrow: not allowed with argument --parquet"),
        ("-t delta --arrow f", "-t is for what is printed; tables hold every time"),
        ("--parquet taken", HOLDS),
        ("--parquet taken/notes.txt", "taken/notes.txt cannot be written: it is a file, and"),
        ("--parquet 55550207", f"argument --parquet: '55550207' {TO_HEX}"),
        ("--arrow 0x55,0x55", f"argument --arrow: '0x55,0x55' {TO_HEX}"),
        ("--parquet -", f"argument --parquet: {TO_OUTPUT}"),
        ("--csv --csv-tables t", "argument --csv-tables: not allowed with argument --csv"),
        ("--csv-tables taken", HOLDS),
        ("--csv-tables taken/notes.txt", "a folder, as in `--csv-tables DIR taken/notes.txt`\n"),
        ("--csv-tables 55550207", f"argument --csv-tables: '55550207' {TO_HEX}"),
        ("--csv-tables -", f"argument --csv-tables: {TO_OUTPUT}"),
        ("--csv t", "--csv prints rows, and 't' is no input: --csv-tables t writes a folder"),
        ("--arrow -", f"argument --arrow: {TO_OUTPUT}"),
        ("--arrow taken", "taken cannot be written: it is a folder: name a file in it"),
        ("--arrow absent/line.arrow", "absent/line.arrow cannot be written: there is no fold"),
        ("--arrow taken/notes.txt", "taken/notes.txt cannot be written: it is there, and is"),
    ],
)
def test_a_target_that_cannot_be_used_is_reported_in_a_line(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, words: str, expected: str
) -> None:
    monkeypatch.chdir(tmp_path)
    notes = Path("taken", "notes.txt")
    notes.parent.mkdir(exist_ok=True)
    notes.write_text("mine")
    status, output, errors = run("decode", CUT_OFF, *words.split())
    assert (status, output) == (2, "")
    assert "busservo: error: " in errors
    assert expected in errors
    assert [*Path().rglob("*")] == [notes.parent, notes]
    assert notes.read_text() == "mine"


def test_the_capture_itself_is_never_overwritten(tmp_path: Path) -> None:
    line = tmp_path / "line.hex"
    line.write_text(CUT_OFF.read_text())
    assert "it is there, and is no Arrow file" in run("decode", line, "--arrow", line).err
    with pytest.raises(FileExistsError, match="give another name, or remove it"):
        tables.write_arrow(line, line)
    assert line.read_text() == CUT_OFF.read_text()


@each_form
def test_the_protocol_of_another_robot_is_recognised(tmp_path: Path, option: str) -> None:
    line = tmp_path / "line.bin"
    line.write_bytes(b"".join(lxservo.PositionRead(1 + at % 6).encode() for at in range(9)))
    hint = "hint: most of it is noise; it looks like the LX-16A bus servo protocol\n"
    status, _, errors = run("decode", line, option, tmp_path / "out")
    assert (status, errors) == (0, f"54 bytes: 0 messages, 54 bytes of noise\n{hint}")
    assert (run("stats", line).err, run("stats", NOISY).err) == (hint, "")


@each_form
def test_a_broken_recording_names_its_line_and_leaves_nothing(tmp_path: Path, option: str) -> None:
    log = tmp_path / "line.hex"
    log.write_text(CUT_OFF.read_text() + "55 5  # 9.0 s, host: what\n")
    count = len(log.read_text().splitlines())
    status, output, errors = run("decode", log, option, tmp_path / "out")
    assert (status, output) == (2, "")
    assert errors.startswith(f"busservo: error: {log}, line {count}: no hex: '5' is half a byte")
    assert [*tmp_path.iterdir()] == [log]


@each_form
def test_ctrl_c_leaves_what_was_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, option: str
) -> None:
    target = tmp_path / "out"
    assert run("decode", NOISY, option, target).status == 0
    before = files_in(target)

    def interrupted(self: reading.Recording, size: int) -> bytes:
        raise KeyboardInterrupt

    monkeypatch.setattr(reading.Recording, "read", interrupted)
    status, output, _ = run("decode", CUT_OFF, option, target)
    assert (status, output, files_in(target)) == (130, "", before)


def test_what_is_missing_is_said_once() -> None:
    with pytest.raises(ImportError, match="absent_package is needed here") as missing:
        are_there("absent_package", library="busservo")
    assert missing.value.__cause__ is None
    assert missing.value.__suppress_context__
