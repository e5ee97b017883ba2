"""A verb that sends one message: the values of its fields stand in the order of its method."""

from __future__ import annotations

import sys
import time

from ..frame.lists import List
from . import send
from .encode import note_deprecated
from .exit_codes import DONE, INTERRUPTED
from .limits import limits_of
from .link import add_port, failures_reported, open_client
from .numerals import steps_of_time
from .progress_thread import slept
from .questions import exchange_named, in_parts
from .values import written

TYPE_CHECKING = False
if TYPE_CHECKING:
    import argparse

    from ..client.client import Client
    from ..client.library import Library
    from ..frame.message import Message
    from .limits import Chosen
    from .program import Program


class MethodVerb:
    """A verb that sends a message of this end."""

    def __init__(self, message: str, library: Library) -> None:
        self._library = library
        self.kind, self._exchange = exchange_named(message, library)
        self._lasts, self._steps = self._exchange.lasts or ("", 1)
        address = self._exchange.address.field
        names = [*([address] if address else []), *self._exchange.arguments]
        self._names = [name for name in names if name != self._lasts]

    def ends(self, program: Program) -> dict[int, str]:
        """Return what its exit statuses mean, besides those of every verb."""
        return send.ends(program)

    @property
    def may_be_empty(self) -> bool:
        """Whether its list may be left out."""
        items = self.kind.SHAPE.items
        return items is not None and 0 in items.counts

    def add_arguments(self, parser: argparse.ArgumentParser, program: Program) -> None:
        """Declare the arguments of the verb."""
        optional = dict(self.kind.DEFAULTS)
        for name in self._names:
            field = getattr(self.kind, name)
            count: str | None = "?" if name in optional else None
            if isinstance(field, List):
                count = "*" if self.may_be_empty else "+"
            shown = written(field).removesuffix(",...") if count in {"*", "+"} else written(field)
            # A name of its own, lest a field called `port` took the place of the option.
            parser.add_argument(f"field {name}", nargs=count, metavar=shown)
        if self._lasts:
            parser.add_argument(
                "--in",
                dest="within",
                type=steps_of_time(highest=self._longest, per_second=self._steps),
                default=min(self._steps, self._longest),
                metavar="TIME",
                help="how long it takes: 1s, 500ms (default: 1s)",
            )
            parser.add_argument(
                "--no-wait", action="store_true", help="end as soon as it is sent, not when over"
            )
        add_port(parser, program)
        send.add_sending(parser, program, answered=self._exchange.reply is not None)

    @property
    def _longest(self) -> int:
        """The longest time that its field can carry, in its unit."""
        high: int = getattr(self.kind, self._lasts).high
        return high

    def run(self, arguments: argparse.Namespace, program: Program) -> int:
        """Send the message; print the reply, or wait until its effect is over."""
        messages = self.messages(arguments)
        note_deprecated(self.kind)
        retries = getattr(arguments, "retries", 0)
        limits = limits_of(arguments)
        with (
            failures_reported(arguments),
            open_client(arguments, program, retries=retries, limits=limits.allowed) as controller,
        ):
            messages = messages or self.without_words(controller)
            if self._exchange.reply is not None:
                return send.exchanged(controller, messages, arguments, self._library)
            return self._commanded(controller, messages[0], arguments)

    def messages(self, arguments: argparse.Namespace) -> list[Message]:
        """Return what to send; nothing where that is known only from the line."""
        words: list[str] = []
        for name in self._names:
            given = getattr(arguments, f"field {name}")
            if isinstance(given, list):
                given = ",".join(given)
            if given is not None:
                words.append(f"{name}={given}")
        if self._lasts:
            words.append(f"{self._lasts}={arguments.within}")
        return in_parts(self.kind.__name__, words, self._library)

    def without_words(self, _controller: Client, /) -> list[Message]:
        """Return what to send where no values are given."""
        return []

    def _commanded(
        self, controller: Client, message: Message, arguments: argparse.Namespace
    ) -> int:
        """Send what nothing answers, and wait until its effect is over if that lasts."""
        try:
            sent = send.commanded(controller, message, limits_of(arguments))
            if self._lasts and not arguments.no_wait:
                left = sent.delay + sent.duration + self._exchange.seconds(message)
                slept(time.monotonic() + left, "over")
        except KeyboardInterrupt:
            return self.interrupted(controller, message, limits_of(arguments))
        return DONE

    def interrupted(self, _controller: Client, message: Message, _limits: Chosen, /) -> int:
        """Say what becomes of a message whose end is not waited for; return the exit status."""
        print(f"\n{type(message).__name__} goes on to its end", file=sys.stderr)
        return INTERRUPTED
