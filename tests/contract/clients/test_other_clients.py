"""Clients that others wrote, odd habits included; and the table of docs/testing.md on them.

The habits were written for this test, after what such programs are seen to do on the wire. The
table is tried at a line that takes its time, and at one that takes none.
"""

import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import pytest
import serial
from busservo import ActionGroupCompleted
from busservo_simulator import Faults, VirtualController

from tests.contract.clients.other_clients import CLIENTS, LewansoulLx16a
from tests.timeouts import await_that

pytestmark = pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
READ_TWO = bytes.fromhex("55 55 05 15 02 01 02")


@pytest.fixture
def board(tmp_path: Path) -> Iterator[VirtualController]:
    with VirtualController("pty", link=tmp_path / "COM7", baud=9600) as board:
        yield board


@pytest.fixture
def line(board: VirtualController) -> Iterator[serial.Serial]:
    with serial.Serial(board.port, 9600, timeout=0.1) as line:
        yield line


def test_a_client_that_writes_in_two_parts_and_reads_two_bytes_too_many_is_served(
    board: VirtualController, line: serial.Serial
) -> None:
    for _ in range(3):
        line.flush()
        line.write(READ_TWO[:4])
        line.write(READ_TWO[4:])
        await_that(lambda: line.in_waiting >= 11)
        head = line.read(4)
        assert head == bytes.fromhex("55 55 09 15")
        assert line.read(head[2]) == bytes.fromhex("02 01 F4 01 02 F4 01")
    assert (board.accepted, board.rejects.total) == (3, 0)


# ------------------------------------------------------------------ the table

GUIDE = Path(__file__).parents[3] / "docs" / "testing.md"
MILLIVOLTS = 7500
BATTERY, TWO_POSITIONS, ONE_POSITION = 6, 11, 8


def result_of(call: Callable[[], object], right: object) -> str:
    """Return how a call of one of them ends."""
    try:
        value = call()
    except Exception as error:  # noqa: BLE001 - theirs, of whatever kind
        return f"`{type(error).__name__}`"
    return "yes" if value == right else "`None`" if value is None else f"wrong: {value}"


def has_received(board: VirtualController) -> bool:
    """Return whether the board has received bytes, understood or not."""
    return bool(board.accepted or board.rejects.total)


def move(client: Any, board: VirtualController) -> str:
    client.move([(1, 800), (2, 300)])
    await_that(lambda: has_received(board))
    targets = [board.servos[servo_id].target for servo_id in (1, 2)]
    return "yes" if targets == [800, 300] else "no"


def battery(client: Any, _board: VirtualController) -> str:
    client.answer = BATTERY
    return result_of(client.battery, MILLIVOLTS)


def positions(client: Any, _board: VirtualController) -> str:
    client.answer = TWO_POSITIONS
    return result_of(lambda: client.positions([1, 2]), [500, 500])


def unload(client: Any, board: VirtualController) -> str:
    client.unload([1, 2])
    await_that(lambda: has_received(board))
    return "no" if board.servos[1].loaded or board.servos[2].loaded else "yes"


def group(client: Any, _board: VirtualController) -> str:
    return "yes" if hasattr(client, "run_group") else "no method"


def noise(client: Any, board: VirtualController) -> str:
    board.send_bytes(b"\x00\x13")
    client.answer = BATTERY + 2
    return result_of(client.battery, MILLIVOLTS)


def report(client: Any, board: VirtualController) -> str:
    board.report(ActionGroupCompleted(8, 1))
    client.answer = BATTERY + 7
    return result_of(client.battery, MILLIVOLTS)


def missing(client: Any, board: VirtualController) -> str:
    board.servos[1].missing = True
    client.answer = ONE_POSITION
    return result_of(lambda: client.positions([1, 2]), [None, 500])


def silence(client: Any, board: VirtualController) -> str:
    board.faults = Faults(dropped=1)
    return result_of(client.battery, MILLIVOLTS)


ROWS: dict[str, Callable[[Any, VirtualController], str]] = {
    "moves two servos": move,
    "reads the battery": battery,
    "reads two positions": positions,
    "unloads two servos": unload,
    "runs an action group": group,
    "noise before a reply": noise,
    "a report before a reply": report,
    "a servo that is missing": missing,
    "no reply": silence,
}


def cells() -> dict[tuple[str, str], str]:
    """Return the table of the guide: by row and client."""
    lines = GUIDE.read_text(encoding="utf-8").splitlines()
    head = next(line for line in lines if line.startswith("| at the simulator |"))
    table = [
        [cell.strip() for cell in line.strip("|").split("|")]
        for line in lines[lines.index(head) :]
        if line.startswith("|")
    ]
    rows = table[: 2 + len(ROWS)]
    return {
        (row[0], name): cell
        for row in rows[2:]
        for name, cell in zip(rows[0][1:], row[1:], strict=True)
    }


def marks(row: str, client: Any) -> list[pytest.MarkDecorator]:
    """Return the marks of a cell: a board refuses calls of a client for another protocol."""
    return [pytest.mark.garbage] if client is LewansoulLx16a and ROWS[row] is not group else []


CELLS = [
    pytest.param(row, name, marks=marks(row, client))
    for row in ROWS
    for name, client in CLIENTS.items()
]


@pytest.mark.parametrize("baud", [None, 9600])
@pytest.mark.parametrize(("row", "name"), CELLS)
def test_each_can_do_what_the_table_says(
    row: str, name: str, baud: float | None, tmp_path: Path
) -> None:
    with VirtualController("pty", link=tmp_path / "COM7", baud=baud) as board:
        client = CLIENTS[name](board)
        try:
            assert ROWS[row](client, board) == cells()[row, name]
        finally:
            client.close()


def test_the_table_has_no_other_cells() -> None:
    assert list(cells()) == [(row, name) for row in ROWS for name in CLIENTS]


@pytest.mark.garbage
def test_a_move_of_servo_2_in_its_own_protocol_stops_the_group_that_runs(
    board: VirtualController,
) -> None:
    """`55 55 02 07` begins both: there the servo and a length, here a length and a command."""
    board.press_button(1, times=0)
    client = LewansoulLx16a(board)
    client.move([(2, 800)])
    await_that(lambda: board.accepted)
    client.close()
    assert board.servos[2].target != 800
    assert any("is stopped" in line for line in map(str, board.log))
