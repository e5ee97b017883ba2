"""Parquet files of a capture: its tables, whole or not at all."""

import errno
import io
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pyarrow as pa
import pyarrow.parquet as pq
import pytest
from busservo import Direction
from busservo.recordings import RecordingError
from busservo.tables import read, schemas, write_parquet
from framewire.tables.files import parquet

from tests.unit.runtime.tables.conversations import conversation, recorded

CAPTURE = conversation(40)
WAYS: dict[str, tuple[Any, dict[str, Any]]] = {
    "both ends": (CAPTURE, {}),
    "of the board": (CAPTURE, {"direction": Direction.CONTROLLER_TO_HOST}),
    "hex": (CAPTURE.hex(" ").encode(), {"form": "hex"}),
    "with times": (recorded(20).encode(), {}),
    "nothing": (b"", {"form": "raw"}),
}


def files_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.mark.parametrize("way", WAYS)
def test_each_table_with_rows_is_a_file(way: str, tmp_path: Path) -> None:
    source, how = WAYS[way]
    tables = read(source, **how).filled
    rows = write_parquet(source, tmp_path / "new" / "tables", **how)
    assert rows == {name: table.num_rows for name, table in tables.items()}
    assert files_in(tmp_path / "new" / "tables") == sorted(f"{name}.parquet" for name in tables)
    for name, table in tables.items():
        file = pq.read_table(tmp_path / "new" / "tables" / f"{name}.parquet")
        assert file.to_pylist() == table.to_pylist()


def test_names_and_units_are_kept(tmp_path: Path) -> None:
    write_parquet(CAPTURE, tmp_path)
    for path in tmp_path.iterdir():
        found, expected = pq.read_schema(path), schemas()[path.stem]
        assert found.metadata == expected.metadata
        for field in expected:
            assert _unnumbered(found.field(field.name)) == dict(field.metadata or {})
            if not pa.types.is_list(field.type):
                # An old PyArrow reads the words of any dictionary as numbered by int32.
                assert _worded(found.field(field.name).type) == _worded(field.type)


def _worded(kind: pa.DataType) -> pa.DataType:
    """Return a type, or that of the words of a dictionary."""
    return kind.value_type if pa.types.is_dictionary(kind) else kind


def _unnumbered(field: pa.Field) -> dict[bytes, bytes]:
    """Return the metadata of a field without the number that Parquet gives it."""
    return {name: text for name, text in (field.metadata or {}).items() if b"PARQUET" not in name}


def test_row_groups_are_written_when_so_much_is_held(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parquet, "_ROW_GROUP", 2000)
    batch = read(CAPTURE)["BatteryVoltage"].to_batches()[0]
    rows = parquet.parquet_written([*schemas()], [{"BatteryVoltage": batch}] * 10, tmp_path)
    file = pq.ParquetFile(tmp_path / "BatteryVoltage.parquet")
    assert rows == {"BatteryVoltage": 10 * batch.num_rows}
    assert file.metadata.num_rows == 10 * batch.num_rows
    assert 1 < file.num_row_groups < 10


def test_the_largest_table_is_written_when_all_hold_too_much(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(parquet, "_ALL_HELD", 3000)
    tables = read(CAPTURE)
    names = ["BatteryVoltage", "ServoPositions"]
    batches = [{name: tables[name].to_batches()[0] for name in names}] * 4
    parquet.parquet_written(names, batches, tmp_path)
    groups = {name: pq.ParquetFile(tmp_path / f"{name}.parquet").num_row_groups for name in names}
    assert groups["ServoPositions"] > 1


def test_files_of_an_earlier_capture_are_replaced(tmp_path: Path) -> None:
    write_parquet(CAPTURE, tmp_path)
    (tmp_path / "ServoMove.parquet.part").write_bytes(b"of a process that was stopped")
    rows = write_parquet(recorded(3).encode(), tmp_path)
    assert files_in(tmp_path) == ["BatteryVoltage.parquet", "BatteryVoltageRead.parquet"]
    assert rows == {"BatteryVoltageRead": 3, "BatteryVoltage": 3}


def test_a_folder_that_holds_something_else_is_left_alone(tmp_path: Path) -> None:
    (tmp_path / "thesis.txt").write_text("years of work", encoding="utf-8")
    with pytest.raises(FileExistsError, match=r"holds 'thesis\.txt'.*name another folder") as error:
        write_parquet(CAPTURE, tmp_path)
    assert error.value.filename == str(tmp_path)
    assert files_in(tmp_path) == ["thesis.txt"]


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "tables").write_bytes(b"")
    with pytest.raises(NotADirectoryError):
        write_parquet(CAPTURE, tmp_path / "tables")


def _broken_text() -> Any:
    return io.BytesIO(b"55 55 02 07\n" * 10000 + b"55 5Z")


def _interrupted() -> Any:
    class Stream(io.BytesIO):
        def read1(self, size: int | None = -1, /) -> bytes:
            if self.tell() > len(CAPTURE):
                raise KeyboardInterrupt
            return super().read1(size)

    return Stream(CAPTURE * 2000)


@pytest.mark.parametrize("is_new", [True, False])
@pytest.mark.parametrize(
    ("source", "error"), [(_broken_text, RecordingError), (_interrupted, KeyboardInterrupt)]
)
def test_nothing_is_half_written(
    source: Callable[[], Any], error: type[BaseException], tmp_path: Path, *, is_new: bool
) -> None:
    folder = tmp_path / "tables"
    if not is_new:
        folder.mkdir()
        (folder / "BatteryVoltage.parquet").write_bytes(b"of before")
    with pytest.raises(error):
        write_parquet(source(), folder)
    assert folder.exists() is not is_new
    assert is_new or files_in(folder) == ["BatteryVoltage.parquet"]


def test_a_full_disk_names_the_file(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_writer: object, _table: object) -> None:
        # As Arrow raises it.
        raise OSError(errno.ENOSPC, "Error writing bytes to file")

    monkeypatch.setattr(pq.ParquetWriter, "write_table", full)
    with pytest.raises(OSError, match="No space left on device") as error:
        write_parquet(CAPTURE, tmp_path / "tables")
    assert Path(error.value.filename).parent == tmp_path / "tables"
    assert files_in(tmp_path) == []
