"""The verb `send`: sends any message of this end, and prints its reply, if it has one."""

from __future__ import annotations

import sys

from ..client.exchange import UNFAILING
from ..client.long_question import left_out
from ..frame.errors import EncodeError, LimitError, ProtocolError
from ..line.link_errors import TransportError
from ..recording.entry import Entry
from . import link
from .encode import note_deprecated
from .entries import EntryLines
from .exit_codes import DONE, NOT_ALL
from .limits import add_limits, limits_of
from .link import add_port, add_timeout, failures_reported, open_client
from .numerals import at_least
from .progress_thread import shown_progress
from .questions import in_parts
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace
    from typing import Any

    from ..client.client import Client
    from ..client.library import Library
    from ..client.request import Sent
    from ..frame.message import Message
    from .limits import Chosen
    from .program import Program


def ends(program: Program) -> dict[int, str]:
    """Return what its exit statuses mean, besides those of every verb."""
    not_all = "no reply came in time, or it reported less than was requested"
    if any(each.failures is not UNFAILING for each in program.library.exchanges.values()):
        not_all += ", or the device refused or failed"
    return link.ENDS | {NOT_ALL: not_all}


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the arguments of the verb."""
    add_port(parser, program)
    parser.add_argument("message", metavar="MESSAGE", help="its name, as in Python")
    parser.add_argument(
        "fields", nargs="*", metavar="FIELD=VALUE", help="numbers, names of values, or lists"
    )
    add_sending(parser, program)


def add_sending(parser: ArgumentParser, program: Program, *, answered: bool = True) -> None:
    """Declare the options of whatever sends a message, `answered` or not."""
    add_timeout(parser)
    add_limits(parser, program)
    if not answered:
        return
    parser.add_argument(
        "--retries",
        type=at_least(0),
        default=0,
        metavar="N",
        help="ask so often again where no reply comes (default: 0)",
    )
    parser.add_argument("--json", action="store_true", help="print the reply as a line of JSON")


def run(arguments: Namespace, program: Program) -> int:
    """Send the message, and print the reply."""
    messages = in_parts(arguments.message, arguments.fields, program.library)
    note_deprecated(type(messages[0]))
    with (
        failures_reported(arguments),
        open_client(
            arguments, program, retries=arguments.retries, limits=limits_of(arguments).allowed
        ) as controller,
    ):
        return exchanged(controller, messages, arguments, program.library)


def exchanged(
    controller: Client, messages: list[Message], arguments: Namespace, library: Library
) -> int:
    """Send messages, one after the other, and print the replies; return the exit status."""
    if len(messages) > 1:
        note = f"sent in {len(messages)} requests: one reply has no room for so much"
        print(note, file=sys.stderr)
    lines = EntryLines(sys.stdout, "json" if arguments.json else "text", library.codec)
    missing: dict[str, list[int]] = {}
    unanswered: ProtocolError | None = None
    for message in messages:
        try:
            replies = _answers(controller, message, arguments, library)
        except TransportError:
            raise
        except ProtocolError as error:
            unanswered = error
            break
        for reply in replies:
            lines.show(Entry(reply, reply.DIRECTION.sender, 0))
            sys.stdout.flush()
            requested, left, _ = left_out(library.exchanges, message, reply)
            missing.setdefault(requested, []).extend(left)
    for requested, values in missing.items():
        if values:
            listed = ", ".join(str(value) for value in values)
            print(f"the reply is incomplete: nothing of {requested} {listed}", file=sys.stderr)
    if unanswered is not None:
        print(unanswered, file=sys.stderr)
    return NOT_ALL if unanswered is not None or any(missing.values()) else DONE


def commanded(controller: Client, message: Message, limits: Chosen) -> Sent:
    """Send a message that nothing answers. Raises UsageError for what is not sent."""
    try:
        return controller.send(message)
    except LimitError as error:
        raise limits.refused(error) from None
    except EncodeError as error:
        raise UsageError(str(error)) from None


def _answers(
    controller: Client, message: Message, arguments: Namespace, library: Library
) -> list[Message]:
    """Return the reply to a request, and of one to all whatever comes in time; none to a command.

    Raises UsageError for what is not sent.
    """
    exchange = library.exchanges[type(message)]
    reply = exchange.reply
    try:
        if reply is None:
            commanded(controller, message, limits_of(arguments))
            return []
        with shown_progress(lambda waited: f"waiting for {reply.__name__}, {waited:.0f} s"):
            if exchange.address.silence(message):
                return _gathered(controller, message, arguments.timeout)
            return [controller.request(message)]
    except LimitError as error:
        raise limits_of(arguments).refused(error) from None
    except EncodeError as error:
        raise UsageError(str(error)) from None


def _gathered(controller: Any, message: Message, within: float) -> list[Message]:
    """Return what comes in time for a question to all; only such a protocol has the method."""
    replies: list[Message] = controller.gather(message, within=within)
    return replies
