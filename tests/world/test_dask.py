"""The pieces of a folder of captures as work of a Dask cluster: two workers on one machine."""

import os
import signal
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest
from busservo.tables import Piece, Report, archive, scan
from dask import distributed

from tests.unit.runtime.tables.conversations import conversation, recorded

# Untyped, as far as it is used here.
dask: Any = distributed

# Windows has no other.
KILL = getattr(signal, "SIGKILL", signal.SIGTERM)
BROKEN = {"broken.hex", "gone.bin"}


@pytest.fixture
def captures(tmp_path: Path) -> Path:
    """Return a folder of captures, of which two are broken."""
    folder = tmp_path / "captures"
    for day in ("monday", "tuesday"):
        (folder / day).mkdir(parents=True)
        (folder / day / "line.bin").write_bytes(conversation(2000 + len(day)))
    (folder / "line.hex").write_text(recorded(200), encoding="utf-8")
    (folder / "broken.hex").write_text("55 55 02 07\n55 5Z\n", encoding="utf-8")
    (folder / "gone.bin").symlink_to(folder / "absent.bin")
    return folder


@contextmanager
def cluster(folder: Path) -> Iterator[Any]:
    """Start two workers, as processes of this machine."""
    with (
        dask.LocalCluster(
            n_workers=2,
            threads_per_worker=1,
            host="127.0.0.1",
            dashboard_address=":0",
            local_directory=str(folder / "workers"),
        ) as machine,
        dask.Client(machine) as client,
    ):
        yield client


def of_one_process(pieces: list[Piece], folder: Path) -> dict[str, bytes]:
    for piece in pieces:
        archive(piece, folder)
    return files_in(folder)


def files_in(folder: Path) -> dict[str, bytes]:
    return {
        path.relative_to(folder).as_posix(): path.read_bytes() for path in folder.rglob("*.parquet")
    }


def reported(reports: list[Report]) -> dict[str, str | None]:
    return {report.piece.capture: report.error for report in reports if report.error}


def test_two_workers_make_the_files_of_one_process(captures: Path, tmp_path: Path) -> None:
    pieces = scan(captures, size=10_000)
    expected = of_one_process(pieces, tmp_path / "by one")
    with cluster(tmp_path) as client:
        futures = client.map(archive, pieces, folder=tmp_path / "by two", pure=False)
        reports = client.gather(futures)
        where = {worker for holders in client.who_has(futures).values() for worker in holders}
    assert [report.piece for report in reports] == pieces
    assert len(where) == 2
    # What is broken is told, and all else is done.
    assert set(reported(reports)) == BROKEN
    assert files_in(tmp_path / "by two") == expected


def test_work_goes_on_after_its_cluster_was_closed(captures: Path, tmp_path: Path) -> None:
    pieces = scan(captures, size=10_000)
    expected = of_one_process(pieces, tmp_path / "by one")
    with cluster(tmp_path) as client:
        futures = client.map(archive, pieces, folder=tmp_path / "dataset", pure=False)
        client.gather(futures[: len(pieces) // 3])
    with cluster(tmp_path) as client:
        work = client.map(archive, pieces, folder=tmp_path / "dataset", pure=False)
        reports = client.gather(work)
    assert {report.is_new for report in reports if not report.error} == {True, False}
    assert set(reported(reports)) == BROKEN
    assert files_in(tmp_path / "dataset") == expected


def test_another_worker_does_what_a_killed_one_had_begun(captures: Path, tmp_path: Path) -> None:
    pieces = scan(captures, size=2_000)
    expected = of_one_process(pieces, tmp_path / "by one")
    with cluster(tmp_path) as client:
        processes = list(client.run(os.getpid).values())
        futures = client.map(archive, pieces, folder=tmp_path / "dataset", pure=False)
        dask.wait(futures[:10])
        os.kill(processes[0], KILL)
        reports = client.gather(futures)
    assert set(reported(reports)) == BROKEN
    assert files_in(tmp_path / "dataset") == expected
    assert not [path for path in (tmp_path / "dataset" / "_pieces").glob("*/*") if path.is_dir()]


def test_work_that_failed_is_done_again_by_the_same_client(tmp_path: Path) -> None:
    (tmp_path / "line.bin").write_bytes(conversation(20))
    pieces = scan(tmp_path / "line.bin")
    (tmp_path / "dataset").write_bytes(b"")
    with cluster(tmp_path) as client:
        failed = client.map(archive, pieces, folder=tmp_path / "dataset", pure=False)
        assert all(report.error for report in client.gather(failed))
        (tmp_path / "dataset").unlink()
        again = client.map(archive, pieces, folder=tmp_path / "dataset", pure=False)
        assert all(report.is_new for report in client.gather(again))
