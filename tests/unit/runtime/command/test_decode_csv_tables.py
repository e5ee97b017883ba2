"""`decode --csv-tables`: what is read back is what `decode --json` prints."""

from __future__ import annotations

import csv
import json
import sys
from datetime import datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

import lxservo
import lxservo.__main__
from busservo import ActionGroupStop, ServoPosition, ServoPositions, ServoPositionsRead
from busservo.__main__ import main
from framewire.command import csv_tables

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    import pytest

    Capture = pytest.CaptureFixture[str]

CAPTURES = Path(__file__).parents[3] / "captures"
BEGAN = "# recorded of 'COM7' from 2026-01-02 09:08:07.250000 +0000 on\n"


def read_back(folder: Path) -> Iterator[tuple[int, str, list[dict[str, str]]]]:
    """Yield the rows of each event, with its offset and its table, in the order of the capture."""
    events: dict[tuple[int, str], list[dict[str, str]]] = {}
    for file in folder.iterdir():
        data = file.read_bytes()
        assert data.count(b"\n") == data.count(b"\r\n")
        with file.open(encoding="utf-8", newline="") as stream:
            for row in csv.DictReader(stream, strict=True):
                events.setdefault((int(row["offset"]), file.stem), []).append(row)
    for (offset, table), rows in sorted(events.items()):
        yield offset, table, rows


def of_rows(rows: list[dict[str, str]]) -> dict[str, Any]:
    """Return the fields of an event as JSON has them, from its rows."""
    first, *_ = rows
    names = [*first][5:]
    if "index" not in names:
        return {name: int(first[name]) for name in names}
    fields: dict[str, Any] = {name: int(first[name]) for name in names[: names.index("index")]}
    for name in names[names.index("index") + 1 :]:
        path, _, part = name.partition(".")
        # An empty list has a row without an index.
        count = len(rows) if first["index"] else 0
        listed = fields.setdefault(path, [{} if part else None for _ in range(count)])
        for at, row in enumerate(rows[:count]):
            assert row["index"] == str(at)
            if part:
                listed[at][part] = int(row[name])
            else:
                listed[at] = int(row[name])
    return fields


def same_as_json(
    capsys: Capture, tmp_path: Path, words: list[str], run: Callable[[list[str]], int]
) -> None:
    assert run(["decode", "--json", *words]) == 0
    output, totals = capsys.readouterr()
    events = [json.loads(line) for line in output.splitlines()]
    folder = tmp_path / "deep" / "tables"
    assert run(["decode", *words, "--csv-tables", str(folder)]) == 0
    shown, errors = capsys.readouterr()
    assert errors == totals
    found = [*read_back(folder)]
    counts = {str(file): 0 for file in folder.iterdir()}
    noise = 0
    for offset, table, rows in found:
        (event,) = (each for each in events if each["offset"] == offset)
        counts[str(folder / f"{table}.csv")] += len(rows)
        assert table == event.get("message", "noise")
        assert float(rows[0]["time"] or -1) == event.get("time", -1)
        if table == "noise":
            (row,) = rows
            assert (row["reason"], row["unknown"]) == (
                event["reason"],
                str("parameters" in event).lower(),
            )
            assert row["parameters"] == event.get("parameters", "")
            noise += int(row["size"])
        else:
            assert of_rows(rows) == event["fields"]
    assert f", {noise} byte{'' if noise == 1 else 's'} of noise" in totals
    messages = [event for event in events if "message" in event]
    assert len(messages) == sum(table != "noise" for _, table, _ in found)
    printed = dict(line.split()[:2] for line in shown.splitlines())
    assert {name: int(count) for name, count in printed.items()} == counts


def test_what_is_read_back_is_what_json_says(
    capsys: Capture, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # Nothing but the standard library is needed, and however few rows are held, all are written.
    monkeypatch.setitem(sys.modules, "pyarrow", None)
    monkeypatch.setitem(sys.modules, "numpy", None)
    monkeypatch.setattr(csv_tables, "_HELD", 5)
    log = tmp_path / "bus.hex"
    bus = [
        lxservo.Move(servo_id=1, position=200, time_ms=100),
        lxservo.Position(servo_id=9, position=-5),
        lxservo.Voltage(servo_id=9, voltage_mv=6900),
    ]
    for at, each in enumerate(bus):
        with log.open("a") as stream:
            stream.write(
                f"{each.encode().hex(' ')}  # {at / 3:.6f} s, {each.DIRECTION.sender}: x\n"
            )
    bytes_of_bus = b"".join(each.encode() for each in bus).hex()
    rows = [
        ([str(CAPTURES / "cut_off.hex")], main),
        ([str(CAPTURES / "noisy_line.bin")], main),
        ([str(CAPTURES / "noisy_line.bin"), "--direction", "host"], main),
        ([str(log)], lxservo.__main__.main),
        ([bytes_of_bus], lxservo.__main__.main),
    ]
    # Into one folder: the tables of an earlier capture are replaced.
    for words, run in rows[:3]:
        same_as_json(capsys, tmp_path, words, run)
    for words, run in rows[3:]:
        same_as_json(capsys, tmp_path / "bus", words, run)


def test_a_file_is_the_same_bytes_everywhere(capsys: Capture, tmp_path: Path) -> None:
    log = tmp_path / "line.hex"
    events = [
        (ServoPositions([ServoPosition(1, 500), ServoPosition(7, 65535)]), "controller"),
        (ServoPositionsRead([3]), "host"),
        (ActionGroupStop(), "either"),
    ]
    log.write_text(
        BEGAN
        + "".join(
            f"{message.encode().hex(' ')}  # {at}.5 s, {who}: x\n"
            for at, (message, who) in enumerate(events)
        )
    )
    folder = tmp_path / "tables"
    folder.mkdir()
    stale = folder / "ServoPositions.csv.part"
    stale.write_text("what a stopped run has left")
    (folder / "ServoMove.csv").write_text("of an earlier capture")
    assert main(["decode", str(log), "--csv-tables", str(folder)]) == 0
    head, clock = b"offset,size,direction,time,clock", b"2026-01-02T09:08:%02d.750000Z"
    reply, request = b"controller_to_host", b"host_to_controller"
    assert {file.name: file.read_bytes().split(b"\r\n") for file in folder.iterdir()} == {
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
    read = folder / "ServoPositionsRead.csv"
    (row,) = csv.DictReader(read.read_text().splitlines())
    assert datetime.fromisoformat(row["clock"].replace("Z", "+00:00")).timestamp() == 1767344888.75
