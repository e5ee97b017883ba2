"""The recordings of a client and a monitor: their form, and that no byte is lost."""

import os
import re
import stat
import threading
from collections.abc import Callable
from pathlib import Path

import pytest
from busservo import Controller, NoReplyError, open_controller
from busservo._library import CODEC
from framewire.command.recorder import Recorder
from framewire.recording.file import RecordingFile

from tests.in_turn import in_turn
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine

RECORDED = "55 55 02 0F  # 0 s, host: BatteryVoltageRead()\n"
PROBLEM = (
    f"it holds {len(RECORDED)} bytes, and a recording is never overwritten; "
    "give another name, or remove it"
)


def by_a_client(path: Path) -> object:
    return Controller(VirtualLine(), trace=path)


def by_a_client_with_a_port(path: Path) -> object:
    return open_controller("loop://", trace=path)


@in_turn("record", lambda: [by_a_client, by_a_client_with_a_port, RecordingFile])
def test_a_recording_is_never_overwritten(record: Callable[[Path], object], tmp_path: Path) -> None:
    path = tmp_path / "line.hex"
    path.write_text(RECORDED)
    with pytest.raises(FileExistsError, match=PROBLEM) as caught:
        record(path)
    assert caught.value.filename == str(path)
    assert path.read_text() == RECORDED


@pytest.mark.skipif(os.name != "posix", reason="only POSIX has these")
def test_a_device_or_a_fifo_is_accepted(tmp_path: Path) -> None:
    for _ in range(2):
        with Recorder(Path(os.devnull), CODEC) as recorder:
            recorder.begin("COM7", 0.0)
    fifo = tmp_path / "fifo"
    os.mkfifo(fifo)
    assert stat.S_ISFIFO(fifo.stat().st_mode)
    read: list[str] = []
    reader = threading.Thread(target=lambda: read.append(fifo.read_text()))
    reader.start()
    file = RecordingFile(fifo)
    file.quiet()
    file.close()
    reader.join()
    assert read == ["# quiet\n"]


def lines_of(path: Path) -> list[str]:
    """Return the lines of a recording without the times of a clock."""
    text = re.sub(r"\d\.\d{6} s", "T s", path.read_text())
    return re.sub(r"\d{4}-\d\d-\d\d \d\d:\d\d:\d\d\.\d{6} [+-]\d{4}", "DAY", text).splitlines()


def test_a_recording_says_when_it_began_and_when_the_line_fell_silent(tmp_path: Path) -> None:
    line, path = VirtualLine(), tmp_path / "line.hex"
    with client_on(line, Controller, reply_timeout=0.25, trace=path) as controller:
        line.say(bytes.fromhex("55 55 05 08"))
        with pytest.raises(NoReplyError):
            controller.read_battery_voltage()
    assert lines_of(path) == [
        "# recorded of 'virtual line' from DAY on",
        "55 55 02 0F  # T s, host: BatteryVoltageRead()",
        "55 55 05 08  # T s, noise: too short",
        "# quiet",
    ]


def test_names_cannot_break_a_recording(tmp_path: Path) -> None:
    path = tmp_path / "line.hex"
    file = RecordingFile(path)
    file.begin("/dev/tty\n55 55 02 07 \N{SNOWMAN}")
    file.close()
    (line,) = path.read_text(encoding="ascii").splitlines()
    assert line.startswith(r"# recorded of '/dev/tty\n55 55 02 07 \u2603' from ")
