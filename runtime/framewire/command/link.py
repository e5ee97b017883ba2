"""Options for naming and opening a port, and its errors, for all verbs with a port."""

from __future__ import annotations

import logging
import math
import signal
import sys
from argparse import BooleanOptionalAction
from contextlib import contextmanager

from ..client.base_client import REPLY_TIMEOUT
from ..frame.pluralize import pluralize
from ..line.hid_devices import hid_devices_at_hand
from ..line.link_errors import ClosedError, DisconnectedError, TransportError, WriteStuckError
from ..line.serial_port import open_port, serial_ports
from .console import visible
from .exit_codes import LINE_LOST, TERMINATED
from .numerals import above_zero, at_least
from .progress_thread import shown_progress
from .usage_error import LineLostError, UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator, Sequence

    from ..client.client import Client
    from ..client.library import Library
    from ..client.limits import Allowed
    from ..line.hid_devices import HidDevice
    from ..line.serial_port import SerialPortSeen
    from ..line.transport import Transport
    from .program import Program

ENDS = {
    LINE_LOST: "the line was lost: a cable pulled, a device gone, the other end hung up",
    TERMINATED: "ended by SIGTERM, as `timeout 10 ...` does",
}
# The longest wait that can be chosen, so that none is without end.
_LONGEST = 3600.0


def add_port(parser: argparse.ArgumentParser, program: Program, *, client: bool = True) -> None:
    """Declare the options that name the port and describe its line.

    What is not given, `settings` fills in. `client` is whether a client is opened on it; only a
    client handles a local echo.
    """
    variable, file = program.port_variable, program.settings_file
    parser.add_argument(
        "--port",
        metavar="PORT",
        help="such as /dev/ttyUSB0, COM7 or socket://HOST:PORT; `ports` lists them "
        f"(default: the environment variable {variable}, else {file} in this folder or the user's, "
        "else the only port on USB)",
    )
    parser.add_argument(
        "--baud",
        type=_rate,
        metavar="BAUD",
        help=f"the rate of the line; inf: bytes take no time, as over TCP "
        f"(default: of {file}, else {program.library.link.baud})",
    )
    if client:
        parser.add_argument(
            "--local-echo",
            action=BooleanOptionalAction,
            help="the line echoes what is sent, as adapters for half-duplex wires do",
        )


def port_of(arguments: argparse.Namespace, program: Program) -> str:
    """Return the port that is named, or the only one that is plugged in by USB.

    Raises UsageError where there are several, or none.
    """
    if arguments.port is not None:
        return str(arguments.port)
    ports = serial_ports()
    only = only_port(ports, hid_devices_at_hand(program.library.link) or [])
    if only is not None:
        return only
    likely = plugged_in(ports) or ports
    if not likely:
        advice = "plug in the device, or name a port: --port PORT"
        advice += f", {program.port_variable}=PORT, or `port` in {program.settings_file}"
        raise UsageError(f"no port is plugged in; {advice}; `{program.name} doctor` looks closer")
    width = max(len(each.name) for each in likely)
    choices = [f"--port {each.name:<{width}}  {each.product or 'not USB'}" for each in likely]
    choices.append(
        f"{program.name} doctor --port PORT --save  keeps one in {program.settings_file}"
    )
    if plugged_in(ports):
        several = pluralize(len(likely), "port")
        raise UsageError(f"{several} are plugged in by USB; name the one that is meant:", choices)
    raise UsageError("no port is plugged in by USB; if it is one of these, name it:", choices)


def only_port(ports: Sequence[SerialPortSeen], devices: Sequence[HidDevice]) -> str | None:
    """Return the only port that is plugged in by USB; None for none or several.

    Other ports are built in, and may be the console of the machine: they have to be named. A device
    by USB HID is taken where no port is on USB.
    """
    by_usb = plugged_in(ports)
    if devices and not by_usb:
        return "hid://"
    return by_usb[0].name if len(by_usb) == 1 else None


def plugged_in(ports: Sequence[SerialPortSeen]) -> list[SerialPortSeen]:
    """Return the ports that are plugged in by USB."""
    return [each for each in ports if each.usb]


def _rate(text: str) -> float:
    """Return a rate, as an argument: a whole number of baud, or inf."""
    return math.inf if text == "inf" else at_least(1)(text)


def add_timeout(parser: argparse.ArgumentParser) -> None:
    """Declare the option for how long a reply may take."""
    parser.add_argument(
        "--timeout",
        type=above_zero(highest=_LONGEST, unit="seconds"),
        default=REPLY_TIMEOUT,
        metavar="S",
        help="seconds to wait for a reply, besides its time on the wire "
        f"(default: {REPLY_TIMEOUT})",
    )


def open_line(port: str, baud: float, library: Library) -> Transport:
    """Open a port, and show that while it takes long: an address may be far away.

    Raises UsageError for a rate that no port can be set to.
    """
    try:
        with shown_progress(lambda waited: f"opening {port}, {waited:.0f} s"):
            return open_port(port, library.link, library.codec, baud=baud, exclusive=True)
    except ValueError as error:
        raise UsageError(str(error)) from None


def open_client(
    arguments: argparse.Namespace,
    program: Program,
    *,
    limits: Allowed,
    retries: int = 0,
    settle: float | None = None,
) -> Client:
    """Open a client as open_line does, with the times that the arguments give."""
    logger = program.library.log()
    if not any(isinstance(each, _Warnings) for each in logger.handlers):
        logger.addHandler(_Warnings(program.name))
    return program.library.client(
        open_line(port_of(arguments, program), arguments.baud, program.library),
        baud=arguments.baud,
        reply_timeout=arguments.timeout,
        retries=retries,
        local_echo=arguments.local_echo,
        limits=limits,
        settle=settle,
    )


class _Warnings(logging.Handler):
    """A log handler that prints the library's warnings as the command prints everything else."""

    def __init__(self, program: str) -> None:
        super().__init__(logging.WARNING)
        self._program = program

    def emit(self, record: logging.LogRecord) -> None:
        print(f"{self._program}: {visible(record.getMessage())}", file=sys.stderr)


@contextmanager
def failures_reported(arguments: argparse.Namespace) -> Iterator[None]:
    """Turn errors of a port into one line that says what to do, and what has named the port.

    SIGTERM ends the body as Ctrl-C does: totals are printed, the port closed, the terminal
    restored.
    """
    try:
        with _ended_by_sigterm():
            yield
    except (ClosedError, DisconnectedError, WriteStuckError) as error:
        # The library would say `reconnect()`, which cannot be typed here.
        advice = "check the cable and the power, then run this again"
        raise LineLostError(f"{error.port}: {error.happened}; {advice}") from None
    except TransportError as error:
        named = f" (the port is named by {arguments.port_from})" if arguments.port_from else ""
        raise UsageError(f"{error}{named}") from None


@contextmanager
def _ended_by_sigterm() -> Iterator[None]:
    try:
        before = signal.signal(signal.SIGTERM, lambda *_: sys.exit(TERMINATED))
    except ValueError:  # signals are for the main thread, which this is not
        yield
        return
    try:
        yield
    finally:
        signal.signal(signal.SIGTERM, before)
