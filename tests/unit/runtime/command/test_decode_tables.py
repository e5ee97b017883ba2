"""`decode --parquet` and `--arrow`: the same events as printed, and nothing half-written."""

from __future__ import annotations

import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import lxservo
import lxservo.__main__
import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from busservo import BatteryVoltage, tables
from busservo.__main__ import main
from framewire.command import recording as reading
from framewire.tables.extra import are_there
from framewire.tables.files import parquet

from tests.commands import Terminal

Capture = pytest.CaptureFixture[str]

CAPTURES = Path(__file__).parents[3] / "captures"
CUT_OFF, NOISY = CAPTURES / "cut_off.hex", CAPTURES / "noisy_line.bin"


def printed(capsys: Capture, *words: str) -> tuple[list[dict[str, Any]], str]:
    """Return the events that `decode --json` prints, neighbouring noise joined, and its totals."""
    assert main(["decode", "--json", *words]) == 0
    output, errors = capsys.readouterr()
    events: list[dict[str, Any]] = []
    for event in map(json.loads, output.splitlines()):
        reasons = [_reason(each) for each in (*events[-1:], event)]
        if "time" in event or len(reasons) < 2 or None in reasons or len({*reasons}) > 1:
            events.append(event)
    return events, errors


def _reason(event: dict[str, Any]) -> str | None:
    """Return why an event is noise; None for messages and unknown frames."""
    return None if "parameters" in event else event.get("reason")


def rows_in(folder: Path) -> list[dict[str, Any]]:
    """Return the rows of all tables, in the order of the capture."""
    found = [
        row | {"table": file.stem}
        for file in folder.iterdir()
        for row in pq.read_table(file).to_pylist()
    ]
    return sorted(found, key=lambda row: row["offset"])


@pytest.mark.parametrize(
    "words", [[str(CUT_OFF)], [str(NOISY)], [str(NOISY), "--direction", "host"]]
)
def test_parquet_files_hold_what_is_printed(
    capsys: Capture, tmp_path: Path, words: list[str]
) -> None:
    events, totals = printed(capsys, *words)
    folder = tmp_path / "tables"
    assert main(["decode", *words, "--parquet", str(folder)]) == 0
    output, errors = capsys.readouterr()
    assert errors == totals
    rows = rows_in(folder)
    assert [row["offset"] for row in rows] == [event["offset"] for event in events]
    for row, event in zip(rows, events, strict=True):
        assert row["table"] == event.get("message", "noise")
        assert row.get("reason") == event.get("reason")
        assert row["time"] == event.get("time")
        for name, value in event.get("fields", {}).items():
            assert row[name] == value
    written = dict(re.findall(r"^  (\S+) +(\d+) rows?$", output, re.MULTILINE))
    assert written == {str(file): str(pq.read_metadata(file).num_rows) for file in folder.iterdir()}


def test_an_arrow_file_holds_what_is_printed(capsys: Capture, tmp_path: Path) -> None:
    events, totals = printed(capsys, str(NOISY))
    file = tmp_path / "line.arrow"
    assert main(["decode", str(NOISY), "--arrow", str(file)]) == 0
    output, errors = capsys.readouterr()
    assert errors == totals
    with pa.ipc.open_file(str(file)) as opened:
        rows = opened.read_all().to_pylist()
    assert [(row["offset"], row["reason"]) for row in rows] == [
        (event["offset"], event.get("reason")) for event in events
    ]
    for row, event in zip(rows, events, strict=True):
        if "message" in event:
            assert row["event"] == event["message"]
            assert (row.get(row["event"]) or {}) == event["fields"]
    assert sum(map(int, re.findall(r"(\d+) rows?$", output, re.MULTILINE))) == len(events)


def test_the_bytes_may_be_words_or_standard_input(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    frame = BatteryVoltage(7881).encode()
    folders = [tmp_path / name for name in "abc"]
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(frame)))
    assert main(["decode", *frame.hex(" ").split(), "--parquet", str(folders[0])]) == 0
    assert main(["decode", "-", "--parquet", str(folders[1])]) == 0
    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(frame.hex().encode())))
    assert main(["decode", "--format", "hex", "--parquet", str(folders[2])]) == 0
    assert capsys.readouterr().err == 3 * "6 bytes: 1 message, 0 bytes of noise\n"
    first, *others = [rows_in(folder) for folder in folders]
    assert [first[0]["voltage_mv"]] == [7881]
    assert others == [first, first]


def test_an_arrow_file_of_standard_input(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    class Pipe(io.BytesIO):
        def seekable(self) -> bool:
            return False

    monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(Pipe(NOISY.read_bytes())))
    assert main(["decode", "--arrow", str(tmp_path / "a.arrow")]) == 0
    assert main(["decode", str(NOISY), "--arrow", str(tmp_path / "b.arrow")]) == 0
    assert (tmp_path / "a.arrow").read_bytes() == (tmp_path / "b.arrow").read_bytes()


def test_strict_tells_noise_by_the_exit_status(capsys: Capture, tmp_path: Path) -> None:
    assert main(["decode", str(NOISY), "--strict", "--parquet", str(tmp_path / "a")]) == 1
    assert main(["decode", "55550207", "--strict", "--arrow", str(tmp_path / "b")]) == 0
    assert main(["decode", "555502", "--strict", "--arrow", str(tmp_path / "b")]) == 1


def test_other_protocols_are_written_too(capsys: Capture, tmp_path: Path) -> None:
    frame = lxservo.Position(servo_id=3, position=-7).encode()
    folder = tmp_path / "tables"
    assert lxservo.__main__.main(["decode", frame.hex(), "--parquet", str(folder)]) == 0
    (row,) = rows_in(folder)
    assert (row["table"], row["servo_id"], row["position"]) == ("Position", 3, -7)


def test_a_capture_of_nothing_makes_no_table(capsys: Capture, tmp_path: Path) -> None:
    empty = tmp_path / "empty.bin"
    empty.write_bytes(b"")
    assert main(["decode", str(empty), "--parquet", str(tmp_path / "tables")]) == 0
    assert main(["decode", str(empty), "--arrow", str(tmp_path / "file")]) == 0
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors == 2 * "0 bytes: 0 messages, 0 bytes of noise\n"
    assert [*(tmp_path / "tables").iterdir()] == []


@pytest.mark.parametrize(
    ("words", "expected"),
    [
        (["--json", "--parquet", "t"], "argument --parquet: not allowed with argument --json"),
        (["--parquet", "t", "--arrow", "f"], "argument --arrow: not allowed with argument --parq"),
        (["-t", "delta", "--arrow", "f"], "-t is for what is printed; tables hold every time"),
        (["--parquet", "taken"], "taken cannot be written: it holds 'notes.txt', which is no"),
        (["--parquet", "taken/notes.txt"], "taken/notes.txt cannot be written: it is a file, and"),
        (["--parquet", "55550207"], "argument --parquet: '55550207' reads as bytes in hex: give"),
        (["--arrow", "0x55,0x55"], "argument --arrow: '0x55,0x55' reads as bytes in hex: give "),
        (["--parquet", "-"], "argument --parquet: tables cannot be written to standard output"),
        (["--csv", "--csv-tables", "t"], "argument --csv-tables: not allowed with argument --csv"),
        (["--csv-tables", "taken"], "taken cannot be written: it holds 'notes.txt', which is no"),
        (
            ["--csv-tables", "taken/notes.txt"],
            "takes a folder, as in `--csv-tables DIR taken/notes.txt`\n",
        ),
        (["--csv-tables", "55550207"], "argument --csv-tables: '55550207' reads as bytes in hex:"),
        (["--csv-tables", "-"], "argument --csv-tables: tables cannot be written to standard outp"),
        (["--csv", "t"], "--csv prints rows, and 't' is no input: --csv-tables t writes a folder"),
        (["--arrow", "-"], "argument --arrow: tables cannot be written to standard output: name"),
        (["--arrow", "taken"], "taken cannot be written: it is a folder: name a file in it"),
        (["--arrow", "absent/line.arrow"], "absent/line.arrow cannot be written: there is no fold"),
        (["--arrow", "taken/notes.txt"], "taken/notes.txt cannot be written: it is there, and is"),
    ],
)
def test_a_target_that_cannot_be_used_is_reported_in_a_line(
    capsys: Capture,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    words: list[str],
    expected: str,
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "taken").mkdir()
    (tmp_path / "taken" / "notes.txt").write_text("mine")
    assert main(["decode", str(CUT_OFF), *words]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert "busservo: error: " in errors
    assert expected in errors
    assert [*tmp_path.rglob("*")] == [tmp_path / "taken", tmp_path / "taken" / "notes.txt"]
    assert (tmp_path / "taken" / "notes.txt").read_text() == "mine"


@pytest.mark.parametrize("option", ["--parquet", "--arrow", "--csv-tables"])
def test_a_name_that_is_hex_is_written_with_its_folder(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, option: str
) -> None:
    monkeypatch.chdir(tmp_path)
    assert main(["decode", "55550207", option, "./cafe"]) == 0
    assert [each.name for each in tmp_path.iterdir()] == ["cafe"]


def test_the_capture_itself_is_never_overwritten(capsys: Capture, tmp_path: Path) -> None:
    line = tmp_path / "line.hex"
    line.write_text(CUT_OFF.read_text())
    assert main(["decode", str(line), "--arrow", str(line)]) == 2
    assert "it is there, and is no Arrow file" in capsys.readouterr().err
    with pytest.raises(FileExistsError, match="give another name, or remove it"):
        tables.write_arrow(line, line)
    assert line.read_text() == CUT_OFF.read_text()


@pytest.mark.parametrize("option", ["--parquet", "--arrow", "--csv-tables"])
def test_the_protocol_of_another_robot_is_recognised(
    capsys: Capture, tmp_path: Path, option: str
) -> None:
    line = tmp_path / "line.bin"
    line.write_bytes(b"".join(lxservo.PositionRead(1 + at % 6).encode() for at in range(9)))
    assert main(["decode", str(line), option, str(tmp_path / "out")]) == 0
    hint = "hint: most of it is noise; it looks like the LX-16A bus servo protocol\n"
    assert capsys.readouterr().err == f"54 bytes: 0 messages, 54 bytes of noise\n{hint}"
    assert main(["stats", str(line)]) == 0
    assert capsys.readouterr().err == hint
    assert main(["stats", str(NOISY)]) == 0
    assert capsys.readouterr().err == ""


@pytest.mark.parametrize("option", ["--parquet", "--arrow", "--csv-tables"])
def test_a_broken_recording_names_its_line_and_leaves_nothing(
    capsys: Capture, tmp_path: Path, option: str
) -> None:
    log = tmp_path / "line.hex"
    log.write_text(CUT_OFF.read_text() + "55 5  # 9.0 s, host: what\n")
    count = len(log.read_text().splitlines())
    assert main(["decode", str(log), option, str(tmp_path / "out")]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.startswith(f"busservo: error: {log}, line {count}: no hex: '5' is half a byte")
    assert [*tmp_path.iterdir()] == [log]


@pytest.mark.parametrize("option", ["--parquet", "--arrow", "--csv-tables"])
def test_ctrl_c_leaves_what_was_there(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, option: str
) -> None:
    target = tmp_path / "out"
    assert main(["decode", str(NOISY), option, str(target)]) == 0
    files = [target] if target.is_file() else [*target.iterdir()]
    before = {file: file.read_bytes() for file in files}
    capsys.readouterr()

    def interrupted(self: reading.Recording, size: int) -> bytes:
        raise KeyboardInterrupt

    monkeypatch.setattr(reading.Recording, "read", interrupted)
    assert main(["decode", str(CUT_OFF), option, str(target)]) == 130
    assert capsys.readouterr().out == ""
    after = [target] if target.is_file() else [*target.iterdir()]
    assert {file: file.read_bytes() for file in after} == before


def test_a_full_disk_is_reported_and_leaves_nothing(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*arguments: object) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(parquet, "_writer", full)
    target = tmp_path / "tables"
    assert main(["decode", str(NOISY), "--parquet", str(target)]) == 2
    assert capsys.readouterr() == (
        "",
        f"busservo: error: {target} cannot be written: No space left on device\n",
    )
    assert not target.exists()


def test_without_the_extra_the_error_says_how_to_get_it(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    # As it is where nothing has imported them yet.
    names = [name for name in sys.modules if name.startswith("framewire.tables")]
    for name in (*names, "framewire.command.arrow_tables"):
        monkeypatch.delitem(sys.modules, name, raising=False)
    assert main(["decode", "55", "--parquet", str(tmp_path / "tables")]) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    assert errors.startswith("busservo: error: pyarrow is needed here, and cannot be imported")
    assert errors.endswith("pip install 'busservo[tables]'\n")
    # What needs no table still works.
    assert main(["decode", "55550207"]) == 0


def test_what_is_missing_is_said_once() -> None:
    with pytest.raises(ImportError, match="absent_package is needed here") as missing:
        are_there("absent_package", library="busservo")
    assert missing.value.__cause__ is None
    assert missing.value.__suppress_context__


def test_a_bar_shows_how_far_a_long_file_has_been_read(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    terminal = Terminal()
    monkeypatch.setattr(sys, "stderr", terminal)
    monkeypatch.setattr(reading, "PROGRESS_INTERVAL", 0.0)
    monkeypatch.chdir(tmp_path)
    Path("line.bin").write_bytes(BatteryVoltage(1).encode() * 50_000)
    assert main(["decode", "line.bin", "--parquet", "tables"]) == 0
    shown = terminal.getvalue()
    assert "\r[####################] 100%  0.3 of 0.3 MB read: line.bin" in shown
    assert shown.endswith("\r300000 bytes: 50000 messages, 0 bytes of noise\n")
