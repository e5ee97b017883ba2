"""The command of a device that answers as its specification says."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any, Literal

from ..client.device import AddressedDevice
from .command import Simulator
from .line_faults import LineFaults
from .line_options import seconds
from .numbered import Numbered

if TYPE_CHECKING:
    import argparse

    from .derived_device import DerivedDevice
    from .virtual_line import LineSettings, VirtualLine

_ADDRESSES = Numbered("device", highest=65535)
# What is sent more often would be all that the device does.
_SHORTEST = 0.001


def simulator_of(board: type[DerivedDevice]) -> Simulator:
    """Return the command that puts a device of this class behind a port."""
    library = board.library
    return Simulator(
        f"{library.package}-simulator",
        library,
        LineFaults,
        description="A virtual device, which answers as the specification says: with the values of "
        "its examples, or with those that were set.",
        noun="a device",
        examples=(("--every 0.1", "what it sends unasked, ten messages a second"),),
        declare=partial(_declare, board),
        make=partial(_made, board),
    )


def _declare(board: type[DerivedDevice], group: Any) -> None:
    if issubclass(board, AddressedDevice):
        _ADDRESSES.add(
            group, "addresses", text="the addresses that it answers at, as in 1-3,7 (default: all)"
        )
    group.add_argument(
        "--every",
        type=seconds,
        default=1.0,
        metavar="SECONDS",
        help="the time between messages that nobody asks for; 0: none (default: 1)",
    )


def _made(
    board: type[DerivedDevice],
    via: Literal["pty", "tcp"],
    line: LineSettings,
    arguments: argparse.Namespace,
) -> VirtualLine:
    from .virtual_line import VirtualLine  # noqa: PLC0415 - --help is to be quick

    if 0 < arguments.every < _SHORTEST:
        raise ValueError(f"--every {arguments.every:g}: write {_SHORTEST} or more, or 0 for none")
    device = board(*getattr(arguments, "addresses", ()))
    device.every = arguments.every
    return VirtualLine(device, via, **line)
