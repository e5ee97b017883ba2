"""Files of a capture, Parquet and Arrow: all its tables, whole or not at all."""

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
from busservo.tables import NOISE, read, schemas, write_arrow, write_parquet
from framewire.tables.files import parquet

from tests.in_turn import in_turn
from tests.unit.runtime.tables.conversations import conversation, recorded

CAPTURE = conversation(40)
WAYS: dict[str, tuple[Any, dict[str, Any]]] = {
    "both ends": (CAPTURE, {}),
    "of the board": (CAPTURE, {"direction": Direction.CONTROLLER_TO_HOST}),
    "of the host": (CAPTURE, {"direction": Direction.HOST_TO_CONTROLLER}),
    "hex": (CAPTURE.hex(" ").encode(), {"form": "hex"}),
    "with times": (recorded(20).encode(), {}),
    "nothing": (b"", {"form": "raw"}),
}
EVENT = ["offset", "size", "direction", "time", "clock", "event", "reason"]


def files_in(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def events_in(file: Path) -> list[dict[str, Any]]:
    """Return the events in an Arrow file, with the columns that they need and no other."""
    with pa.ipc.open_file(file) as opened:
        events: list[dict[str, Any]] = opened.read_all().to_pylist()
    return [
        {name: value for name, value in event.items() if name in EVENT or value is not None}
        for event in events
    ]


def events_of(source: bytes, **how: Any) -> list[dict[str, Any]]:
    """Return the same events out of the tables."""
    events = []
    for name, table in read(source, **how).items():
        for row in table.to_pylist():
            event = {column: row.pop(column, None) for column in EVENT}
            fields = {"event": name}
            if name == NOISE and row.pop("unknown"):
                fields = {"event": "unknown", "unknown": row}
            elif name != NOISE and row:
                fields[name] = row
            events.append({**event, **fields})
    return sorted(events, key=lambda event: event["offset"])


@in_turn("way", lambda: WAYS)
def test_files_hold_the_tables_of_a_capture(way: str, tmp_path: Path) -> None:
    source, how = WAYS[way]
    folder, file = tmp_path / way / "tables", tmp_path / "line.arrow"
    tables = read(source, **how).filled
    rows = {name: table.num_rows for name, table in tables.items()}
    assert write_parquet(source, folder, **how) == rows
    assert files_in(folder) == sorted(f"{name}.parquet" for name in tables)
    for name, table in tables.items():
        assert pq.read_table(folder / f"{name}.parquet").to_pylist() == table.to_pylist()
    assert write_arrow(source, file, **how) == rows
    assert events_in(file) == events_of(source, **how)


# --- Parquet -------------------------------------------------------------------------------------
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


def test_row_groups_are_written_at_a_size(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
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


class Interrupted(io.BytesIO):
    """A stream that ends with Ctrl-C."""

    def read1(self, size: int | None = -1, /) -> bytes:
        if self.tell() > len(CAPTURE):
            raise KeyboardInterrupt
        return super().read1(size)


@pytest.mark.parametrize("is_new", [True, False])
@pytest.mark.parametrize(
    ("source", "error"),
    [
        (lambda: io.BytesIO(b"55 55 02 07\n" * 10000 + b"55 5Z"), RecordingError),
        (lambda: Interrupted(CAPTURE * 2000), KeyboardInterrupt),
    ],
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


# --- Arrow ---------------------------------------------------------------------------------------
def test_the_messages_that_occur_have_columns_in_the_order_of_the_spec(tmp_path: Path) -> None:
    write_arrow(CAPTURE, tmp_path / "line.arrow")
    with pa.ipc.open_file(tmp_path / "line.arrow") as opened:
        schema = opened.schema
    there = {"ActionGroupRun", "BatteryVoltage", "ServoPositions"}
    assert schema.names == [*EVENT, *(name for name in schemas() if name in there), "unknown"]
    voltage = schema.field("BatteryVoltage")
    assert voltage.type[0].metadata == schemas()["BatteryVoltage"].field("voltage_mv").metadata
    assert voltage.metadata[b"about"] == schemas()["BatteryVoltage"].metadata[b"summary"]


def test_what_comes_in_a_stream_is_read_twice_all_the_same(tmp_path: Path) -> None:
    rows = write_arrow(io.BytesIO(CAPTURE), tmp_path / "line.arrow")
    assert events_in(tmp_path / "line.arrow") == events_of(CAPTURE)
    (tmp_path / "line.bin").write_bytes(CAPTURE)
    assert write_arrow(tmp_path / "line.bin", tmp_path / "other.arrow") == rows
