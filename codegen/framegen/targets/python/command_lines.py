"""Command lines for the help of the command, each with what it does, as the lines of a tuple."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.message_view import MessageView

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.language.spec import Example
    from framegen.model.model import Model


def decode_examples(model: Model) -> list[str]:
    """For `decode`: the ways to hand it bytes."""
    program, sender = model.spec.protocol.name, model.directions[0].sender
    frame = _messages(model)[0].example.hex
    hex_ = frame.hex(" ").upper()
    examples = [
        (f"{program} decode {hex_}", "bytes in hex, however they are written"),
        (f"{program} decode line.bin", "a recording, hex or raw bytes"),
        (f"{program} decode --direction {sender} -", "what arrives on standard input"),
        (f"{program} decode --json line.bin", "a line of JSON for each message and noise"),
        (f"{program} decode -t absolute line.hex", "a recording, with the time of day"),
        (f"{program} decode --csv line.hex", "a row for each, for a spreadsheet"),
    ]
    return _pairs(examples)


def encode_examples(model: Model) -> list[str]:
    """For `encode`: an example of each shape of message."""
    program = model.spec.protocol.name
    shapes: dict[tuple[bool, bool], tuple[str, str]] = {}
    for message in _messages(model):
        words = message.command_words(message.example.values)
        line = " ".join([program, "encode", message.name, *words])
        shape = bool(message.given), message.repeat is not None
        shapes.setdefault(shape, (line, message.layout.message.summary))
    return _pairs(shapes.values())


def line_examples(model: Model) -> dict[str, list[str]]:
    """For each verb that has to do with a port, in the order of the alphabet."""
    program = model.spec.protocol.name
    questions = _questions(model)
    lines = {
        "bench-line": [
            (f"{words} -n 20" if at else words, f"how long {reply} takes to come")
            for at, (words, _, reply) in enumerate(questions)
        ],
        "doctor": [
            ("", "the port that is plugged in, and the board behind it"),
            ("--port COM7", "this port"),
            ('--port COM7 --board "LSC-32, V1.3" --report line.hex', "a report to be sent in"),
            ("--port COM7 --json", "for a program to read"),
        ],
        "monitor": [
            ("--port COM7", "every frame and all noise"),
            ("--port COM7 -t delta -n 5", "five, and their distances"),
            ("--port COM7 --only noise", "what is no frame"),
            ("--port COM7 --log line.hex", "kept for `decode`"),
            ("--port COM7 --direction any -t absolute", "both ends of a line, the time of day"),
            ("--port COM7 --hide noise --json", "messages, for a program to read"),
        ],
        "ports": [
            ("", "the name, VID:PID and description of each"),
            ("--json", "a line of JSON for each"),
        ],
        "replay": [
            ("line.hex --dry-run", "what would be sent, and when"),
            ("line.hex --port COM7", "what was recorded, once more"),
            ("line.hex --port COM7 --speed 0.5", "at half the pace"),
            ("line.bin --port COM7 --skip-noise", "raw bytes, of which some are no frames"),
        ],
        "send": [*_commands(model)[:4], *((words, what) for words, what, _ in questions)],
        "simulate": [
            ("", "a board behind a port, whose name is printed first"),
            ("--help", "what else it can do"),
        ],
    }
    if model.spec.pose is not None:
        lines["doctor"].append(("--port COM7 --move 1", "also whether that moves; asks first"))
        lines |= {
            "play": [
                ("poses.json --dry-run", "what would be sent, and when"),
                ("poses.json --port COM7", "from pose to pose, each in a second"),
                ("poses.json --port COM7 --time-ms 500 --pause 1 --repeat 3", "faster, and thrice"),
            ],
            "teach": [
                ("poses.json --port COM7", "all that are there, at each Enter"),
                ("poses.json --port COM7 --ids 1-3 --append", "three, behind what is recorded"),
            ],
        }
    return {
        verb: _pairs((f"{program} {verb} {words}".rstrip(), what) for words, what in examples)
        for verb, examples in sorted(lines.items())
    }


def _commands(model: Model) -> list[tuple[str, str]]:
    """An example of each message of the first direction, and what it does."""
    return [
        (_sent(message, message.example), message.layout.message.summary)
        for message in _messages(model)
        if message.layout.direction == model.directions[0]
    ]


def _questions(model: Model) -> list[tuple[str, str, str]]:
    """An example of each question, what it does, and its reply."""
    return [
        (_sent(message, message.example), message.layout.message.summary, exchange.reply.name)
        for exchange in model.exchanges
        for message in [MessageView(exchange.request, model)]
        if exchange.reply is not None
    ]


def _sent(message: MessageView, example: Example) -> str:
    words = " ".join([message.name, *message.command_words(example.values)])
    return f"--port COM7 {words}"


def _messages(model: Model) -> list[MessageView]:
    return [MessageView(message, model) for message in model.messages.values()]


def _pairs(examples: Iterable[tuple[str, str]]) -> list[str]:
    return [
        Bracketed("(", [literal(line), literal(what)], "),").fitted(8) for line, what in examples
    ]
