"""The link to a pty: a name that stays, and takes nobody's file."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

import pytest
from busservo_simulator import VirtualController

from tests.unit.runtime.simulator.conftest import ASK, VOLTAGE, host_at

if TYPE_CHECKING:
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
