"""The verb `doctor`: troubleshooting as a program."""

from __future__ import annotations

import json
import sys
from functools import partial

from ..frame.bytes_like import format_hex
from ..frame.errors import EncodeError
from . import link
from .checks.checks import checks_of, examine
from .checks.diagnosis import Diagnosis
from .checks.keep import worth_keeping
from .checks.move import STEP, move_check
from .checks.question import address_field, harmless_question
from .checks.report import Report
from .checks.result import FAILED, PASSED, STATES, UNKNOWN
from .colour import painted, takes_colour
from .console import visible, write_as_it_is
from .exit_codes import DONE, LINE_LOST, NOT_ALL
from .link import add_port, add_timeout, failures_reported, open_line
from .numerals import at_least
from .plain_text import plain_text
from .progress_thread import shown_progress
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator
    from typing import Any

    from ..client.library import Library
    from ..client.pose import Pose
    from ..frame.message import Message
    from ..line.transport import Transport
    from .checks.check import Check
    from .checks.result import Result
    from .program import Program
    from .settings import Settings

ENDS = link.ENDS | {NOT_ALL: "a check has failed"}
_COLOURS = {PASSED: "green", FAILED: "red", UNKNOWN: "yellow"}


def about(program: Program) -> str:
    """Return what it does, in full."""
    checks = ", ".join(check.id for check in checks_of(program.library))
    moves = "" if program.library.pose is None else " --move asks before it moves anything."
    return f"""\
Makes these checks, one after the other:
{checks}.
Each line says `passed`, `failed` or `unknown`, what was seen, the bytes that show it, and what to
do next. It only reads.{moves}"""


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    add_port(parser, program)
    add_timeout(parser)
    option, pose = _option(program.library), program.library.pose
    if option:
        which = "the address of the device that is asked (default: the likeliest)"
        parser.add_argument(option, type=at_least(0), dest="address", metavar="N", help=which)
    if pose is not None:
        which = f"also move this {pose.noun} by {STEP} steps and back; asks first"
        parser.add_argument("--move", type=at_least(0), metavar="ID", help=which)
        parser.add_argument("--yes", action="store_true", help="do not ask before --move")
    parser.add_argument(
        "--report", metavar="FILE", help="write a recording of everything, to send to others"
    )
    parser.add_argument(
        "--model", default="", metavar="TEXT", help="what the device is, for the report"
    )
    saved = "port, rate and ids" if pose is not None else "port and rate"
    parser.add_argument(
        "--save",
        action="store_true",
        help=f"if no check fails, keep {saved} in {program.settings_file}",
    )
    parser.add_argument("--json", action="store_true", help="print each check as a line of JSON")


def run(arguments: Namespace, program: Program) -> int:
    """Run the checks, print each result, and write the report."""
    library = program.library
    checks = [*checks_of(library)]
    if library.pose is not None and arguments.move is not None:
        _confirm(arguments, library.pose)
        checks.append(move_check(arguments.move, library.pose))
    report = None if arguments.report is None else _report(arguments.report)
    diagnosis = Diagnosis(
        program,
        arguments.port,
        baud=arguments.baud,
        reply_timeout=arguments.timeout,
        local_echo=arguments.local_echo,
        question=_question(arguments.address, library) if _option(library) else None,
        named_by=arguments.port_from,
        opener=partial(_open, program.library),
    )
    findings: list[tuple[Check, Result]] = []
    with failures_reported(arguments):
        try:
            found = examine(diagnosis, checks)
            while (finding := _next(found)) is not None:
                findings.append(finding)
                shown = _as_json(*finding) if arguments.json else _as_text(*finding)
                write_as_it_is(sys.stdout, f"{shown}\n")
                sys.stdout.flush()
        finally:
            if report is not None:
                _finish(report, arguments, diagnosis, findings)
    states = [result.state for _, result in findings]
    totals = ", ".join(f"{states.count(each)} {each}" for each in STATES)
    print(totals, file=sys.stderr)
    if arguments.save:
        _save(diagnosis, arguments.settings, program, failed=FAILED in states)
    if diagnosis.lost:
        return LINE_LOST
    return NOT_ALL if FAILED in states else DONE


def _save(diagnosis: Diagnosis, before: Settings, program: Program, *, failed: bool) -> None:
    """Keep what the checks were made with, and found; or say why not."""
    values = {} if failed else worth_keeping(diagnosis, before)
    if not values:
        why = "a check has failed" if failed else "nothing has answered"
        print(f"nothing saved: {why}", file=sys.stderr)
        return
    # Reads TOML, which only this needs.
    from .settings_save import save

    path, lines = save(before.path, values, program)
    print(f"saved in {path}: {lines}", file=sys.stderr)


def _option(library: Library) -> str:
    """Return the option for the address of a device; empty where there is but one device."""
    address = address_field(library)
    return address and f"--{address.replace('_', '-')}"


def _question(address: int | None, library: Library) -> Message | None:
    """Return the question for the device at an address. Raises UsageError where none can be."""
    try:
        question = harmless_question(library, address)
    except EncodeError as error:
        raise UsageError(f"{_option(library)}: {error.problem}") from None
    if question is not None and library.exchanges[type(question)].address.silence(question):
        raise UsageError(f"{_option(library)}: no device answers at {address}")
    return question


def _next(found: Iterator[tuple[Check, Result]]) -> tuple[Check, Result] | None:
    """Return the result of the next check; None behind the last."""
    with shown_progress(lambda waited: f"looking, {waited:.0f} s; Ctrl-C ends"):
        return next(found, None)


def _open(library: Library, port: str, baud: float) -> Transport:
    return open_line(port, baud, library)


def _confirm(arguments: Namespace, pose: Pose) -> None:
    """Ask whether something may be moved. Raises UsageError if it may not."""
    if arguments.move not in pose.ids:
        known = f"{pose.noun}s have numbers from {pose.ids[0]} to {pose.ids[-1]}"
        raise UsageError(f"--move {arguments.move}: {known}")
    if arguments.yes:
        return
    if not sys.stdin.isatty():
        raise UsageError("--move asks first, and standard input is no terminal: use --yes")
    warning = f"{pose.noun} {arguments.move} will move by {STEP} steps and back; keep clear of it"
    print(f"{warning}. Go on? [y/N] ", end="", file=sys.stderr, flush=True)
    if sys.stdin.readline().strip().lower() not in {"y", "yes"}:
        raise UsageError("nothing was moved, and nothing was checked")


def _report(path: str) -> Report:
    try:
        return Report(path)
    except OSError as error:
        raise UsageError(f"{path} cannot be written: {error.strerror or error}") from None


def _finish(
    report: Report,
    arguments: Namespace,
    diagnosis: Diagnosis,
    findings: list[tuple[Check, Result]],
) -> None:
    try:
        report.write(diagnosis, findings, arguments.model)
    except OSError as error:
        problem = f"{arguments.report} cannot be written: {error.strerror or error}"
        raise UsageError(problem) from None


def _as_json(check: Check, result: Result) -> str:
    record: dict[str, Any] = {"check": check.id, "title": check.title, "state": result.state}
    record |= {"seen": result.seen, "bytes": [format_hex(each) for each in result.evidence]}
    return json.dumps(record | {"note": result.note, "next": result.advice})


def _as_text(check: Check, result: Result) -> str:
    """Return the state, the check, what was seen; below it bytes or text, notes, what to do."""
    state = f"{result.state:8}"
    if takes_colour(sys.stdout):
        state = painted(state, _COLOURS[result.state])
    lines = [f"{state} {check.id:12} {visible(result.seen)}"]
    for each in result.evidence:
        text = plain_text(each)
        if not text:
            lines.append(f"{'':8} {'bytes':>12} {format_hex(each)}")
        elif text not in result.seen:
            lines.append(f"{'':8} {'text':>12} {text}")
    for label, said in (("note", result.note), ("next", result.advice)):
        if said:
            lines.append(f"{'':8} {label:>12} {visible(said)}")
    return "\n".join(lines)
