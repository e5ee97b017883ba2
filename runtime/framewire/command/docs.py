"""The verb `docs`: what is known of each message, from the model that the package carries."""

from __future__ import annotations

import json
import sys

from ..protocol.form import data_of, message_data
from .exit_codes import DONE
from .reference_page import message_list, message_page
from .reference_search import find, folded, near
from .reference_topics import TOPICS
from .sheet import Sheet
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from typing import Any

    from ..protocol.message import Message
    from ..protocol.protocol import Protocol
    from .program import Program

ABOUT = """\
Prints the page of a message, which is named as here, as by the vendor, or by its number if no other
has that. For any other word, it lists the messages whose names or texts have that word."""


def add_arguments(parser: ArgumentParser, _program: Program) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "words",
        nargs="*",
        metavar="MESSAGE|WORD",
        help=f"a message, a word to find, or {' or '.join(TOPICS)}; without one, all are listed",
    )
    parser.add_argument("--json", action="store_true", help="print a line of JSON for each")


def run(arguments: Namespace, program: Program) -> int:
    """Print the page of a message, or a list of messages."""
    model, words = program.library.protocol(), " ".join(arguments.words)
    topic = next((name for name in TOPICS if folded(words) == name), "")
    found = [] if topic else find(model, words)
    if not topic and not found:
        names = near(model, words)
        usual = f"`{program.name} docs` lists all messages"
        hint = f"similar: {', '.join(names)}" if names else usual
        raise UsageError(f"no message is called {words[:40]!r} or mentions it; {hint}")
    if arguments.json:
        for entry in _entries(model, topic, found):
            print(json.dumps(entry))
        return DONE
    sheet = Sheet(sys.stdout)
    if topic:
        TOPICS[topic](sheet, model, program.library.codec)
    elif len(found) == 1:
        message_page(sheet, model, found[0])
    else:
        message_list(sheet, model, found, command="" if words else program.name)
    return DONE


def _entries(model: Protocol, topic: str, found: list[Message]) -> list[dict[str, Any]]:
    """Return what is printed as JSON."""
    if not topic:
        return [
            {"name": message.name, **message_data(message, model.byte_order)} for message in found
        ]
    entries = data_of(model)[topic]
    if isinstance(entries, dict):
        return [{"name": name, **entry} for name, entry in entries.items()]
    return list(entries)
