"""A dataset of archived captures: the tables of each, whatever stopped or disturbed the work."""

import errno
import json
import os
import shutil
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from itertools import count
from pathlib import Path
from typing import Any
from urllib.parse import quote

import lxservo.tables
import pyarrow.dataset as ds
import pyarrow.parquet as pq
import pytest
from busservo.tables import Piece, Report, archive, read, scan
from framewire.tables.archive import manifest
from framewire.tables.archive.manifest import Manifest
from framewire.tables.files.parquet import ParquetFiles

from tests.in_turn import in_turn
from tests.rows import Rows
from tests.unit.runtime.tables.conversations import conversation, recorded

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


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    return tmp_path / "dataset"


@pytest.fixture
def line(tmp_path: Path) -> Path:
    """Return a short capture beside the dataset, which is one piece."""
    file = tmp_path / "line.bin"
    file.write_bytes(conversation(3))
    return file


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


# --- What changes --------------------------------------------------------------------------------
def test_pieces_of_another_size_replace_those_that_they_overlap(
    captures: Path, folder: Path
) -> None:
    for size in (SIZE, 700, 4000):
        archived(captures, folder, size)
        assert rows_in(folder) == rows_of(captures)


def test_a_piece_of_what_a_file_was_is_refused(captures: Path, folder: Path) -> None:
    file = captures / "line.bin"
    pieces = scan(file, size=SIZE)
    file.write_bytes(b"")
    errors = {archive(piece, folder).error for piece in pieces}
    assert errors == {f"{file}: the file has changed since it was scanned: scan again"}


def test_a_capture_that_is_removed_stays_in_the_dataset(captures: Path, folder: Path) -> None:
    archived(captures, folder)
    expected = rows_of(captures)
    (captures / "line.bin").unlink()
    archived(captures, folder)
    assert rows_in(folder) == expected


def test_what_was_written_with_other_tables_is_written_again(
    captures: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    archived(captures, folder)
    monkeypatch.setattr(manifest, "_tables", lambda _codec: "those of another version")
    assert all(report.is_new for report in archived(captures, folder))
    assert rows_in(folder) == rows_of(captures)


# --- What is broken ------------------------------------------------------------------------------
def test_a_broken_capture_is_reported_and_the_others_are_done(captures: Path, folder: Path) -> None:
    expected = rows_of(captures)
    broken, gone = captures / "broken.hex", captures / "gone.bin"
    broken.write_text("55 55 02 07\n55 5Z\n", encoding="utf-8")
    gone.symlink_to(captures / "absent.bin")
    reports = archived(captures, folder)
    errors = {report.piece.capture: report.error for report in reports if report.error}
    assert str(errors.pop("broken.hex")).startswith(f"{broken}: line 2: no hex")
    assert errors == {"gone.bin": f"{gone}: No such file or directory"}
    assert rows_in(folder) == expected


def test_a_full_disk_is_reported_with_the_place_and_leaves_nothing(
    line: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(_writer: object, _table: object) -> None:
        raise OSError(errno.ENOSPC, "Error writing bytes to file")

    (piece,) = scan(line)
    with monkeypatch.context() as patch:
        patch.setattr(pq.ParquetWriter, "write_table", full)
        error = str(archive(piece, folder).error)
    assert error.startswith(str(folder / "_pieces"))
    assert error.endswith(".parquet: No space left on device")
    (left,) = (folder / "_pieces").glob("*/*")
    assert left.suffix == ".json"
    assert archive(piece, folder).is_new


def test_what_cannot_even_be_begun_leaves_nothing(
    captures: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, *_: object, **__: object) -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), str(path))

    monkeypatch.setattr(Path, "write_text", full)
    assert all(report.error for report in archived(captures, folder))
    assert not [*folder.glob("*/*/*")]


def test_a_dataset_of_another_protocol_is_refused(captures: Path, folder: Path) -> None:
    archived(captures, folder)
    for piece in lxservo.tables.scan(captures):
        report = lxservo.tables.archive(piece, folder)
        assert report.error == f"{folder}: it holds captures of busservo: name another folder"
    assert rows_in(folder) == rows_of(captures)


def manifests_of(folder: Path, capture: str = "*") -> list[Path]:
    return [*(folder / "_pieces").glob(f"capture={capture}/*.json")]


# One file that is lost or damaged, of those that a pattern fits; what it holds then.
LOST = [
    ("BatteryVoltage/*/*.parquet", None),
    ("BatteryVoltage/*/*.parquet", ""),
    ("_pieces/*/*.json", "{"),
    ("_pieces/*/*.json", "[" * 100_000),
]


@in_turn("pattern, text", lambda: LOST)
def test_what_was_lost_is_written_again(
    pattern: str, text: str | None, captures: Path, folder: Path
) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    archived(captures, folder)
    lost = min(folder.glob(pattern))
    lost.unlink()
    if text is not None:
        lost.write_text(text)
    reports = archived(captures, folder)
    assert [report.is_new for report in reports].count(True) == 1
    assert rows_in(folder) == rows_of(captures)


# JSON that is no manifest of a piece, and what a manifest may be changed to.
NO_MANIFESTS: list[Any] = ["", 7, True, [], [[]], {}, {"rows": {}}, {"library": 7}]
CHANGES: list[dict[str, Any]] = [
    *({"rows": 5}, {"rows": []}, {"rows": {"noise": "3"}}, {"rows": {"noise": True}}),
    *({"sizes": None}, {"sizes": 7}, {"capture": 7}, {"start": "0"}, {"end": None}),
    *({"stamp": "now"}, {"direction": 1}),
]


@in_turn("wrong", lambda: [*NO_MANIFESTS, *CHANGES])
def test_a_damaged_manifest_is_a_broken_piece(wrong: Any, line: Path, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    shutil.copy(line, line.with_name("other.bin"))
    pieces = scan([line, line.with_name("other.bin")])
    done = [archive(piece, folder) for piece in pieces]
    (file,) = manifests_of(folder, "line.bin")
    said = json.loads(file.read_text(encoding="utf-8"))
    file.write_text(json.dumps({**said, **wrong} if wrong in CHANGES else wrong), encoding="utf-8")
    broken, whole = (archive(piece, folder) for piece in pieces)
    assert str(broken.error).startswith(f"{file}: it is damaged")
    assert str(broken.error).endswith("remove it, and the piece is done again")
    assert whole.rows == done[1].rows
    # The way out that it names.
    file.unlink()
    assert archive(pieces[0], folder).rows == done[0].rows
    assert len(files_in(folder / "BatteryVoltage")) == 2


def test_a_damaged_manifest_of_another_piece_is_replaced(line: Path, folder: Path) -> None:
    line.write_bytes(conversation(60))
    archived(line, folder)
    for file in manifests_of(folder, "line.bin"):
        file.write_text("[]", encoding="utf-8")
    (whole,) = archived(line, folder, size=1 << 20)
    assert whole.error is None
    tables = read(line).filled
    assert rows_in(folder) == {(name, "line.bin"): tables[name].to_pylist() for name in tables}


@in_turn("wrong", lambda: NO_MANIFESTS)
def test_a_dataset_of_an_unknown_protocol_is_refused(wrong: Any, line: Path, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    (piece,) = scan(line)
    file = folder / "_pieces" / "library.json"
    file.parent.mkdir(parents=True)
    file.write_text(json.dumps(wrong), encoding="utf-8")
    problem = "it is damaged, and does not tell whose captures the dataset holds"
    assert archive(piece, folder).error == f"{file}: {problem}: remove it if they are of busservo"
    file.unlink()
    assert archive(piece, folder).is_new


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
    tmp_path: Path, step: int, *, is_second: bool
) -> None:
    captures, folder = tmp_path / "captures", tmp_path / "dataset"
    captures.mkdir()
    line = captures / "line.bin"
    for number in count(0, step):
        shutil.rmtree(folder, ignore_errors=True)
        line.write_bytes(conversation(8)[number:])
        if is_second:
            archived(captures, folder, 200)
            line.write_bytes(conversation(8)[number + 1 :])
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
            line.write_bytes(conversation(8)[number + 2 :])
        archived(captures, folder, 250)
        assert rows_in(folder) == rows_of(captures)
    assert number > 20


def test_two_workers_at_one_piece_do_no_harm(
    captures: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
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
    error = "/c/line.bin: No such file or directory"
    said = {
        "4 rows, 1.5 MB in 0.5 s": Report(piece, rows, 0.5, is_new=True),
        "4 rows, done before": Report(piece, rows),
        f"error: {error}": Report(piece, error=error),
    }
    for text, report in said.items():
        assert str(report) == f"line.bin[0:1500000]: {text}"


@in_turn("name", lambda: ["a\x1b[31m.bin", "a\nb.bin", "\u202ea.bin"])
def test_a_name_that_controls_the_screen_is_escaped_when_printed(name: str, folder: Path) -> None:
    piece = Piece(f"/c/{name}", name, 0, 7, "raw", None, (7, 1))
    report, shown = archive(piece, folder), name.encode("unicode_escape").decode()
    assert str(piece) == f"{shown}[0:7]"
    assert str(report) == f"{shown}[0:7]: error: /c/{shown}: No such file or directory"
    assert report.error == f"/c/{name}: No such file or directory"


NAMES = ["ü ß.bin", "a=b&c%20.bin", "x" * 120 + "ö" * 60, "x" * 121 + "線" * 40, "a\udcff.bin"]


@in_turn("name", lambda: NAMES)
def test_a_capture_may_have_any_name(name: str, line: Path, folder: Path) -> None:
    shutil.rmtree(folder, ignore_errors=True)
    (piece,) = scan(line)
    # Names that begin alike are told apart, however long they are.
    for capture in (name, f"{name}2"):
        assert archive(replace(piece, capture=capture), folder).is_new
    captures = {capture for _, capture in rows_in(folder)}
    assert len(captures) == 2
    seen = name.replace("\udcff", "\\udcff")
    is_long = len(quote(seen, "")) > 200
    for capture in captures:
        assert capture in (seen, f"{seen}2") or (is_long and capture.startswith(seen[:120]))


def test_captures_that_share_a_folder_keep_their_pieces(
    captures: Path, folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    # As on a disk on which small letters are large ones.
    monkeypatch.setattr(manifest, "_file_name", str.lower)
    (captures / "LINE.bin").write_bytes(conversation(45))
    archived(captures, folder)
    assert not any(report.is_new for report in archived(captures, folder))
