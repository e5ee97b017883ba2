"""The verb `explain`: bytes as one frame, part by part, or where and why they are none."""

from __future__ import annotations

import json

from ..codec.hextext import HexError, read_hex
from ..explain.explanation import Judgement, explain
from ..explain.text import as_json, as_text
from ..frame.errors import DecodeError
from ..recording.form import LogError, without_log
from .exit_codes import DONE, NOT_ALL
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from ..codec.protocol_codec import ProtocolCodec
    from ..explain.explanation import Explanation
    from ..protocol.protocol import Protocol
    from .program import Program

ENDS = {NOT_ALL: "the bytes are no frame"}


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "bytes",
        nargs="+",
        metavar="HEX",
        help="bytes in hex: spaced or glued, with 0x and commas or without",
    )
    senders = program.library.codec.senders
    parser.add_argument("--direction", choices=senders, help="only what this end sends")
    parser.add_argument("--json", action="store_true", help="print one JSON object")


def run(arguments: Namespace, program: Program) -> int:
    """Print the explanation."""
    try:
        data = read_hex(without_log(" ".join(arguments.bytes)))
    except (HexError, LogError) as error:
        raise UsageError(str(error)) from None
    if not data:
        raise UsageError("there are no bytes to explain: give them in hex")
    library = program.library
    explanation = explained(library.protocol(), data, library.codec, arguments.direction)
    print(json.dumps(as_json(explanation)) if arguments.json else as_text(explanation))
    return DONE if explanation.readings else NOT_ALL


def explained(
    model: Protocol, data: bytes, codec: ProtocolCodec, sender: str | None = None
) -> Explanation:
    """Explain bytes as the library decodes them; as sent by one end alone, if it is given."""
    ways = {text: codec.directions(model.members[text]) for text in model.directions}
    names = {kind: name for name, kind in model.classes.items()}

    def judge(direction: str, frame: bytes) -> Judgement:
        try:
            message = codec.decode(frame, ways[direction])
        except DecodeError as error:
            return Judgement(None, error.reason.value, error.offset)
        return Judgement(names[type(message).__name__])

    chosen = [text for text, way in ways.items() if sender in (None, way.sender)]
    return explain(model, judge, data, chosen)
