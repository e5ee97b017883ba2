"""The exchanges of a client: each message that it sends, its method, and what comes back."""

from __future__ import annotations

import re
from dataclasses import dataclass
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any

from framegen.language.spec import ListField
from framegen.language.values import Method
from framegen.model.layout import is_constant, is_list, is_varying

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.language.spec import Message
    from framegen.model.layout import MessageLayout
    from framegen.model.roles import Roles
    from framegen.model.slots import Items, Number

# How many of each unit of time make a second.
STEPS_PER_SECOND = {"s": 1, "ms": 1000}


@dataclass(frozen=True)
class Exchange:
    """A request of the client, and what comes back for it.

    `verb` is what sends it from a shell. `echoed` pairs a field of the request with its place in
    the reply, such as `servo_ids` with `positions.servo_id`. `acknowledged` is the report that
    confirms the request, and `lasts` the field of the request that says how long a motion goes on.
    `refusal` comes instead of the reply where the device refuses. `failure` is the field of the
    reply that says what has failed, and `good` its value where nothing has. `asks_for` is the field
    of the request that says how many items the reply holds, or empty.
    """

    request: MessageLayout
    method: Method
    verb: str
    reply: MessageLayout | None
    reports: tuple[str, ...]
    echoed: tuple[tuple[str, str], ...]
    acknowledged: str | None
    lasts: Number | None
    refusal: MessageLayout | None
    failure: Number | None
    good: int
    asks_for: str

    @property
    def long_verb(self) -> str:
        """The verb that is named after the method."""
        return long_verb_of(self.request.name, self.request.message)

    @property
    def counted(self) -> Items | None:
        """The list of the reply that holds as many items as the request asks for."""
        return None if self.reply is None or not self.asks_for else self.reply.items

    def asked(self, values: Mapping[str, Any]) -> int:
        """Return how many items a request with these values asks for."""
        value = values[self.asks_for]
        return value if isinstance(value, int) else len(value)

    def miscounts(self, asked: Mapping[str, Any], replied: Mapping[str, Any]) -> bool:
        """Tell whether a reply holds another number of items than its request has asked for.

        One that says that the request has failed need not hold any.
        """
        if self.counted is None or self.has_failed(replied):
            return False
        return len(replied[self.counted.name]) != self.asked(asked)

    def with_count(self, asked: Mapping[str, Any], replied: dict[str, Any]) -> dict[str, Any]:
        """Return the values of a reply with as many items as were asked for: its own, in turn."""
        if self.counted is None or not self.miscounts(asked, replied):
            return replied
        blank = {each.name: getattr(each, "low", "") for each in self.counted.fields}
        usual = blank if self.counted.element else next(iter(blank.values()))
        turns = cycle(replied[self.counted.name] or [usual])
        count = min(self.asked(asked), self.counted.high)
        return {**replied, self.counted.name: [*islice(turns, count)]}

    def has_failed(self, values: Mapping[str, Any]) -> bool:
        """Tell whether a reply with these values says that the request has failed."""
        return self.failure is not None and values[self.failure.name] != self.good

    @property
    def answers(self) -> list[MessageLayout]:
        """The messages that may come back: the reply, and what comes instead of it."""
        return [each for each in (self.reply, self.refusal) if each is not None]

    @property
    def address(self) -> Number | None:
        """The part of the request that says for which device it is."""
        return self.request.frame.address

    @property
    def counter(self) -> Number | None:
        """The part of the request that numbers the frames."""
        return self.request.frame.counter

    @property
    def arguments(self) -> tuple[str, ...]:
        """The arguments of the method: the address, if there is one, and then as it declares."""
        front = () if self.address is None else (self.address.name,)
        return (*front, *self.method.arguments)

    @property
    def silent(self) -> dict[str, int]:
        """The addresses that nobody answers, by name."""
        if self.address is None:
            return {}
        values = self.address.field.values
        silent = self.address.silent
        return {name: each.value for name, each in values.items() if each.value in silent}

    @property
    def split(self) -> Items | None:
        """The list of the request that is sent in parts, where a reply has room for fewer.

        Only a request that is a single list, and returns a list, can be split; and only where the
        reply repeats it is it known which elements were answered.
        """
        requested, reply = self.request.items, self.reply
        if requested is None or reply is None or reply.items is None or not self.most:
            return None
        whole = len(self.request.arguments) == 1 and self.method.result == reply.items.name
        return requested if whole and self.most < requested.high else None

    @property
    def most(self) -> int:
        """The number of elements of the request that a reply can answer; 0 for no limit."""
        requested = self.request.items
        reported = None if self.reply is None else self.reply.items
        if requested is None or reported is None:
            return 0
        paired = any(
            (one.partition(".")[0], other.partition(".")[0]) == (requested.name, reported.name)
            for one, other in self.echoed
        )
        return reported.high if paired else 0


def exchanges(messages: Mapping[str, MessageLayout], roles: Roles) -> list[Exchange]:
    """Return an exchange for every message that the client sends, in the order of the spec."""
    return [
        _exchange(messages, message)
        for message in messages.values()
        if message.direction == roles.sent
    ]


def method_of(name: str, message: Message) -> Method:
    """Return the method that sends a message: declared, or named after it, its list first."""
    if message.method is not None:
        return message.method
    given = arguments_of(message)
    lists = [key for key in given if is_varying(message.fields[key])]
    numbers = [key for key in given if key not in lists]
    return Method(snake_case(name), (*lists, *numbers), "")


def verb_of(name: str, message: Message) -> str:
    """Return the verb that sends a message from a shell: declared, or named after its method."""
    return message.verb or long_verb_of(name, message)


def long_verb_of(name: str, message: Message) -> str:
    """Return the verb that is named after the method; it goes on when a shorter one is declared."""
    return method_of(name, message).name.replace("_", "-")


def arguments_of(message: Message) -> list[str]:
    """Return the fields that a user gives: all but counts, sizes, and what never changes."""
    fields = message.fields
    counters = {each for field in fields.values() for each in (field.counted_by, field.sized_by)}
    return [name for name in fields if name not in counters and not is_constant(fields[name])]


def paths_of(message: Message) -> dict[str, bool]:
    """Return every field that can be echoed, by path, and whether it is in a list."""
    paths: dict[str, bool] = {}
    for name in arguments_of(message):
        field = message.fields[name]
        if isinstance(field, ListField):
            given = (inner for inner, number in field.fields.items() if not is_constant(number))
            paths |= {f"{name}.{inner}": True for inner in given}
        else:
            paths[name] = is_list(field)
    return paths


def snake_case(name: str) -> str:
    """Return `servo_move` for `ServoMove`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def _exchange(messages: Mapping[str, MessageLayout], request: MessageLayout) -> Exchange:
    message = request.message
    reply = None if message.reply is None else messages[message.reply]
    failure = None if reply is None else reply.message.failure
    return Exchange(
        request,
        method_of(request.name, message),
        verb_of(request.name, message),
        reply,
        tuple(message.reports),
        tuple(message.echoed.items()),
        message.acknowledged,
        request.numbers_by_path.get(message.lasts or ""),
        None if message.refusal is None else messages[message.refusal],
        None if reply is None or failure is None else reply.numbers_by_path.get(failure.field),
        0 if failure is None else failure.good,
        message.asks_for or "",
    )
