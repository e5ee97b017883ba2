"""Command lines for the help of the command, each with what it does, as the lines of a tuple."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.message_view import MessageView

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.layout import Layout


def decode_examples(layout: Layout) -> list[str]:
    """For `decode`: the ways to hand it bytes."""
    program, sender = layout.spec.protocol.name, layout.directions[0].sender
    frame = next(message.example.hex for message in _messages(layout) if message.example)
    hex_ = frame.hex(" ").upper()
    examples = [
        (f"{program} decode {hex_}", "bytes in hex, however they are written"),
        (f"{program} decode line.bin", "a recording, raw or in hex"),
        (f"{program} decode --direction {sender} -", "what arrives on standard input"),
        (f"{program} decode --json line.bin", "a line of JSON for each message and noise"),
    ]
    return _pairs(examples)


def encode_examples(layout: Layout) -> list[str]:
    """For `encode`: an example of each shape of message."""
    program = layout.spec.protocol.name
    shapes: dict[tuple[bool, bool], tuple[str, str]] = {}
    for message in _messages(layout):
        if message.example is not None:
            words = message.command_words(message.example.values)
            line = " ".join([program, "encode", message.name, *words])
            shape = bool(message.given), message.repeat is not None
            shapes.setdefault(shape, (line, message.layout.message.summary))
    return _pairs(shapes.values())


def line_examples(layout: Layout) -> dict[str, list[str]]:
    """For each verb that has to do with a port."""
    program = layout.spec.protocol.name
    sent = [
        (f"{program} send --port COM7 {' '.join([message.name, *words])}", summary)
        for message in _messages(layout)
        if message.example is not None and message.layout.direction == layout.directions[0]
        for words in [message.command_words(message.example.values)]
        for summary in [message.layout.message.summary]
    ]
    return {
        "monitor": _pairs(
            [
                (f"{program} monitor --port COM7", "every frame and all noise"),
                (f"{program} monitor --port COM7 -t delta -n 5", "five, and their distances"),
                (f"{program} monitor --port COM7 --only noise", "what is no frame"),
                (f"{program} monitor --port COM7 --log line.hex", "kept for `decode`"),
            ]
        ),
        "ports": _pairs(
            [
                (f"{program} ports", "the name, VID:PID and description of each"),
                (f"{program} ports --json", "a line of JSON for each"),
            ]
        ),
        "send": _pairs(sent[:4]),
        "simulate": _pairs(
            [
                (f"{program} simulate", "a board behind a port, whose name is printed first"),
                (f"{program} simulate --help", "what else it can do"),
            ]
        ),
    }


def _messages(layout: Layout) -> list[MessageView]:
    return [MessageView(message, layout) for message in layout.messages.values()]


def _pairs(examples: Iterable[tuple[str, str]]) -> list[str]:
    return [
        Bracketed("(", [literal(line), literal(what)], "),").fitted(8) for line, what in examples
    ]
