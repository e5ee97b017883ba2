"""The guide docs/test-your-robot.md: every piece of Python in it is run."""

from __future__ import annotations

import re
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import busservo
import pytest
from busservo_simulator.cli import _board
from busservo_simulator.faults import CHANCES, TO_BOARD
from busservo_simulator.options import PROGRAM, parser_of

from tests.timeouts import LIVE

if TYPE_CHECKING:
    from collections.abc import Iterator

GUIDE = Path(__file__).parents[2] / "docs" / "test-your-robot.md"
TEXT = GUIDE.read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```python\n(.*?)^```$", TEXT, re.DOTALL | re.MULTILINE)
COMMANDS = re.findall(r"^\$ busservo-simulator (.*)$", TEXT, re.MULTILINE)
FAULTS = re.findall(r"^\| `(.*)` \| (.*) \|$", TEXT, re.MULTILINE)


def test_the_guide_has_examples() -> None:
    assert (len(BLOCKS), len(COMMANDS)) == (11, 2)


def marks(block: str) -> Iterator[pytest.MarkDecorator]:
    # Some send on purpose what the board refuses.
    if "rejects.total == 1" in block or "baud=115200" in block:
        yield pytest.mark.garbage
    if '"pty"' in block:
        yield pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")


SHOWN = [pytest.param(block, marks=list(marks(block))) for block in BLOCKS]


@pytest.mark.parametrize("words", COMMANDS)
def test_a_command_puts_a_board_behind_a_port(words: str) -> None:
    with _board(parser_of(PROGRAM).parse_args(words.split())) as board:
        assert board.port


def test_the_guide_describes_every_fault_as_the_help_does() -> None:
    faults = dict(FAULTS)
    for name, what in CHANCES.items():
        if name in TO_BOARD:
            assert name in "".join(faults)
        else:
            assert faults[name].replace("`", "").replace(" seconds", "") == what


@pytest.mark.parametrize("block", SHOWN)
def test_an_example_does_what_it_says(block: str, monkeypatch: pytest.MonkeyPatch) -> None:
    # A guide need not say that a machine may be busy.
    live = partial(busservo.open_controller, **LIVE)
    monkeypatch.setattr(busservo, "open_controller", live)
    names: dict[str, object] = {"__name__": "guide"}
    exec(compile(block, str(GUIDE.name), "exec"), names)  # noqa: S102 - the guide is ours
