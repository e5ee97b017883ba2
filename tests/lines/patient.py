"""A virtual board for the doctor to examine, in virtual time, and all that it needs for that."""

from typing import Any

from busservo._command import PROGRAM
from busservo_simulator import Faults, VirtualController
from framewire.command.checks.checks import checks_of, examine
from framewire.command.checks.diagnosis import Diagnosis
from framewire.command.checks.result import Result
from framewire.line.serial_port import SerialPortSeen

from tests.lines.at_board import virtual_board

CHECKS = checks_of(PROGRAM.library)
PORT = "virtual board"
ADAPTER = SerialPortSeen(PORT, "1A86:7523", "USB Serial", "A50285BI")
# What the doctor takes at most of the board's time, whatever happens.
LONGEST = 60.0


def board_with(faults: Faults | None = None, **more: Any) -> VirtualController:
    """Return a board at the end of a wire, by default of 9600 baud."""
    return virtual_board(**{"baud": 9600.0, "faults": faults, **more})


def diagnosis_of(board: VirtualController, **more: Any) -> Diagnosis:
    """Return a diagnosis of that board alone, whatever is plugged into the machine."""
    given: dict[str, Any] = {
        "port": PORT,
        "opener": lambda _port, _baud: board.open(),
        "ports": lambda: [ADAPTER],
        "hid_devices": list,
        "clock": board.clock.now,
    }
    return diagnosis_at(**(given | more))


def diagnosis_at(port: str | None, **more: Any) -> Diagnosis:
    """Return a diagnosis of a port, on a line as the protocol has it."""
    link = PROGRAM.library.link
    return Diagnosis(PROGRAM, port, **({"baud": link.baud, "local_echo": link.local_echo} | more))


def examined(diagnosis: Diagnosis) -> dict[str, Result]:
    """Return the result of each check, by its id."""
    return {check.id: result for check, result in examine(diagnosis, CHECKS)}
