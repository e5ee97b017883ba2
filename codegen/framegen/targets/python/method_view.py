"""A client's method as the templates show it: it sends one message."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Number
from framegen.targets.python.escape import WIDTH, Bracketed, Part, session
from framegen.targets.python.list_view import given
from framegen.targets.python.message_view import field_view
from framegen.targets.python.notes import noted
from framegen.targets.python.number_view import NumberView

if TYPE_CHECKING:
    from typing import Any

    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field
    from framegen.targets.python.message_view import FieldView

_HANDED_OVER = (
    "Returns once the frame is handed over; `delay` of the result is how many seconds later it is "
    "on the wire."
)
_LASTS = (
    "`lasts` of the result is how many seconds its effect lasts, and its `wait()` returns once "
    "that is over, by calculation."
)
_KNOWN = (
    "Without any, it asks about the `ids` that the client was opened with, and raises ValueError "
    "where there are none."
)
_LATEST = (
    "`latest`: Do not wait for the line, and let a newer command for the same ids replace this "
    "one, as `send_latest` does."
)
_ACKNOWLEDGED = (
    "`started` of the result is True once {} acknowledges it, and False if none comes in time, on "
    "a line that has carried such reports before."
)
_REFUSED = "EncodeError for values that no frame can carry"
_LATE = "NoReplyError if no reply comes in time, and TransportError."
_SPLIT = "longer lists take several requests, one after the other."
_PARTLY = (
    " IncompleteReplyError if the reply leaves something out: it says what, and holds the rest."
)


@dataclass(frozen=True, slots=True)
class Flavour:
    """The style of one of the clients: what precedes a definition, a call and an example.

    `motion` is the result for a message that lasts, `client` the class of the client, and
    `variable` what examples call one.
    """

    define: str
    wait: str
    motion: str
    client: str
    variable: str


@dataclass(frozen=True, slots=True)
class MethodView:
    """One method of a client."""

    exchange: Exchange
    model: Model
    flavour: Flavour

    @property
    def name(self) -> str:
        """The name of the method."""
        return self.exchange.method.name

    @property
    def signature(self) -> str:
        """The declaration."""
        return self._declaration(self._names, self._latest, self.returns)

    def _declaration(self, names: tuple[str, ...], others: list[str], returns: str) -> str:
        given: list[Part] = []
        # What may be left out stands last, in whatever order the spec names it.
        left_out = True
        for argument in map(self._argument, reversed(names)):
            declared = argument.argument
            if self._ids_known and isinstance(declared, str):
                declared = f"{declared} | None = None"
            if isinstance(declared, str):
                left_out = left_out and "=" in declared
                declared = declared if left_out else declared.partition(" =")[0]
            else:
                left_out = False
            given.insert(0, declared)
        before = f"{self.flavour.define}{self.name}("
        keywords = ["*", *others] if others else []
        return Bracketed(before, ["self", *given, *keywords], f") -> {returns}:").fitted(4)

    @property
    def _latest(self) -> list[str]:
        return [] if self.exchange.lasts is None else ["latest: bool = False"]

    @property
    def returns(self) -> str:
        """The type of its result."""
        reply = self.exchange.reply
        if reply is None:
            return self._sent
        result = self._result
        if result is None:
            return reply.name
        shown = self._shown(result, reply)
        return shown.value_type if isinstance(shown, NumberView) else shown.read_as

    @property
    def _sent(self) -> str:
        """The type of what a command returns."""
        if self.exchange.lasts is not None:
            return self.flavour.motion
        return "Sent" if self.exchange.acknowledged is None else "Run"

    @property
    def doc(self) -> list[str]:
        """The docstring: what it does, its arguments with units, its result, and its errors."""
        message = self.exchange.request.message
        found = [message.summary, message.description, *noted(message.notes, self.model.spec)]
        if message.deprecated:
            found.append(f"Deprecated: {message.deprecated}")
        for name in self._names:
            about, *rest = self._argument(name).argument_doc
            found.append(" ".join([f"`{name}`: {about}", *rest]))
        found += [_KNOWN] if self._ids_known else []
        return [*found, *self._returns_and_raises]

    @property
    def _returns_and_raises(self) -> list[str]:
        reply, result = self.exchange.reply, self._result
        if reply is None:
            raises = [_REFUSED, "and TransportError."] if self._names else ["TransportError."]
            return [*self._handed_over, f"Raises {', '.join(raises)}"]
        returned = f"Returns the {reply.name}."
        if result is not None:
            about, *rest = self._shown(result, reply).argument_doc
            returned = " ".join([f"Returns `{result.name}` of the {reply.name}: {about}", *rest])
        lines = [returned]
        if self.exchange.split is not None:
            lines.append(f"A reply has room for {self.exchange.most}: {_SPLIT}")
        partly = any("." in path for _, path in self.exchange.echoed)
        refused = f"{_REFUSED}, " if self._names else ""
        lines.append(f"Raises {refused}{_LATE}{_PARTLY if partly else ''}")
        return lines

    @property
    def _handed_over(self) -> list[str]:
        if self.exchange.lasts is not None:
            return [_LATEST, f"{_HANDED_OVER} {_LASTS}"]
        if self.exchange.acknowledged is not None:
            return [f"{_HANDED_OVER} {_ACKNOWLEDGED.format(self.exchange.acknowledged)}"]
        return [_HANDED_OVER]

    @property
    def example_lines(self) -> list[str]:
        """The first example of the message, as an interactive session."""
        call = f"{self.flavour.wait}{self.flavour.variable}.{self.name}("
        reply = self.exchange.reply
        if reply is None:
            return self._session(f"sent = {call}")
        if isinstance(self._result, Number):
            shown = repr(reply.message.examples[0].values[self._result.name])
            return [*self._session(call), shown]
        return self._session(f"answer = {call}")

    # The same for one device of several, and for all of them, which has no address.

    @property
    def has_address(self) -> bool:
        """Whether it says for which device it is."""
        return self.exchange.address is not None

    @property
    def signature_without_address(self) -> str:
        """The declaration for one device."""
        return self._declaration(self.exchange.method.arguments, self._latest, self.returns)

    @property
    def signature_for_all(self) -> str:
        """The declaration for all devices at once: of a question, whoever answers is heard."""
        names, reply = self.exchange.method.arguments, self.exchange.reply
        if reply is None:
            return self._declaration(names, self._latest, self.returns)
        return self._declaration(names, ["within: float"], f"list[{reply.name}]")

    @property
    def call(self) -> str:
        """The arguments of a call of the method with the address of one device, or of all."""
        names = self.exchange.method.arguments
        latest = ["latest"] if self.exchange.lasts is not None else []
        given = [f"{name}={name}" for name in (*names, *latest)]
        return self._given("return ", f"_bus.{self.name}", [self._address, *given])

    @property
    def _address(self) -> str:
        return f"{self._names[0]}=self.address"

    @property
    def reply_name(self) -> str:
        """The class of the reply; empty where nothing answers."""
        return "" if self.exchange.reply is None else self.exchange.reply.name

    @property
    def gathered(self) -> str:
        """The statement that gathers the replies of all."""
        names = self._names_in_order
        given = [f"{name}={'self.address' if name == names[0] else name}" for name in names]
        made = Bracketed(f"{self.request}(", given, ")")
        call = f"replies = {self.flavour.wait}self._bus.gather("
        return Bracketed(call, [made, "within=within"], ")").fitted(8)

    @property
    def brief(self) -> list[str]:
        """The docstring where all that there is to know is said of the method with an address."""
        return [self.exchange.request.message.summary, f"See `{self.flavour.client}.{self.name}`."]

    @property
    def brief_for_all(self) -> list[str]:
        """The docstring for all devices at once."""
        if self.exchange.reply is None:
            return self.brief
        name = self.exchange.reply.name
        gathers = (
            f"Returns each {name} that comes within `within` seconds; with 0, none is awaited."
        )
        return [*self.brief, gathers]

    @property
    def in_parts(self) -> bool:
        """Whether it may send several requests, whose replies are joined."""
        return self.exchange.split is not None

    @property
    def result(self) -> str:
        """The field of the reply that it returns; empty where it returns the reply or nothing."""
        return self.exchange.method.result

    @property
    def query(self) -> str:
        """The arguments that a question is sent with; empty for a command."""
        reply, split = self.exchange.reply, self.exchange.split
        if reply is None:
            return ""
        if split is not None:
            return self._given(
                "replies = ", "_ask_in_parts", [self.request, reply.name, self._value(split.name)]
            )
        before = "reply = " if self.result else "return "
        return self._given(before, "_ask", [self._made, reply.name])

    @property
    def joined(self) -> str:
        """The expression that joins the replies to several requests."""
        clauses = ["each", "for reply in replies", f"for each in reply.{self.result}"]
        line = " ".join(clauses)
        if len(f"        return tuple({line})") <= WIDTH:
            return line
        margin = "\n            "
        lines = [line] if len(margin) - 1 + len(line) <= WIDTH else clauses
        return f"{margin}{margin.join(lines)}\n        "

    @property
    def sent(self) -> str:
        """The message of a command, as an expression."""
        latest = [] if self.exchange.lasts is None else ["latest=latest"]
        return self._given("return ", self.sender, [self._made, *latest])

    @property
    def sender(self) -> str:
        """The function that sends a command."""
        if self.exchange.lasts is not None:
            return "_move"
        return "send" if self.exchange.acknowledged is None else "_run"

    @property
    def request(self) -> str:
        """The class of the message that it sends."""
        return self.exchange.request.name

    @property
    def _made(self) -> Bracketed:
        given = [f"{name}={self._value(name)}" for name in self._names_in_order]
        return Bracketed(f"{self.request}(", given, ")")

    @property
    def _ids_known(self) -> bool:
        """Whether it asks for positions, of the client's own ids where none are given."""
        pose = self.model.spec.pose
        return pose is not None and pose.read == self.request

    def _value(self, name: str) -> str:
        return f"self._asked({name})" if self._ids_known else name

    def _given(self, before: str, method: str, arguments: list[Part]) -> str:
        """Return the arguments of a call in the body, broken where the line would be too long."""
        call = f"{before}{self.flavour.wait}self.{method}("
        return Bracketed(call, arguments, ")").fitted(8).removeprefix(call).removesuffix(")")

    @property
    def _names(self) -> tuple[str, ...]:
        return self.exchange.arguments

    @property
    def _names_in_order(self) -> list[str]:
        """The arguments in the order of the message, without a running number."""
        names = [field.name for field in self.exchange.request.arguments]
        return [name for name in names if name in self._names]

    @property
    def _result(self) -> Field | None:
        """The field of the reply that it returns."""
        reply, name = self.exchange.reply, self.exchange.method.result
        fields = () if reply is None else reply.arguments
        return next((field for field in fields if field.name == name), None)

    def _argument(self, name: str) -> FieldView:
        return self._shown(self._field(name), self.exchange.request)

    def _field(self, name: str) -> Field:
        fields = self.exchange.request.arguments
        return next(field for field in fields if field.name == name)

    def _shown(self, field: Field, message: MessageLayout) -> FieldView:
        return field_view(field, self.model, message)

    def _session(self, before: str) -> list[str]:
        """Return a call in an interactive session."""
        return session(self.example_call(before), 8)

    def example_call(self, before: str) -> Bracketed:
        """Return a call with the values of an example: the first by place, the others by name."""
        values = self._example_values
        shown = [
            given(self._field(name), values[name], f"{name}=" if at else "")
            for at, name in enumerate(self._names)
        ]
        return Bracketed(before, shown, ")")

    @property
    def _example_values(self) -> dict[str, Any]:
        """The values of the first example, for a device that answers where an answer is shown."""
        examples, address = self.exchange.request.message.examples, self.exchange.address
        if address is None or self.exchange.reply is None:
            return examples[0].values
        silent = self.exchange.silent.values()
        answered = [each.values for each in examples if each.values[address.name] not in silent]
        one = next(each for each in range(address.low, address.high + 1) if each not in silent)
        return answered[0] if answered else {**examples[0].values, address.name: one}
