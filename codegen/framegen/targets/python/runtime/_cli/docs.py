"""The verb `docs`: what is known of each message, from the model that the package carries."""

from __future__ import annotations

import json
import sys

from .._explanation.carried_model import protocol
from .examples import PROGRAM
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

    from .._explanation.protocol import Message, Protocol

ABOUT = """\
Of a message by its name, the vendor's name for it, or its number if that is enough to tell, its
page is printed; of any other word, the messages that have it in their names or their texts."""


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "words",
        nargs="*",
        metavar="MESSAGE|WORD",
        help=f"a message, a word to look for, or {' or '.join(TOPICS)}; all messages without it",
    )
    parser.add_argument("--json", action="store_true", help="print a line of JSON for each")


def run(arguments: Namespace) -> int:
    """Print the page of a message, or a list of messages."""
    model, words = protocol(), " ".join(arguments.words)
    topic = next((name for name in TOPICS if folded(words) == name), "")
    found = [] if topic else find(model, words)
    if not topic and not found:
        names = near(model, words)
        hint = f"near it: {', '.join(names)}" if names else f"`{PROGRAM} docs` lists all messages"
        raise UsageError(f"nothing here is called {words[:40]!r}, or speaks of it; {hint}")
    if arguments.json:
        for entry in _entries(model, topic, found):
            print(json.dumps(entry))
        return DONE
    sheet = Sheet(sys.stdout)
    if topic:
        TOPICS[topic](sheet, model)
    elif len(found) == 1:
        message_page(sheet, model, found[0])
    else:
        message_list(sheet, model, found, all_of_them=not words)
    return DONE


def _entries(model: Protocol, topic: str, found: list[Message]) -> list[dict[str, Any]]:
    """Return what is printed as JSON."""
    if not topic:
        return [{"name": message.name, **message.said} for message in found]
    entries = model.said[topic]
    if isinstance(entries, dict):
        return [{"name": name, **entry} for name, entry in entries.items()]
    return list(entries)
