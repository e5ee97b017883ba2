"""`framegen explain`: explains the bytes of a frame."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.codec.hextext import HexError, read_hex
from framewire.recording.form import LogError, without_log

from framegen.reading.text import shown

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from collections.abc import Sequence

    from framewire.explain.explanation import Explanation

    from framegen.model.model import Model

# Enough of a text to find a place by; a long paste is cut around it.
_SHOWN = 30
SUMMARY = "Explain a frame byte by byte, or show where and why bytes are no frame."
EXAMPLES = (
    ("framegen explain 55 55 08 03 01 E8 03 01 20 03", "each byte, and what it says"),
    ("framegen explain 5555040F4C1D --direction controller", "as sent by the controller alone"),
    ("framegen explain 0x55,0x55,0x09,0x03,0x01,0xE8", "where and why it is no frame"),
    ("framegen explain busservo 55 55 02 07", "by spec/busservo.yaml alone"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.usage = "framegen explain [SPEC] HEX ... [--direction SENDER] [--json]"
    parser.add_argument(
        "words",
        nargs="+",
        metavar="HEX",
        help="bytes in hex, in any notation: with or without blanks, 0x and commas",
    )
    parser.add_argument(
        "--direction", metavar="SENDER", help="only frames that this endpoint sends"
    )
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace) -> int:
    """Print the explanation. 0 for a frame, 1 for none. Raises Unusable."""
    from framewire.explain.text import as_json, as_text  # noqa: PLC0415

    from framegen.commands.spec_argument import compiled  # noqa: PLC0415
    from framegen.project import all_specs  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    spec, words = None, arguments.words
    if _is_spec(words[0]):
        spec, words = Path(words[0]), words[1:]
    try:
        text = without_log(" ".join(words))
        data = read_hex(text)
    except LogError as error:
        raise Unusable(str(error)) from None
    except HexError as error:
        raise Unusable(_pointed(text, error), hint=error.hint) from None
    if not data:
        raise Unusable("there are no bytes to explain", hint="give them in hex, like 55 55 02 07")
    models = [compiled(file).model for file in ([spec] if spec else all_specs())]
    explanation = _closest(models, data, arguments.direction)
    print(json.dumps(as_json(explanation)) if arguments.json else as_text(explanation))
    return 0 if explanation.readings else 1


def _closest(models: Sequence[Model], data: bytes, sender: str | None) -> Explanation:
    """Explain bytes by the protocol of which they are a frame, or come closest to one."""
    from framegen.commands.capture_argument import directions_from  # noqa: PLC0415
    from framegen.explain import explain  # noqa: PLC0415

    senders = {way.sender for model in models for way in model.directions}
    asked = [
        model
        for model in models
        # A sender that none of them has is reported as one of the first.
        if sender not in senders or sender in {way.sender for way in model.directions}
    ]
    explanations = [explain(each, data, directions_from(each, sender)) for each in asked]
    return max(explanations, key=_rows)


def _rows(explanation: Explanation) -> tuple[bool, int]:
    """Tell how close bytes came to a frame: whether they are one, and how much of it agrees."""
    agreed = (len(refusal.rows) for refusal in explanation.refusals)
    return bool(explanation.readings), max(agreed, default=0)


def _pointed(text: str, error: HexError) -> str:
    """Report text that is no hex, and show the place with a caret under it."""
    start = max(0, error.at - _SHOWN)
    line = shown(text[start : error.at + _SHOWN])
    place = error.at - start
    carets = "^" * max(1, min(len(error.wrong), len(line) - place))
    return f"`{shown(error.wrong[:_SHOWN])}` {error.problem}\n  {line}\n  {' ' * place}{carets}"


def _is_spec(word: str) -> bool:
    from framegen.project import named_spec  # noqa: PLC0415

    if word.endswith((".yaml", ".yml")):
        return True
    try:
        return Path(word).is_file() or named_spec(word) is not None
    except (OSError, ValueError):  # longer than a path can be, or with a NUL in it: bytes
        return False
