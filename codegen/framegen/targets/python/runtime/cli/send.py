"""The verb `send`: sends any message of this end, and prints the reply where there is one."""

from __future__ import annotations

import sys

from ..errors import EncodeError
from ..exchanges import EXCHANGES, RECEIVED
from ..link_errors import NoReplyError
from ..opening import open_controller
from .decode import event_as_json, event_as_text
from .encode import message_named
from .link import add_port, failures_told
from .unusable import UnusableError
from .values import message_from_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace


def add_arguments(parser: ArgumentParser) -> None:
    """Declares the arguments of the verb."""
    add_port(parser)
    parser.add_argument("message", metavar="MESSAGE", help="its name, such as it has in Python")
    parser.add_argument(
        "fields", nargs="*", metavar="FIELD=VALUE", help="numbers, names of values, or lists"
    )
    parser.add_argument("--retries", type=int, default=0, help="ask so often again (default: 0)")
    parser.add_argument("--json", action="store_true", help="print the reply as a line of JSON")


def run(arguments: Namespace) -> int:
    """Sends the message. 1: no reply came in time."""
    message = message_from_text(message_named(arguments.message), arguments.fields)
    exchange = EXCHANGES.get(type(message))
    if exchange is None:
        names = ", ".join(kind.__name__ for kind in EXCHANGES)
        raise UnusableError(f"{type(message).__name__} is never sent from here; {names} are")
    with failures_told(), open_controller(arguments.port, retries=arguments.retries) as controller:
        try:
            if exchange.reply is None:
                controller.send(message)
                return 0
            reply = controller.request(message)
        except EncodeError as error:
            raise UnusableError(str(error)) from None
        except NoReplyError as error:
            print(error, file=sys.stderr)
            return 1
    print((event_as_json if arguments.json else event_as_text)(reply, 0, RECEIVED))
    return 0
