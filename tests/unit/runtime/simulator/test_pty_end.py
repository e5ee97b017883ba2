"""The board behind a pty: its link, a name that stays and takes nobody's file; and its rate."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import pytest
from busservo import open_transport
from busservo_simulator import VirtualController

from tests.in_turn import in_turn
from tests.lines.hosts import Host
from tests.unit.runtime.simulator.conftest import ASK, VOLTAGE, host_at

if sys.platform != "win32":
    from framewire.simulator.pty_rate import read_rate, set_rate

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")


@pytest.mark.parametrize("left_behind", [False, True])
def test_a_link_is_a_name_that_stays(tmp_path: Path, left_behind: bool) -> None:
    link = tmp_path / "COM7"
    if left_behind:
        link.symlink_to("/dev/nothing")
    with VirtualController("pty", link=link) as board:
        assert board.port == str(link)
        for _ in range(2):
            host = host_at(board)
            assert host.ask(ASK) == VOLTAGE
            board.unplug()
            assert not link.is_symlink()
            board.plug_in()
            host.hang_up()
        assert link.is_symlink()
    assert not link.is_symlink()


def test_a_link_replaces_no_file(tmp_path: Path) -> None:
    link = tmp_path / "COM7"
    link.write_text("mine")
    with pytest.raises(FileExistsError):
        VirtualController("pty", link=link).start()
    assert link.read_text() == "mine"


# -------------------------------------------------------------------- its rate


# Elsewhere pyserial sets such a rate in a way that no pty takes.
on_linux = pytest.mark.skipif(sys.platform != "linux", reason="an odd rate, on a pty")


@pytest.fixture(params=[None, 9600, 57600, pytest.param(96000, marks=on_linux)])
def board(request: pytest.FixtureRequest) -> Iterator[VirtualController]:
    with VirtualController("pty", baud=request.param) as board:
        yield board


@on_linux
def test_an_unknown_rate_is_taken_for_the_right_one(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(*_: object) -> None:
        raise OSError("no such call")

    with VirtualController("pty", baud=96000) as board:
        monkeypatch.setattr("framewire.simulator.pty_rate.fcntl.ioctl", refuse)
        assert board._end.host_baud is None
        set_rate(board._end._host_end, 12345)  # type: ignore[attr-defined]
        monkeypatch.undo()
        assert read_rate(board._end._host_end) == 96000  # type: ignore[attr-defined]


def test_a_rate_kept_as_a_number_is_read(monkeypatch: pytest.MonkeyPatch) -> None:
    kept: list[Any] = [0, 0, 0, 0, 12345, 12345, []]
    monkeypatch.setattr("framewire.simulator.pty_rate.sys.platform", "darwin")
    monkeypatch.setattr("framewire.simulator.pty_rate.termios.tcgetattr", lambda _end: kept)
    monkeypatch.setattr("framewire.simulator.pty_rate.termios.tcsetattr", lambda *_: None)
    assert read_rate(0) == 12345
    set_rate(0, 54321)
    assert read_rate(0) == 54321


@in_turn("via", lambda: ["memory", "tcp"])
def test_there_is_no_rate_without_a_pty(via: Any) -> None:
    with VirtualController(via) as board:
        assert board._end.host_baud is None
        host = Host(board.transport if via == "memory" else open_transport(board.port, baud=115200))
        assert host.ask(ASK) == VOLTAGE
        host.hang_up()
