"""A device that answers as its specification says: nobody has to write it."""

from __future__ import annotations

from contextlib import suppress
from functools import cached_property
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any, ClassVar
from warnings import catch_warnings, simplefilter

from ..client.exchange import column
from ..frame.errors import EncodeError
from .registers import Registers
from .virtual_device import VirtualDevice

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from ..client.exchange import Exchange
    from ..frame.lists import List
    from ..frame.message import Message
    from .command import Simulator


class DerivedDevice(VirtualDevice):
    """A device that has been switched on at time 0, and does what the specification tells.

    A reply repeats what its request asks for, holds what was set by a command that has the same
    field, and is otherwise the first example of the specification. What acknowledges a command
    follows it. A handler that a class below overrides takes the place of that; `answer` is what
    would have been said. It is for one of these `addresses`, or for any where there are none.

    `every` is after how many seconds it sends the next of those messages that no request leads to:
    0.0 for never.
    """

    every: float = 0.0
    # What each handler is until somebody overrides it.
    _silent_handlers: ClassVar[Mapping[str, object]]

    def __init_subclass__(cls) -> None:
        super().__init_subclass__()
        made = next((base for base in cls.__mro__ if "_handlers" in vars(base)), None)
        cls._silent_handlers = {} if made is None else vars(made)

    def __init__(self, *addresses: int) -> None:
        super().__init__()
        if addresses:
            self.addresses = frozenset(addresses)
        self._registers = Registers(self.library.exchanges)
        self._due = 0.0
        self._sent = 0

    @classmethod
    def command(cls) -> Simulator:
        """Return the command that puts such a device behind a port."""
        from .derived_command import simulator_of  # noqa: PLC0415 - for those who run it

        return simulator_of(cls)

    def answer(self, message: Message) -> Message | None:
        """Return the reply to a message, as it follows from the specification; None for none."""
        exchange = self.library.exchanges[type(message)]
        acknowledged, reply = exchange.acknowledged, exchange.reply
        if acknowledged is not None and not exchange.address.silence(message):
            fields = iter([_repeated(acknowledged, message), {}])
            self.send(next(self._possible(acknowledged, fields)))
        if reply is None:
            return None
        # What was set may be more than a reply can hold.
        candidates = (
            self._reply_fields(exchange, reply, message, held)
            for held in (self._registers.load(message), {})
        )
        found = next(self._possible(reply, candidates), None)
        if found is None:
            self.log(self.name, f"has no {reply.__name__} for {message!r}")
        return found

    def accepted(self, message: Message) -> None:
        """Remember what a message sets."""
        super().accepted(message)
        self._registers.store(message)

    def reboot(self, seconds: float) -> None:
        """Switch it off and on: it has forgotten what was set."""
        super().reboot(seconds)
        self._registers.clear()

    @property
    def next_event(self) -> float | None:
        """When the next message that nobody asked for is sent."""
        return max(self._due + self.every, self.now) if self.every and self.unasked else None

    def advance_to(self, moment: float) -> None:
        """Advance to a moment, and send what is due by then."""
        while (due := self.next_event) is not None and due <= moment:
            super().advance_to(due)
            self.send(self._example(self.unasked[self._sent % len(self.unasked)], {}))
            self._due = due
            self._sent += 1
        super().advance_to(moment)

    @cached_property
    def unasked(self) -> tuple[type[Message], ...]:
        """The messages that it sends, and that no request leads to."""
        led_to = {*self.library.answers, *self.library.reports, *self.library.acknowledging}
        return tuple(
            kind
            for kind in self.library.codec.messages
            if kind.DIRECTION is self.library.codec.received and kind not in led_to
        )

    # ---------------------------------------------------------------- details

    def _reply_to(self, message: Message) -> Message | None:
        name = self._handler_of[type(message)]
        if getattr(getattr(self, name), "__func__", None) is self._silent_handlers[name]:
            return self.answer(message)
        return super()._reply_to(message)

    @cached_property
    def _examples(self) -> dict[str, bytes]:
        """The first example of each class of messages."""
        facts = self.library.protocol()
        return {
            facts.classes[name]: bytes.fromhex(each.examples[0].hex)
            for name, each in facts.messages.items()
        }

    def _fields(self, kind: type[Message]) -> dict[str, Any]:
        return kind.decode(self._examples[kind.__name__]).to_dict()

    def _possible(
        self, kind: type[Message], candidates: Iterator[Mapping[str, Any]]
    ) -> Iterator[Message]:
        """Yield the example of a class with other fields, those with which there is one."""
        for fields in candidates:
            with suppress(EncodeError):
                yield self._example(kind, fields)

    def _example(self, kind: type[Message], fields: Mapping[str, Any]) -> Message:
        """Return the example of a class, with other fields. Raises EncodeError."""
        with catch_warnings():
            simplefilter("ignore", DeprecationWarning)
            return kind.from_dict({**self._fields(kind), **fields})

    def _reply_fields(
        self, exchange: Exchange, reply: type[Message], request: Message, held: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Return the fields of a reply that are not as in its example."""
        fields = self._fields(reply)
        found = {**held}
        if exchange.failures.field:
            found[exchange.failures.field] = exchange.failures.good
        if exchange.counter is not None:
            name = exchange.counter[0]
            found[name] = getattr(request, name)
        for name in exchange.address.senders:
            if name in fields:
                found[name] = exchange.address.of(request)
        items, count = reply.SHAPE.items, exchange.counted.asked(request)
        if items is not None and count is not None:
            found[items.name] = _as_many({**fields, **found}[items.name], count, items)
        for requested, reported in exchange.echoed:
            name, _, inner = reported.partition(".")
            values = column(request, requested)
            if inner:
                of = getattr(reply, name)
                found[name] = [
                    self._element(request, of, fields[name], inner, value) for value in values
                ]
            elif isinstance(fields[name], list):
                found[name] = values
            elif values:
                found[name] = values[0]
        return found

    def _element(
        self, request: Message, items: List[Any], examples: list[Any], inner: str, value: int
    ) -> dict[str, Any]:
        """Return the element with this value of its field `inner`: as it was set, or an example."""
        held = self._registers.load(request, key=value).get(items.name)
        same = [each for each in examples if each[inner] == value]
        first = next(filter(None, [held, *same, *examples]), _zeros(items))
        return {**first, inner: value}


def _repeated(kind: type[Message], request: Message) -> dict[str, Any]:
    """Return the fields of a request that a message has, too."""
    fields = request.to_dict()
    return {name: fields[name] for name in kind.__match_args__ if name in fields}


def _as_many(values: list[Any], count: int, items: List[Any]) -> list[Any]:
    """Return so many elements: these again and again, or zeros where there are none."""
    return [*islice(cycle(values or [_zeros(items)]), count)]


def _zeros(items: List[Any]) -> Any:
    """Return an element of zeros, or of the values next to 0 that its fields can have."""
    low_and_high = ((getattr(each, "low", 0), getattr(each, "high", 0)) for each in items.fields)
    values = [sorted((low, 0, high))[1] for low, high in low_and_high]
    if items.element is None:
        return values[0]
    return dict(zip(items.element.__match_args__, values, strict=True))
