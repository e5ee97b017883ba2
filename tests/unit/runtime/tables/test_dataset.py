"""A dataset of archived captures: the tables of each, whatever stopped or disturbed the work."""

from __future__ import annotations

import errno
import json
import os
import shutil
from contextlib import contextmanager
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING, Any
from urllib.parse import quote

import lxservo.tables
import pyarrow.dataset as ds
import pyarrow.parquet as pq
import pytest
from busservo.tables import Piece, Report, archive, read, scan
from framewire.tables.archive import dataset, manifest
from framewire.tables.archive.manifest import Manifest
from framewire.tables.files.parquet import ParquetFiles

from tests.rows import Rows
from tests.unit.runtime.tables.conversations import conversation, recorded

if TYPE_CHECKING:
    from collections.abc import Iterator

SIZE = 1000


@pytest.fixture
def captures(tmp_path: Path) -> Path:
    """Return a folder of captures, of which two have one name."""
    folder = tmp_path / "captures"
    (folder / "monday").mkdir(parents=True)
    (folder / "line.bin").write_bytes(conversation(60))
    (folder / "monday" / "line.bin").write_bytes(conversation(45))
    (folder / "line 1.hex").write_text(recorded(20), encoding="utf-8")
    (folder / "empty.bin").write_bytes(b"")
    return folder


def archived(captures: Path, folder: Path, size: int = SIZE) -> list[Report]:
    return [archive(piece, folder) for piece in scan(captures, size=size)]


def rows_in(folder: Path) -> dict[tuple[str, str], list[dict[str, Any]]]:
    """Return the rows of each table and capture, in the order of the capture."""
    rows: dict[tuple[str, str], list[dict[str, Any]]] = {}
    for table in sorted(path.name for path in folder.iterdir() if path.name != "_pieces"):
        found = ds.dataset(folder / table, partitioning="hive").to_table().to_pylist()
        for row in sorted(found, key=lambda row: int(row["offset"])):
            rows.setdefault((table, row.pop("capture")), []).append(row)
    return rows


def rows_of(captures: Path) -> dict[tuple[str, str], list[dict[str, Any]]]:
    """Return the same of the captures themselves."""
    return {
        (name, path.relative_to(captures).as_posix()): table.to_pylist()
        for path in captures.rglob("*")
        if path.is_file()
        for name, table in read(path).filled.items()
    }


def files_in(folder: Path) -> list[str]:
    return sorted(
        path.relative_to(folder).as_posix() for path in folder.rglob("*.*") if path.is_file()
    )


def test_it_holds_the_tables_of_all_captures(captures: Path, tmp_path: Path) -> None:
    reports = archived(captures, tmp_path / "dataset")
    assert len(reports) > 5
    assert rows_in(tmp_path / "dataset") == rows_of(captures)
    total = sum(len(rows) for rows in rows_of(captures).values())
    assert sum(sum(report.rows.values()) for report in reports) == total
    assert {(report.is_new, report.error) for report in reports} == {(True, None)}


def test_what_is_done_is_not_done_again(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first = archived(captures, tmp_path / "dataset")
    before = files_in(tmp_path / "dataset")
    monkeypatch.setattr(dataset, "_written", lambda *_: pytest.fail("it is written again"))
    again = archived(captures, tmp_path / "dataset")
    assert [report.rows for report in again] == [report.rows for report in first]
    assert not any(report.is_new for report in again)
    assert files_in(tmp_path / "dataset") == before


# --- What changes --------------------------------------------------------------------------------


def test_a_capture_that_has_changed_takes_the_place_of_what_it_was(
    captures: Path, tmp_path: Path
) -> None:
    archived(captures, tmp_path / "dataset")
    (captures / "line.bin").write_bytes(conversation(15)[100:])
    reports = archived(captures, tmp_path / "dataset")
    assert {report.piece.capture for report in reports if report.is_new} == {"line.bin"}
    assert rows_in(tmp_path / "dataset") == rows_of(captures)


def test_pieces_of_another_size_take_the_place_of_those_that_they_overlap(
    captures: Path, tmp_path: Path
) -> None:
    for size in (SIZE, 700, 4000):
        archived(captures, tmp_path / "dataset", size)
        assert rows_in(tmp_path / "dataset") == rows_of(captures)


def test_a_piece_of_what_a_file_was_is_refused(captures: Path, tmp_path: Path) -> None:
    pieces = scan(captures / "line.bin", size=SIZE)
    (captures / "line.bin").write_bytes(b"")
    errors = {archive(piece, tmp_path / "dataset").error for piece in pieces}
    file = captures / "line.bin"
    assert errors == {f"{file}: the file has changed since it was scanned: scan again"}


def test_a_capture_that_is_removed_stays_in_the_dataset(captures: Path, tmp_path: Path) -> None:
    archived(captures, tmp_path / "dataset")
    expected = rows_of(captures)
    (captures / "line.bin").unlink()
    archived(captures, tmp_path / "dataset")
    assert rows_in(tmp_path / "dataset") == expected


def test_what_was_written_with_other_tables_is_written_again(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    archived(captures, tmp_path / "dataset")
    monkeypatch.setattr(manifest, "_tables", lambda _codec: "those of another version")
    assert all(report.is_new for report in archived(captures, tmp_path / "dataset"))
    assert rows_in(tmp_path / "dataset") == rows_of(captures)


# --- What is broken ------------------------------------------------------------------------------


def test_a_broken_capture_is_reported_and_the_others_are_done(
    captures: Path, tmp_path: Path
) -> None:
    expected = rows_of(captures)
    (captures / "broken.hex").write_text("55 55 02 07\n55 5Z\n", encoding="utf-8")
    (captures / "gone.bin").symlink_to(captures / "absent.bin")
    reports = archived(captures, tmp_path / "dataset")
    errors = {report.piece.capture: report.error for report in reports if report.error}
    assert set(errors) == {"broken.hex", "gone.bin"}
    assert str(errors["broken.hex"]).startswith(f"{captures / 'broken.hex'}: line 2: no hex")
    assert errors["gone.bin"] == f"{captures / 'gone.bin'}: No such file or directory"
    assert rows_in(tmp_path / "dataset") == expected


def test_a_file_that_vanishes_is_reported(captures: Path, tmp_path: Path) -> None:
    (piece,) = scan(captures / "line 1.hex")
    (captures / "line 1.hex").unlink()
    report = archive(piece, tmp_path / "dataset")
    assert report.error == f"{captures / 'line 1.hex'}: No such file or directory"


def test_a_full_disk_is_reported_with_the_place_and_leaves_nothing(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_writer: object, _table: object) -> None:
        raise OSError(errno.ENOSPC, "Error writing bytes to file")

    (piece, *_) = scan(captures / "line.bin", size=SIZE)
    with monkeypatch.context() as patch:
        patch.setattr(pq.ParquetWriter, "write_table", full)
        report = archive(piece, tmp_path / "dataset")
    assert str(report.error).startswith(str(tmp_path / "dataset" / "_pieces"))
    assert str(report.error).endswith(".parquet: No space left on device")
    (left,) = (tmp_path / "dataset" / "_pieces").glob("*/*")
    assert left.suffix == ".json"
    assert archive(piece, tmp_path / "dataset").is_new


def test_a_dataset_that_cannot_be_written_is_reported(captures: Path, tmp_path: Path) -> None:
    (tmp_path / "dataset").write_bytes(b"")
    (piece, *_) = scan(captures / "line.bin", size=SIZE)
    report = archive(piece, tmp_path / "dataset")
    assert str(report.error).startswith(f"{tmp_path / 'dataset'}")
    assert not report.rows


def test_what_cannot_even_be_begun_leaves_nothing(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, *_: object, **__: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    monkeypatch.setattr(Path, "write_text", full)
    reports = archived(captures, tmp_path / "dataset")
    assert {report.error is None for report in reports} == {False}
    assert not [*tmp_path.glob("dataset/*/*/*")]


@pytest.mark.parametrize("data", [None, b""])
def test_files_that_were_lost_are_written_again(
    data: bytes | None, captures: Path, tmp_path: Path
) -> None:
    archived(captures, tmp_path / "dataset")
    (lost, *_) = sorted(tmp_path.glob("dataset/BatteryVoltage/*/*.parquet"))
    lost.unlink()
    if data is not None:
        lost.write_bytes(data)
    reports = archived(captures, tmp_path / "dataset")
    assert [report.is_new for report in reports].count(True) == 1
    assert rows_in(tmp_path / "dataset") == rows_of(captures)


def test_a_dataset_of_another_protocol_is_refused(captures: Path, tmp_path: Path) -> None:
    archived(captures, tmp_path / "dataset")
    for piece in lxservo.tables.scan(captures):
        report = lxservo.tables.archive(piece, tmp_path / "dataset")
        said = "it holds captures of busservo: name another folder"
        assert report.error == f"{tmp_path / 'dataset'}: {said}"
    assert rows_in(tmp_path / "dataset") == rows_of(captures)


def test_a_manifest_that_makes_no_sense_is_none(captures: Path, tmp_path: Path) -> None:
    archived(captures, tmp_path / "dataset")
    for path in (tmp_path / "dataset" / "_pieces").rglob("*.json"):
        path.write_text("{", encoding="utf-8")
    assert all(report.is_new for report in archived(captures, tmp_path / "dataset"))
    assert rows_in(tmp_path / "dataset") == rows_of(captures)


# JSON that is no manifest of a piece, and what a manifest may be changed to.
NO_MANIFESTS: list[Any] = ["", 7, True, [], [[]], {}, {"rows": {}}, {"library": 7}]
CHANGES = [
    {"rows": 5},
    {"rows": []},
    {"rows": {"BatteryVoltage": "3"}},
    {"rows": {"BatteryVoltage": True}},
    {"sizes": None},
    {"sizes": 7},
    {"capture": 7},
    {"start": "0"},
    {"end": None},
    {"stamp": "now"},
    {"direction": 1},
]


@pytest.mark.parametrize("wrong", [*NO_MANIFESTS, *CHANGES], ids=str)
def test_a_damaged_manifest_is_a_broken_piece(wrong: Any, tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(3))
    (tmp_path / "other.bin").write_bytes(conversation(3))
    folder = tmp_path / "dataset"
    pieces = scan([tmp_path / "line.bin", tmp_path / "other.bin"])
    done = [archive(piece, folder) for piece in pieces]
    (file,) = (folder / "_pieces" / "capture=line.bin").glob("*.json")
    said = json.loads(file.read_text(encoding="utf-8"))
    file.write_text(json.dumps({**said, **wrong} if wrong in CHANGES else wrong), encoding="utf-8")
    broken, whole = (archive(piece, folder) for piece in pieces)
    assert broken.error is not None
    assert broken.error.startswith(f"{file}: it is damaged")
    assert broken.error.endswith("remove it, and the piece is done again")
    assert whole.rows == done[1].rows
    # The way out that it names.
    file.unlink()
    assert archive(pieces[0], folder).rows == done[0].rows
    assert len(files_in(folder / "BatteryVoltage")) == 2


def test_a_damaged_manifest_of_another_piece_is_replaced(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(60))
    folder = tmp_path / "dataset"
    archived(tmp_path / "line.bin", folder)
    for file in (folder / "_pieces" / "capture=line.bin").glob("*.json"):
        file.write_text("[]", encoding="utf-8")
    (whole,) = archived(tmp_path / "line.bin", folder, size=1 << 20)
    assert whole.error is None
    assert rows_in(folder) == {
        (name, "line.bin"): table.to_pylist()
        for name, table in read(tmp_path / "line.bin").filled.items()
    }


@pytest.mark.parametrize("wrong", NO_MANIFESTS, ids=str)
def test_a_dataset_that_does_not_tell_its_protocol_is_refused(wrong: Any, tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(3))
    (piece,) = scan(tmp_path / "line.bin")
    file = tmp_path / "dataset" / "_pieces" / "library.json"
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps(wrong), encoding="utf-8")
    report = archive(piece, tmp_path / "dataset")
    problem = "it is damaged, and does not tell whose captures the dataset holds"
    assert report.error == f"{file}: {problem}: remove it if they are of busservo"
    file.unlink()
    assert archive(piece, tmp_path / "dataset").is_new


def test_a_manifest_without_end_is_none(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(3))
    archived(tmp_path / "line.bin", tmp_path / "dataset")
    (file,) = (tmp_path / "dataset" / "_pieces" / "capture=line.bin").glob("*.json")
    file.write_text("[" * 100_000, encoding="utf-8")
    (report,) = archived(tmp_path / "line.bin", tmp_path / "dataset")
    assert report.is_new


# --- What is stopped -----------------------------------------------------------------------------


class Killed(BaseException):
    """Stands for the end of a process: nothing is tidied up behind it."""


TOUCHING = {name: getattr(Path, name) for name in ("replace", "unlink", "mkdir", "write_text")}


@contextmanager
def killed_at(number: int) -> Iterator[None]:
    """Stop the work when a file is touched for the n-th time."""
    touched = count()

    def touching(name: str) -> Any:
        def touch(path: Path, *given: Any, **named: Any) -> Any:
            if next(touched) == number:
                raise Killed
            return TOUCHING[name](path, *given, **named)

        return touch

    with pytest.MonkeyPatch.context() as patch:
        for name in TOUCHING:
            patch.setattr(Path, name, touching(name))
        patch.setattr(ParquetFiles, "discard", lambda _files: None)
        patch.setattr(shutil, "rmtree", lambda *_, **__: None)
        yield


@pytest.mark.parametrize("step", Rows([8], others=[1]))
@pytest.mark.parametrize("is_second", [False, True])
def test_work_that_was_stopped_anywhere_is_done_by_doing_it_again(
    captures: Path, tmp_path: Path, step: int, *, is_second: bool
) -> None:
    shutil.rmtree(captures)
    captures.mkdir()
    folder = tmp_path / "dataset"
    for number in count(0, step):
        shutil.rmtree(folder, ignore_errors=True)
        (captures / "line.bin").write_bytes(conversation(8)[number:])
        if is_second:
            archived(captures, folder, 200)
            (captures / "line.bin").write_bytes(conversation(8)[number + 1 :])
        try:
            with killed_at(number):
                archived(captures, folder, 250)
        except Killed:
            pass
        else:
            break
        # Whatever is there under its final name is whole.
        for path in folder.glob("*/capture=*/*.parquet"):
            if path.parent.parent.name != "_pieces":
                assert pq.read_metadata(path).num_rows
        if is_second:
            (captures / "line.bin").write_bytes(conversation(8)[number + 2 :])
        archived(captures, folder, 250)
        assert rows_in(folder) == rows_of(captures)
    assert number > 20


def test_two_workers_at_one_piece_do_no_harm(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "dataset"
    (piece, *others) = scan(captures / "line.bin", size=SIZE)
    begun = Manifest.begin
    reports: list[Report] = []

    def begin(manifest: Manifest) -> Path:
        unfinished = begun(manifest)
        # While this one works, another does the same from beginning to end.
        monkeypatch.setattr(Manifest, "begin", begun)
        reports.append(archive(piece, folder))
        return unfinished

    monkeypatch.setattr(Manifest, "begin", begin)
    reports.append(archive(piece, folder))
    assert [report.error for report in reports] == [None, None]
    assert reports[0].rows == reports[1].rows
    for other in others:
        archive(other, folder)
    expected = {key: rows for key, rows in rows_of(captures).items() if key[1] == "line.bin"}
    assert rows_in(folder) == expected


# --- What is said --------------------------------------------------------------------------------


def test_a_report_says_what_became_of_a_piece() -> None:
    piece = Piece("/c/line.bin", "line.bin", 0, 1_500_000, "raw", None, (1_500_000, 1))
    rows = {"BatteryVoltage": 3, "noise": 1}
    said = [
        str(Report(piece, rows, 0.5, is_new=True)),
        str(Report(piece, rows)),
        str(Report(piece, error="/c/line.bin: No such file or directory")),
    ]
    assert said == [
        "line.bin[0:1500000]: 4 rows, 1.5 MB in 0.5 s",
        "line.bin[0:1500000]: 4 rows, done before",
        "line.bin[0:1500000]: error: /c/line.bin: No such file or directory",
    ]


def test_a_name_that_controls_the_screen_is_escaped_when_it_is_printed(tmp_path: Path) -> None:
    names = {
        "a\x1b[31m.bin": r"a\x1b[31m.bin",
        "a\nb.bin": r"a\nb.bin",
        "\u202ea.bin": r"\u202ea.bin",
    }
    for name, shown in names.items():
        piece = Piece(f"/c/{name}", name, 0, 7, "raw", None, (7, 1))
        report = archive(piece, tmp_path / "dataset")
        assert str(piece) == f"{shown}[0:7]"
        assert str(report) == f"{shown}[0:7]: error: /c/{shown}: No such file or directory"
        assert report.error == f"/c/{name}: No such file or directory"


NAMES = ["ü ß.bin", "a=b&c%20.bin", "x" * 120 + "ö" * 60, "x" * 121 + "線" * 40, "a\udcff.bin"]


@pytest.mark.parametrize("name", NAMES)
def test_a_capture_may_have_any_name(name: str, tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(3))
    (piece,) = scan(tmp_path / "line.bin")
    assert archive(replace(piece, capture=name), tmp_path / "dataset").is_new
    ((_, capture), *_) = rows_in(tmp_path / "dataset")
    seen = name.replace("\udcff", "\\udcff")
    assert capture == seen or (capture.startswith(seen[:120]) and len(quote(name, "")) > 200)


def test_captures_that_share_a_folder_keep_their_pieces(
    captures: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # As on a disk on which small letters are large ones.
    monkeypatch.setattr(manifest, "_file_name", str.lower)
    (captures / "LINE.bin").write_bytes(conversation(45))
    for _ in range(2):
        reports = archived(captures, tmp_path / "dataset")
    assert not any(report.is_new for report in reports)


def test_long_names_that_begin_alike_are_told_apart(tmp_path: Path) -> None:
    folder = tmp_path / "captures" / ("long" * 30)
    folder.mkdir(parents=True)
    for name in ("first", "second"):
        (folder / f"{'name' * 30}{name}.bin").write_bytes(conversation(1))
    archived(tmp_path / "captures", tmp_path / "dataset")
    captures = {capture for _, capture in rows_in(tmp_path / "dataset")}
    assert len(captures) == 2
