"""One Arrow file of a capture: all events in order, a column of structs for each message."""

import io
from pathlib import Path
from typing import Any

import pyarrow as pa
import pytest
from busservo import Direction
from busservo._library import CODEC
from busservo.recordings import RecordingError
from busservo.tables import NOISE, read, read_batches, schemas, write_arrow
from framewire.tables.files.arrow_file import arrow_written
from framewire.tables.schema import schemas_of

from tests.unit.runtime.tables.conversations import conversation, recorded

CAPTURE = conversation(40)
EVENT = ["offset", "size", "direction", "time", "clock", "event", "reason"]


def events_in(file: Path) -> list[dict[str, Any]]:
    with pa.ipc.open_file(file) as opened:
        events: list[dict[str, Any]] = opened.read_all().to_pylist()
    return events


def events_of(source: bytes, **how: Any) -> list[dict[str, Any]]:
    """Return the same events out of the tables, with the columns that they need and no other."""
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


def without_absent(events: list[dict[str, Any]]) -> list[dict[str, Any]]:
    return [
        {name: value for name, value in event.items() if name in EVENT or value is not None}
        for event in events
    ]


@pytest.mark.parametrize("direction", [*Direction, None])
def test_it_has_the_events_of_all_tables_in_order(
    direction: Direction | None, tmp_path: Path
) -> None:
    file = tmp_path / "line.arrow"
    rows = write_arrow(CAPTURE, file, form="raw", direction=direction)
    assert without_absent(events_in(file)) == events_of(CAPTURE, form="raw", direction=direction)
    filled = read(CAPTURE, form="raw", direction=direction).filled
    assert rows == {name: table.num_rows for name, table in filled.items()}


def test_so_it_has_for_a_recording_with_times(tmp_path: Path) -> None:
    source = recorded(20).encode()
    write_arrow(source, tmp_path / "line.arrow")
    assert without_absent(events_in(tmp_path / "line.arrow")) == events_of(source)


def test_events_of_many_blocks_are_in_order(tmp_path: Path) -> None:
    batches = read_batches(CAPTURE * 10, form="raw", block=1000)
    arrow_written(schemas_of(CODEC), batches, tmp_path / "line.arrow", schemas())
    with pa.ipc.open_file(tmp_path / "line.arrow") as opened:
        assert opened.num_record_batches > 1
        table = opened.read_all()
    offsets, sizes = table["offset"].to_numpy(), table["size"].to_numpy()
    assert (offsets[1:] == offsets[:-1] + sizes[:-1]).all()


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
    assert rows == {name: table.num_rows for name, table in read(CAPTURE).filled.items()}
    assert sum(rows.values()) == len(events_in(tmp_path / "line.arrow"))
    (tmp_path / "line.bin").write_bytes(CAPTURE)
    assert write_arrow(tmp_path / "line.bin", tmp_path / "other.arrow") == rows
    assert events_in(tmp_path / "other.arrow") == events_in(tmp_path / "line.arrow")


def test_a_capture_of_nothing_is_a_file_without_rows(tmp_path: Path) -> None:
    assert write_arrow(b"", tmp_path / "line.arrow") == {}
    assert events_in(tmp_path / "line.arrow") == []


def test_a_broken_capture_leaves_the_file_of_before(tmp_path: Path) -> None:
    (tmp_path / "line.arrow").write_bytes(b"ARROW1 of before")
    with pytest.raises(RecordingError):
        write_arrow(b"55 55 5Z", tmp_path / "line.arrow")
    assert [path.name for path in tmp_path.iterdir()] == ["line.arrow"]
    assert (tmp_path / "line.arrow").read_bytes() == b"ARROW1 of before"


def test_a_folder_that_is_not_there_is_named(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError) as error:
        write_arrow(CAPTURE, tmp_path / "absent" / "line.arrow")
    assert str(tmp_path / "absent") in str(error.value)
