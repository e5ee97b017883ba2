"""The verb `encode`: the frame of a message, from its name and its fields."""

from __future__ import annotations

import sys

from ..frame.bytes_like import format_hex
from .console import visible
from .usage_error import UsageError
from .values import message_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.message import Message
    from .program import Program


def add_arguments(parser: ArgumentParser, _program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument("message", metavar="MESSAGE", help="its name, as in Python")
    parser.add_argument(
        "fields", nargs="*", metavar="FIELD=VALUE", help="numbers, names of values, or lists"
    )
    parser.add_argument("--raw", action="store_true", help="write the bytes themselves, not hex")


def run(arguments: Namespace, program: Program) -> int:
    """Print the frame in hex, or write its bytes with --raw."""
    kind = message_named(arguments.message, program.library.codec)
    frame = message_from_text(kind, arguments.fields).encode()
    note_deprecated(kind)
    if arguments.raw:
        sys.stdout.buffer.write(frame)
    else:
        print(format_hex(frame))
    return 0


def note_deprecated(kind: type[Message]) -> None:
    """Say on the error stream why a message should no longer be sent, if it should not."""
    if kind.DEPRECATED:
        print(visible(f"note: {kind.__name__} is deprecated: {kind.DEPRECATED}"), file=sys.stderr)


def message_named(name: str, codec: ProtocolCodec) -> type[Message]:
    """Return the message of that name, however its words are joined."""
    for kind in codec.messages:
        if _folded(kind.__name__) == _folded(name):
            return kind
    from difflib import get_close_matches  # only for those who mistype

    names = [kind.__name__ for kind in codec.messages]
    near = get_close_matches(name, names, n=1)
    hint = f"did you mean {near[0]}?" if near else f"there are {', '.join(names)}"
    raise UsageError(f"there is no message {name[:40]!r}; {hint}")


def _folded(name: str) -> str:
    return name.replace("_", "").replace("-", "").lower()
