"""What others read of our tables: pandas, polars and DuckDB, which no other test imports."""

from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import Any

import pyarrow as pa
from busservo.tables import archive, scan, write_arrow

from tests.in_turn import in_turn
from tests.unit.runtime.tables.conversations import conversation

NAMES = ["ü ß.bin", "a=b&c%20.bin", "x" * 120 + "ö" * 60, "x" * 121 + "線" * 40, "a\udcff.bin"]


def test_pandas_and_polars_open_an_arrow_file(tmp_path: Path) -> None:
    pandas, polars = import_module("pandas"), import_module("polars")
    file = tmp_path / "line.arrow"
    write_arrow(conversation(40), file)
    with pa.ipc.open_file(file) as opened:
        assert [*pandas.read_feather(file)["event"]] == opened.read_all()["event"].to_pylist()
    voltages = polars.read_ipc(file).filter(polars.col("event") == "BatteryVoltage")
    expected = [6000 + number for number in range(40)]
    assert voltages["BatteryVoltage"].struct["voltage_mv"].to_list() == expected


def counted(folder: Path) -> dict[str, int]:
    """Return how many voltages of each capture both readers find in a dataset."""
    duckdb: Any = import_module("duckdb")
    polars: Any = import_module("polars")
    files = f"{(folder / 'BatteryVoltage').as_posix()}/**/*.parquet"
    table = duckdb.read_parquet(files, hive_partitioning=True)
    by_one = dict(table.aggregate("capture, count(*)").fetchall())
    counts = polars.scan_parquet(files, hive_partitioning=True).group_by("capture").len()
    assert dict(counts.collect().iter_rows()) == by_one
    return by_one


def test_duckdb_and_polars_read_a_dataset(tmp_path: Path) -> None:
    (tmp_path / "captures" / "monday").mkdir(parents=True)
    (tmp_path / "captures" / "line.bin").write_bytes(conversation(60))
    (tmp_path / "captures" / "monday" / "line.bin").write_bytes(conversation(45))
    for piece in scan(tmp_path / "captures", size=1000):
        archive(piece, tmp_path / "dataset")
    assert counted(tmp_path / "dataset") == {"line.bin": 60, "monday/line.bin": 45}


@in_turn("number, name", lambda: enumerate(NAMES))
def test_both_read_captures_of_any_name(number: int, name: str, tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(3))
    (piece,) = scan(tmp_path / "line.bin")
    folder = tmp_path / str(number)
    assert archive(replace(piece, capture=name), folder).is_new
    ((capture, count),) = counted(folder).items()
    assert (capture[:120], count) == (name.replace("\udcff", "\\udcff")[:120], 3)
