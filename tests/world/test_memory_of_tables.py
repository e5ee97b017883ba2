"""Large captures are read and written in little memory, whatever their size."""

import sys
from pathlib import Path

import pytest

from tests.programs import ran
from tests.unit.runtime.tables.conversations import conversation

resource = pytest.importorskip("resource")

SIZE = 200_000_000
# Its tables as a whole would take more than twice as much.
MOST = 350_000_000

WORK = """
import resource, sys
from busservo.tables import archive, read_batches, scan, write_arrow, write_parquet
capture, folder = sys.argv[1:]
{work}
print(resource.getrusage(resource.RUSAGE_SELF).ru_maxrss)
"""
# A process inherits the peak of the one that started it, and a test runner holds much by then.
SMALL_PARENT = """
import subprocess, sys
sys.exit(subprocess.run([sys.executable, "-c", *sys.argv[1:]]).returncode)
"""
WAYS = {
    "read": "for made in read_batches(capture): pass",
    "parquet": "write_parquet(capture, folder)",
    "arrow": "write_arrow(capture, folder)",
    "archive": "assert not [r for p in scan(capture) if (r := archive(p, folder)).error]",
}


@pytest.fixture(scope="module")
def capture(tmp_path_factory: pytest.TempPathFactory) -> Path:
    path = tmp_path_factory.mktemp("large") / "line.bin"
    data = conversation(20_000)
    with path.open("wb") as file:
        for _ in range(SIZE // len(data)):
            file.write(data)
        # Noise without end is held no more than anything else.
        file.seek(SIZE)
        file.write(data)
    return path


@pytest.mark.parametrize("way", WAYS)
def test_a_large_capture_takes_little_memory(way: str, capture: Path, tmp_path: Path) -> None:
    work = WORK.format(work=WAYS[way])
    done = ran(sys.executable, "-c", SMALL_PARENT, work, capture, tmp_path / "out")
    unit = 1 if sys.platform == "darwin" else 1024
    assert int(done.stdout) * unit < MOST
