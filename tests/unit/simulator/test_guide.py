"""The guide docs/test-your-robot.md: every piece of Python in it is run."""

from __future__ import annotations

import re
import sys
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import busservo
import pytest
from busservo import (
    ActionGroupRun,
    ActionGroupSpeed,
    ActionGroupStop,
    Message,
    ServoMove,
)
from busservo_simulator import ActionGroup, Step
from busservo_simulator.board import Board
from busservo_simulator.cli import SIMULATOR
from busservo_simulator.faults import CHANCES, TO_BOARD

from tests.in_turn import in_turn
from tests.timeouts import LIVE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

GUIDE = Path(__file__).parents[3] / "docs" / "test-your-robot.md"
TEXT = GUIDE.read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```python\n(.*?)^```$", TEXT, re.DOTALL | re.MULTILINE)
COMMANDS = re.findall(r"^\$ busservo-simulator (.*)$", TEXT, re.MULTILINE)
FAULTS = re.findall(r"^\| `(.*)` \| (.*) \|$", TEXT, re.MULTILINE)
# What the table of messages says: what is received, and all that may be sent for it.
REACTIONS = {
    received: set(re.findall(r"messages/(\w+)\.md", sent))
    for received, sent in re.findall(
        r"^\| \[(\w+)\]\([^|]*\) \|[^|]*\|([^|]*)\|$", TEXT, re.MULTILINE
    )
}


def test_the_guide_has_examples() -> None:
    assert (len(BLOCKS), len(COMMANDS)) == (11, 2)


def marks(block: str) -> Iterator[pytest.MarkDecorator]:
    # Some send on purpose what the board refuses.
    if "rejects.total == 1" in block or "baud=115200" in block:
        yield pytest.mark.garbage
    if '"pty"' in block:
        yield pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")


SHOWN = [pytest.param(block, marks=list(marks(block))) for block in BLOCKS]


@in_turn("words", lambda: COMMANDS)
def test_a_command_puts_a_board_behind_a_port(words: str) -> None:
    with SIMULATOR.made_of(SIMULATOR.parser().parse_args(words.split())) as board:
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


# A hundred steps of a tenth of a second, between two positions.
GROUPS = {8: ActionGroup(50 * [Step(100, {1: 600}), Step(100, {1: 400})])}
RUN = ActionGroupRun(group=8, times=1)
# Every way in which a message can be received, with what has been received before it.
RECEIVED: list[list[Message]] = [
    [ServoMove(time_ms=500, targets=[(1, 700), (2, 510)])],
    [busservo.ServoUnload([1, 99])],
    [busservo.ServoPositionsRead([1, 99])],
    [busservo.ServoPositionsRead(range(1, 86))],
    [busservo.BatteryVoltageRead()],
    [RUN],
    [ActionGroupRun(group=99, times=1)],
    [RUN, RUN],
    [ActionGroupStop()],
    [RUN, ActionGroupStop()],
    [ActionGroupSpeed(group=8, percent=200)],
    [RUN, ActionGroupSpeed(group=8, percent=200)],
]


def board_after(messages: Sequence[Message], seconds: float = 0) -> Board:
    board = Board(groups=GROUPS)
    for message in messages:
        board.hear(message.encode())
    board.advance_to(seconds)
    return board


def sent_by(board: Board) -> set[str]:
    return {type(report).__name__ for report in board.take()}


def sent_after(messages: Sequence[Message]) -> set[str]:
    return sent_by(board_after(messages, 60))


def test_the_guide_says_what_each_message_has_the_board_send() -> None:
    sent: dict[str, set[str]] = {type(each[-1]).__name__: set() for each in RECEIVED}
    for *before, message in RECEIVED:
        sent[type(message).__name__] |= sent_after([*before, message]) - sent_after(before)
    assert sent == REACTIONS


@in_turn("messages", lambda: RECEIVED)
def test_every_message_has_led2_blink_once(messages: list[Message]) -> None:
    log = re.findall(r"LED2 +(.*?)(?::|$)", str(board_after(messages).event_log), re.MULTILINE)
    assert log == len(messages) * ["blinks"]


def test_a_stopped_group_completes_its_step() -> None:
    board = board_after([RUN, ActionGroupStop()], 1)
    assert board.servos[1].position == 600


def test_the_guide_shows_the_log_as_it_is() -> None:
    (shown,) = re.findall(r"^ +[\d.]+(  LED2 .*)$", TEXT, re.MULTILINE)
    move = ServoMove(time_ms=800, targets=[(1, 800)])
    assert str(board_after([move]).event_log).endswith(shown)
