"""How many modules a request crosses on its way to the port: those that docs/design.md names."""

from __future__ import annotations

import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING

import busservo
import framewire
from busservo import open_controller
from busservo_simulator import VirtualController

from tests.timeouts import LIVE

if TYPE_CHECKING:
    from types import FrameType

PACKAGES = [Path(str(each.__file__)).parent for each in (busservo, framewire)]
DESIGN = Path(__file__).parents[4] / "docs" / "design.md"
PARAGRAPH = re.compile(r"\*\*A request crosses six modules.*?\n\n", re.DOTALL)


def named() -> list[str]:
    """Return the modules of the design, from the caller to the port."""
    [paragraph] = PARAGRAPH.findall(DESIGN.read_text(encoding="utf-8"))
    return re.findall(r"`(\w+)`", paragraph.partition("In asyncio")[0])


def module_of(frame: FrameType) -> str:
    file = Path(frame.f_code.co_filename)
    return file.stem.lstrip("_") if any(map(file.is_relative_to, PACKAGES)) else ""


def test_a_request_crosses_the_modules_that_the_design_names() -> None:
    entered: set[str] = set()
    at_the_port: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event != "call" or not module_of(frame):
            return
        entered.add(module_of(frame))
        if (module_of(frame), frame.f_code.co_name) == ("serial_port", "write"):
            caller: FrameType | None = frame
            while caller is not None:
                at_the_port.insert(0, module_of(caller))
                caller = caller.f_back

    with VirtualController("tcp") as board, open_controller(board.port, **LIVE) as controller:
        sys.setprofile(note)
        try:
            assert controller.read_battery_voltage() == 7500
        finally:
            sys.setprofile(None)
    assert len(named()) == 6
    assert set(named()) <= entered
    crossed = [*dict.fromkeys(filter(None, at_the_port))]
    # The steps of the call, and the session, are called and return: they wait for no port.
    assert crossed == [each for each in named() if each not in ("base_client", "session")]
