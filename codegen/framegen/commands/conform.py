"""`framegen conform`: tests a codec in any language, or a device, against the spec."""

from __future__ import annotations

import json
import sys
from argparse import ArgumentTypeError
from contextlib import closing, suppress
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Iterator

    from framegen.conformance.language import Question
    from framegen.conformance.trial import Trial
    from framegen.model.model import Model

SUMMARY = "Test a codec in any language, or the firmware behind a port, against the spec."
EXAMPLES = (
    ("framegen conform -- ./codec", "test a program; 1 if an answer is wrong, and which"),
    ("framegen conform busservo --more 1000 -- ./codec", "with 1000 random questions besides"),
    ("framegen conform --format badge -- ./codec", "a badge, as SVG, for a README"),
    ("framegen conform --port /dev/ttyUSB0 --log run.hex", "test firmware, with queries alone"),
    ("framegen conform --questions", "print the questions, a line each"),
    ("framegen conform --questions | framegen conform --answers", "print the right answers"),
)
_SEEDS = 2**32
# More than these nobody means.
_DIGITS, _LONGEST = 20, 3600
# Seconds that a program has for an answer.
_TIMEOUT = 10.0


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    from framegen.conformance import firmware  # noqa: PLC0415

    parser.usage = (
        "framegen conform [SPEC] [OPTIONS] -- PROGRAM ...\n"
        "       framegen conform [SPEC] --port PORT [OPTIONS]\n"
        "       framegen conform [SPEC] --questions | --answers"
    )
    parser.add_argument("spec", nargs="?", type=Path, metavar="SPEC", help="a spec file")
    # What stands behind `--`, whatever it looks like.
    parser.set_defaults(program=[])
    how = parser.add_mutually_exclusive_group()
    how.add_argument("--questions", action="store_true", help="print the questions")
    how.add_argument(
        "--answers",
        action="store_true",
        help="answer the questions on standard input as the reference does",
    )
    parser.add_argument(
        "--more", type=_natural, default=0, metavar="N", help="ask N random questions as well"
    )
    parser.add_argument(
        "--seed", type=_natural, metavar="N", help="the seed of --more, as a report prints it"
    )
    parser.add_argument(
        "--timeout",
        type=_seconds,
        metavar="SECONDS",
        help="time limit of an answer: 10 for a program, 0.25 and the time on the line for a port",
    )
    parser.add_argument(
        "--format",
        choices=("text", "json", "badge"),
        default="text",
        help="the format of the report",
    )
    firmware.add_arguments(parser)


def _natural(text: str) -> int:
    if not (text.isascii() and text.isdigit() and len(text) < _DIGITS):
        raise ArgumentTypeError(f"{text!r} is not a whole number from 0 up")
    return int(text)


def _seconds(text: str) -> float:
    with suppress(ValueError):
        seconds = float(text)
        if 0 < seconds <= _LONGEST:
            return seconds
    raise ArgumentTypeError(f"{text!r} is not a number of seconds, up to {_LONGEST}")


def run(arguments: Namespace) -> int:
    """Ask, compare and report. 0 where all answers agree, 1 where one does not. Raises Unusable."""
    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.conformance import firmware  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    if arguments.program and (arguments.questions or arguments.answers):
        raise Unusable(
            f"no program is tested with --{'questions' if arguments.questions else 'answers'}",
            hint="leave out `--` and what follows it",
        )
    model = compiled(arguments.spec).model
    if arguments.port is not None:
        return _ask_firmware(model, arguments)
    firmware.refuse_without_port(arguments)
    if arguments.answers:
        return _answer(model)
    if arguments.more and arguments.seed is None:
        from secrets import randbelow  # noqa: PLC0415

        arguments.seed = randbelow(_SEEDS)
    if arguments.questions:
        for _title, question in _questions(model, arguments):
            print(question.line)
        return 0
    if not arguments.program:
        raise Unusable(
            "no program is named",
            hint="put it after `--`: framegen conform -- ./codec; or test firmware: --port PORT",
        )
    return _hold(model, arguments)


def _ask_firmware(model: Model, arguments: Namespace) -> int:
    from framegen.conformance import firmware  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    others = ("questions", "answers", "program", "more")
    for name in [each for each in others if getattr(arguments, each)]:
        given = "a program" if name == "program" else f"--{name}"
        raise Unusable(f"--port tests firmware, and does not go with {given}", hint="leave it out")
    return firmware.run(model, arguments)


def _questions(model: Model, arguments: Namespace) -> Iterator[tuple[str, Question]]:
    from framegen.conformance.further import further  # noqa: PLC0415
    from framegen.conformance.questions import questions  # noqa: PLC0415

    yield from questions(model)
    if arguments.more:
        yield from islice(further(model, arguments.seed), arguments.more)


def _answer(model: Model) -> int:
    """Answer the questions on the input; report a line that is no question, and go on."""
    from framewire.command.console import UNUSABLE, visible  # noqa: PLC0415

    from framegen.conformance.language import END, answer  # noqa: PLC0415
    from framegen.conformance.question_reader import NotAQuestion, read_question  # noqa: PLC0415

    status = 0
    for line in filter(bytes.strip, sys.stdin.buffer):
        try:
            lines = answer(model, read_question(model, line.decode("utf-8", "replace")))
        except NotAQuestion as error:
            lines, status = [f"error {visible(str(error))}"], UNUSABLE
        print(*lines, END, sep="\n", flush=True)
    return status


def _hold(model: Model, arguments: Namespace) -> int:
    from framegen.conformance.program import Program  # noqa: PLC0415
    from framegen.conformance.trial import hold  # noqa: PLC0415

    program = Program(arguments.program, arguments.timeout or _TIMEOUT)
    with closing(program):
        trial = hold(model, program, _questions(model, arguments))
    _tell(model, trial, arguments)
    return 0 if trial.conforms else 1


def _tell(model: Model, trial: Trial, arguments: Namespace) -> None:
    from framegen.conformance import report  # noqa: PLC0415

    match arguments.format:
        case "json":
            print(json.dumps(report.as_json(model, trial, arguments.program, arguments.seed)))
        case "badge":
            print(report.as_badge(model, trial), end="")
        case _:
            for line in report.as_text(model, trial, arguments.program):
                _show(line, report.colour_of(line))
    if arguments.more:
        sys.stdout.flush()
        again = f"--more {arguments.more} --seed {arguments.seed}"
        print(f"the same questions again: {again}", file=sys.stderr)


def _show(line: str, colour: str) -> None:
    from framewire.command.colour import painted, takes_colour  # noqa: PLC0415
    from framewire.command.console import visible, write_as_it_is  # noqa: PLC0415

    if colour and takes_colour(sys.stdout):
        # What a program said must not command the terminal.
        write_as_it_is(sys.stdout, painted(visible(line), colour) + "\n")
    else:
        print(line)
