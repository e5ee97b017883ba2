"""The command `busservo-simulator`: a virtual board behind a port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, Literal

from busservo._library import LIBRARY
from framewire.simulator.command import Simulator
from framewire.simulator.line_options import up_to
from framewire.simulator.numbered import Numbered

from busservo_simulator.faults import Faults

if TYPE_CHECKING:
    import argparse

    from framewire.simulator.virtual_line import LineSettings

    from busservo_simulator.virtual_controller import VirtualController

_SERVOS = Numbered("servo", highest=253)


def _declare(board: Any) -> None:
    _SERVOS.add(
        board,
        "servos",
        default=range(1, 7),
        text="the servos that it has, as in 1-6,9 (default: 1-6)",
    )
    _SERVOS.add(
        board, "missing", text="those of them that are not plugged in: replies leave them out"
    )
    _SERVOS.add(
        board, "off", text="those of them that are off: replies give 65535 as their position"
    )
    board.add_argument(
        "--battery",
        type=up_to(65535, "voltage of a battery in mV"),
        default=7500,
        metavar="MV",
        help="the voltage of its battery in mV while nothing moves (default: 7500)",
    )
    board.add_argument(
        "--no-start-report", action="store_true", help="does not report that an action group starts"
    )


def _board(
    via: Literal["pty", "tcp"], line: LineSettings, arguments: argparse.Namespace
) -> VirtualController:
    from busservo_simulator.virtual_controller import VirtualController  # noqa: PLC0415 - --help is to be quick

    board = VirtualController(
        via,
        servos=arguments.servos,
        battery_mv=arguments.battery,
        start_report=not arguments.no_start_report,
        **line,
    )
    for option in ("missing", "off"):
        _SERVOS.mark(option, arguments, board.servos)
    return board


SIMULATOR = Simulator(
    "busservo-simulator",
    LIBRARY,
    Faults,
    description="A virtual bus servo controller: talk to it as to a real one.",
    noun="a board",
    examples=(
        ("--servos 1-6,9 --off 9", "seven servos, the last of them off"),
        ("--fault noise=0.2 --fault dropped=0.1 --seed 7", ""),
        ("--fault late=0.05 --late-by 3 --fault duplicated=0.05", ""),
    ),
    declare=_declare,
    make=_board,
    notes="""\
A host that sets another rate on the pty than the board's reads garbage, and is read as garbage.
TCP has no rate that could be wrong. Mono's SerialPort opens no pty: have it talk to --tcp.""",
)
# What `busservo simulate` asks for.
add_arguments, main = SIMULATOR.add_arguments, SIMULATOR.main
