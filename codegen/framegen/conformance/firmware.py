"""Conformance tests of real firmware over a port: safe by default, and recorded."""

from __future__ import annotations

import argparse
import time
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.conformance.device.malformed import malformed_steps
from framegen.conformance.device.permission import permit
from framegen.conformance.device.port import open_port
from framegen.conformance.device.queries import command_steps, query_steps, requests
from framegen.conformance.device.recording import Recording
from framegen.conformance.device.report import Report
from framegen.conformance.device.run import Progress, Run
from framegen.conformance.device.session import Session, Timing
from framegen.conformance.device.step import Step, numbered
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Callable, Iterator

    from framegen.conformance.device.permission import Permission
    from framegen.conformance.device.step import Request
    from framegen.conformance.device.transport import Transport
    from framegen.language.spec import Link
    from framegen.model.model import Model

# Seconds that a device may take for a reply, besides those on the wire.
TIMEOUT = 0.25
# Seconds in which a device that nobody asks has to report something.
LISTENING = 3.0
_LOST = "check the cable and the power, then run this again"


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the options about a port, and about what may be sent to it."""
    parser.add_argument(
        "--port",
        metavar="PORT",
        help="test the firmware behind this port: /dev/ttyUSB0, COM7 or socket://HOST:PORT",
    )
    parser.add_argument(
        "--baud",
        type=_rate,
        metavar="BAUD",
        help="the baud rate, if not the spec's: at a wrong one, a device receives other bytes",
    )
    parser.add_argument(
        "--malformed",
        action="store_true",
        help="send malformed queries as well, and check that the next query is still answered",
    )
    parser.add_argument(
        "--allow",
        action="append",
        default=[],
        metavar="NAME",
        help="send the examples of this message as well, which a device carries out",
    )
    parser.add_argument(
        "--address",
        type=_address,
        metavar="N",
        help="the address of the device, if it is not that of the spec's examples",
    )
    parser.add_argument(
        "--local-echo",
        action="store_true",
        help="the line gives back what is sent, as many half-duplex adapters do",
    )
    parser.add_argument(
        "--log", type=Path, metavar="FILE", help="record all traffic of the line in a new file"
    )


def _rate(text: str) -> int:
    if not (text.isascii() and text.isdigit() and 1 <= int(text[:12]) < 2**31):
        raise argparse.ArgumentTypeError(f"{text!r} is no rate: a whole number of baud, from 1 up")
    return int(text)


def _address(text: str) -> int:
    try:
        return int(text, 0)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text!r} is no address: a whole number") from None


def refuse_without_port(arguments: Namespace) -> None:
    """Refuse options about a port where none is named. Raises Unusable."""
    for name in ("baud", "malformed", "allow", "address", "local_echo", "log"):
        said = getattr(arguments, name)
        # An address may be 0.
        if said or (said is not None and name == "address"):
            raise Unusable(
                f"--{name.replace('_', '-')} is for firmware",
                hint="name its port, as by --port COM5",
            )


def run(
    model: Model,
    arguments: Namespace,
    *,
    connect: Callable[[str, Link, int], Transport] = open_port,
    clock: Callable[[], float] = time.monotonic,
) -> int:
    """Run the tests and report. 0: all passed; 1: something failed. Raises Unusable.

    `connect` opens the port, and `clock` is the time that its reads take.
    """
    if arguments.format not in ("text", "json"):
        raise Unusable(f"there is no {arguments.format} for firmware", hint="--format text or json")
    permission = permit(model, arguments.allow, arguments.address, echo=arguments.local_echo)
    after = min(requests(permission), key=lambda request: len(request.frame), default=None)
    steps = list(numbered(_steps(permission, after, arguments)))
    link = model.spec.link
    baud = arguments.baud or link.baud
    timing = Timing(baud, link.bits_per_byte, arguments.timeout or TIMEOUT)
    report = Report(model, arguments.port, baud, permission)
    progress = Progress(as_json=arguments.format == "json")
    with Recording(model, arguments.log) as recording:
        transport = connect(arguments.port, link, baud)
        try:
            progress.begin(report, steps)
            recording.begin(arguments.port)
            session = Session(transport, permission, timing, recording, clock)
            Run(report, session, recording, after).go(steps, progress)
        except OSError as error:
            report.stopped = f"{arguments.port}: {error}"
            progress.end(report)
            raise Unusable(report.stopped, hint=_LOST) from None
        finally:
            with suppress(OSError):
                transport.close()
    progress.end(report)
    return 0 if report.has_passed else 1


def _steps(permission: Permission, after: Request | None, arguments: Namespace) -> Iterator[Step]:
    yield from query_steps(permission)
    if after is None and permission.reports:
        seconds = max(arguments.timeout or 0, LISTENING)
        yield Step(f"what comes within {seconds:g} s", (), seconds)
    if arguments.malformed:
        if after is None:
            raise Unusable(
                "nothing malformed can be sent: there is no query that could follow it",
                hint="leave --malformed out",
            )
        yield from malformed_steps(permission, after)
    yield from command_steps(permission, after)
