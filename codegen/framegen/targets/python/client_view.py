"""What the templates of the two clients show: one method for each message of the host.

Both clients are made of this one description; they differ in `async`, `await` and their base class.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from framegen.exchanges import exchanges, sent_by_client
from framegen.layout import Repeat, WireField
from framegen.targets.python.escape import WIDTH, Bracketed, literal
from framegen.targets.python.view import LAZY, ListView, NumberView, direction_member

if TYPE_CHECKING:
    from typing import Any

    from framegen.exchanges import Exchange
    from framegen.layout import Layout

_HANDED_OVER = (
    "Returns once the frame is handed over; `delay` of the result is in how many seconds it will "
    "be on the wire."
)
_REFUSED = "Raises EncodeError for what no frame can carry"
_LATE = "NoReplyError where no reply comes in time, and TransportError."
_SPLIT = "more are asked for in several requests, one after the other."
_PARTLY = (
    " IncompleteReplyError where the reply leaves something out: it says what, and keeps the rest."
)
_SHARED = (
    "Each method sends one message. What they share is explained at {}: {}, deadlines, reports, "
    "and closing."
)


@dataclass(frozen=True, slots=True)
class Flavour:
    """How one of the clients is written: what stands before a definition, a call and an example."""

    define: str
    wait: str


@dataclass(frozen=True, slots=True)
class MethodView:
    """One method of a client."""

    exchange: Exchange
    layout: Layout
    flavour: Flavour

    @property
    def name(self) -> str:
        """How it is called."""
        return self.exchange.method.name

    @property
    def signature(self) -> str:
        """Its declaration."""
        given = [f"{name}: {self._type(self._argument(name))}" for name in self._names]
        before = f"{self.flavour.define}{self.name}("
        return Bracketed(before, ["self", *given], f") -> {self.returns}:").fitted(4)

    @property
    def returns(self) -> str:
        """The type of its result."""
        reply = self.exchange.reply
        if reply is None:
            return "Sent"
        result = self._result
        if result is None:
            return reply.name
        return "int" if isinstance(result, WireField) else self._list(result).read_as

    @property
    def doc(self) -> list[str]:
        """What it does; its arguments with their units; what it returns, and what it raises."""
        message = self.exchange.request.message
        found = [message.summary, message.description]
        if message.deprecated:
            found.append(f"Deprecated: {message.deprecated}")
        for name in self._names:
            about, *rest = self._argument(name).doc
            found.append(" ".join([f"`{name}`: {about}", *rest]))
        return [*found, *self._outcome]

    @property
    def _outcome(self) -> list[str]:
        reply, result = self.exchange.reply, self._result
        if reply is None:
            return [_HANDED_OVER, f"{_REFUSED}, and TransportError."]
        told = f"Returns the {reply.name}."
        if result is not None:
            about, *rest = self._shown(result).doc
            told = " ".join([f"Returns `{result.name}` of the {reply.name}: {about}", *rest])
        lines = [told]
        if self.exchange.split is not None:
            lines.append(f"A reply has room for {self.exchange.most}: {_SPLIT}")
        partly = any("." in path for _, path in self.exchange.echoed)
        lines.append(f"{_REFUSED}, {_LATE}{_PARTLY if partly else ''}")
        return lines

    @property
    def example_lines(self) -> list[str]:
        """The first example of the message, as an interactive session."""
        examples = self.exchange.request.message.examples
        if not examples:
            return []
        values = examples[0].values
        call = f"{self.flavour.wait}controller.{self.name}({self._example(values)})"
        reply = self.exchange.reply
        if reply is None:
            return [f">>> sent = {call}"]
        if isinstance(self._result, WireField) and reply.message.examples:
            return [f">>> {call}", str(reply.message.examples[0].values[self._result.name])]
        return [f">>> answer = {call}"]

    @property
    def body(self) -> str:
        """What it does, as statements."""
        name, reply = self.exchange.request.name, self.exchange.reply
        given = [f"{field.name}={field.name}" for field in self.exchange.request.arguments]
        wait = self.flavour.wait
        if reply is None:
            return Bracketed(
                f"return {wait}self.send(", [Bracketed(f"{name}(", given, ")")], ")"
            ).fitted(8)
        if self.exchange.split is not None:
            asked = [name, reply.name, self.exchange.split.name]
            replies = Bracketed(f"replies = {wait}self._ask_in_parts(", asked, ")").fitted(8)
            field = self.exchange.method.result
            return (
                f"{replies}\n"
                f"        return tuple(each for reply in replies for each in reply.{field})"
            )
        call = [f"{name}({', '.join(given)})", reply.name]
        if self._result is None:
            return Bracketed(f"return {wait}self._ask(", call, ")").fitted(8)
        return (
            Bracketed(f"reply = {wait}self._ask(", call, ")").fitted(8)
            + f"\n        return reply.{self._result.name}"
        )

    @property
    def _names(self) -> tuple[str, ...]:
        return self.exchange.method.arguments

    @property
    def _result(self) -> WireField | Repeat | None:
        """The field of the reply that it returns."""
        reply, name = self.exchange.reply, self.exchange.method.result
        fields = () if reply is None else reply.arguments
        return next((field for field in fields if field.name == name), None)

    def _argument(self, name: str) -> NumberView | ListView:
        fields = self.exchange.request.arguments
        return self._shown(next(field for field in fields if field.name == name))

    def _shown(self, field: WireField | Repeat) -> NumberView | ListView:
        return self._list(field) if isinstance(field, Repeat) else self._number(field)

    def _list(self, field: Repeat) -> ListView:
        return ListView(field, self.layout.spec)

    def _number(self, field: WireField) -> NumberView:
        return NumberView(field, self.layout.spec)

    def _type(self, argument: NumberView | ListView) -> str:
        return argument.given_as if isinstance(argument, ListView) else "int"

    def _example(self, values: dict[str, Any]) -> str:
        """The arguments of an example: the first by place, the others by name."""
        shown: list[str] = []
        for at, name in enumerate(self._names):
            value = values[name]
            argument = self._argument(name)
            if isinstance(argument, ListView) and argument.element is not None:
                names = [field.name for field in argument.fields]
                items = [", ".join(str(item[each]) for each in names) for item in value]
                value = f"[{', '.join(f'({item})' for item in items)}]"
            shown.append(f"{name}={value}" if at else f"{value}")
        return ", ".join(shown)


@dataclass(frozen=True, slots=True)
class ClientView:
    """The clients of the library."""

    layout: Layout

    FLAVOURS: ClassVar = {
        "Controller": Flavour("def ", ""),
        "AsyncController": Flavour("async def ", "await "),
    }

    @property
    def about(self) -> list[str]:
        """The docstring of the client for threads."""
        return [
            f"A client for threads: {self._title}.",
            _SHARED.format("Client", "threads"),
        ]

    @property
    def async_about(self) -> list[str]:
        """The docstring of the client for asyncio."""
        return [
            f"A client for asyncio: {self._title}.",
            _SHARED.format("AsyncClient", "tasks"),
        ]

    @property
    def _title(self) -> str:
        return self.layout.spec.protocol.title

    @property
    def methods(self) -> list[MethodView]:
        """The methods of the client for threads."""
        return self._methods(self.FLAVOURS["Controller"])

    @property
    def async_methods(self) -> list[MethodView]:
        """The methods of the client for asyncio."""
        return self._methods(self.FLAVOURS["AsyncController"])

    def _methods(self, flavour: Flavour) -> list[MethodView]:
        return [MethodView(each, self.layout, flavour) for each in exchanges(self.layout)]

    @property
    def entries(self) -> list[str]:
        """What comes back for each message, as the entries of a dict."""
        return [_entry(each) for each in exchanges(self.layout)]

    @property
    def hears(self) -> bool:
        """Whether anything comes to the client."""
        return sent_by_client(self.layout.spec).reversed in self.layout.directions

    @property
    def received(self) -> str:
        """The direction of what comes to the client; None, for either, where nothing does."""
        back = sent_by_client(self.layout.spec).reversed
        return f"Direction.{direction_member(back)}" if self.hears else "None"

    @property
    def import_messages(self) -> str:
        """The messages that exchanges are about."""
        names = {each.request.name for each in exchanges(self.layout)}
        names |= {each.reply.name for each in exchanges(self.layout) if each.reply is not None}
        for each in exchanges(self.layout):
            names |= set(each.reports)
        return _import("messages", sorted(names), 0)

    @property
    def import_requests(self) -> str:
        """The classes that the methods make and expect."""
        names = {each.request.name for each in exchanges(self.layout)}
        names |= {each.reply.name for each in exchanges(self.layout) if each.reply is not None}
        return _import("messages", sorted(names), 0)

    @property
    def import_elements(self) -> str:
        """The classes of elements that the methods return; empty where they return none."""
        shown = " ".join(method.returns for method in self.methods)
        lists = [each.repeat for each in self.layout.messages.values()]
        elements = {each.element for each in lists if each is not None and each.element is not None}
        names = sorted(each for each in elements if f"tuple[{each}, ...]" in shown)
        return _import("messages", names, 4) if names else ""

    @property
    def iterables(self) -> bool:
        """Whether a method takes a list."""
        return any("Iterable[" in method.signature for method in self.methods)

    @property
    def commands(self) -> bool:
        """Whether a method only sends."""
        return any(method.returns == "Sent" for method in self.methods)

    @property
    def lazy_entries(self) -> list[str]:
        """The names imported when they are asked for, and their modules."""
        return [f"{literal(name)}: {literal(module)}," for name, module in LAZY.items()]

    @property
    def lazy_imports(self) -> list[str]:
        """The imports of all of those, for type checkers."""
        modules: dict[str, list[str]] = {}
        for name, module in LAZY.items():
            modules.setdefault(module, []).append(name)
        return [_import(module, names, 4) for module, names in sorted(modules.items())]


def _entry(each: Exchange) -> str:
    arguments = ", ".join(literal(name) for name in each.method.arguments)
    items: list[str | Bracketed] = [
        literal(each.method.name),
        f"({arguments}{',' if len(each.method.arguments) == 1 else ''})",
    ]
    if each.reply is not None:
        items.append(f"reply={each.reply.name}")
    if each.method.result:
        items.append(f"result={literal(each.method.result)}")
    if each.reports:
        items.append(Bracketed("reports=(", list(each.reports), ")", lone=","))
    if each.echoed:
        pairs = [f"({literal(one)}, {literal(other)})" for one, other in each.echoed]
        items.append(Bracketed("echoed=(", pairs, ")", lone=","))
    if each.most:
        items.append(f"most={each.most}")
    return Bracketed(f"{each.request.name}: Exchange(", items, "),").fitted(4)


def _import(module: str, names: list[str], indent: int) -> str:
    """An import, indented but for its first line, an item a line where it needs to."""
    line = f"from .{module} import {', '.join(names)}"
    if indent + len(line) <= WIDTH:
        return line
    margin = " " * indent
    listed = "".join(f"{margin}    {name},\n" for name in names)
    return f"from .{module} import (\n{listed}{margin})"
