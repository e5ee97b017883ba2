"""The clients as their templates show them: one method for each message of the client.

Both clients are made of this one description; they differ in `async`, `await` and their base class.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeVar

from framegen.language.class_names import DEFAULT_CLIENT
from framegen.model.client_names import client_names
from framegen.model.exchanges import STEPS_PER_SECOND
from framegen.model.slots import Items
from framegen.targets.python.bus_view import BusView
from framegen.targets.python.errors_view import ErrorsView
from framegen.targets.python.escape import Bracketed, Part, Text, literal
from framegen.targets.python.exports import import_from
from framegen.targets.python.method_view import Flavour, MethodView
from framegen.targets.python.notes import noted
from framegen.targets.python.pose_view import PoseView
from framegen.targets.python.spelling import direction_member

if TYPE_CHECKING:
    from framegen.language.values import Range
    from framegen.model.client_names import ClientNames
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

_View = TypeVar("_View", BusView, ErrorsView)

_SHARED = (
    "Each method sends one message. What they share is explained at {}: {}, deadlines, reports, "
    "and closing."
)
_LISTENS = "It sends nothing, and listens. How is explained at {}: {}, reports, and closing."

# What a command returns, by module.
_RESULTS = {
    "framewire.client.motion": ["AsyncMotion", "Motion"],
    "framewire.client.request": ["Run", "Sent"],
}


@dataclass(frozen=True, slots=True)
class ClientView:
    """The clients of the library."""

    model: Model

    @property
    def names(self) -> ClientNames:
        """What the clients and their functions are called."""
        return client_names(self.model.spec)

    @property
    def is_named(self) -> bool:
        """Whether the spec has a name of its own for them."""
        return self.names.threads != DEFAULT_CLIENT

    @property
    def _flavour(self) -> Flavour:
        return Flavour("def ", "", "Motion", self.names.threads, self.names.variable)

    @property
    def _async_flavour(self) -> Flavour:
        names = self.names
        return Flavour("async def ", "await ", "AsyncMotion", names.asyncio, names.variable)

    @property
    def about(self) -> list[str]:
        """The docstring of the client for threads."""
        shared = self._shared.format("Client", "threads")
        return [f"A client for threads: {self._title}", shared, *self._about_devices]

    @property
    def _about_devices(self) -> list[str]:
        if self.bus is None:
            return []
        field = self.bus.field
        one = f"`{field}` says which device a message is for: `device({field})` has the methods "
        everyone = ", and `broadcast` those that go to all at once" if self.silent else ""
        return [f"{one}without it{everyone}."]

    @property
    def async_about(self) -> list[str]:
        """The docstring of the client for asyncio."""
        return [
            f"A client for asyncio: {self._title}",
            self._shared.format("AsyncClient", "tasks"),
            *self._about_devices,
            *self._about_the_other_end,
        ]

    @property
    def _about_the_other_end(self) -> list[str]:
        """What is known of who receives what it sends."""
        spec = self.model.spec
        return noted(spec.endpoints[self.model.roles.sent.receiver].notes, spec)

    @property
    def _shared(self) -> str:
        return _SHARED if self.model.exchanges else _LISTENS

    @property
    def _title(self) -> str:
        return self.model.spec.protocol.title

    @property
    def methods(self) -> list[MethodView]:
        """The methods of the client for threads."""
        return self._methods(self._flavour)

    @property
    def async_methods(self) -> list[MethodView]:
        """The methods of the client for asyncio."""
        return self._methods(self._async_flavour)

    def _methods(self, flavour: Flavour) -> list[MethodView]:
        return [MethodView(each, self.model, flavour) for each in self.model.exchanges]

    def method(self, request: str) -> MethodView | None:
        """Return the method of the client for threads that sends a message, if one does."""
        exchange = self.model.exchanges_by_request.get(request)
        return None if exchange is None else MethodView(exchange, self.model, self._flavour)

    @property
    def pose(self) -> PoseView | None:
        """The pose methods of the client for threads, where there are any."""
        return self._pose(self._flavour)

    @property
    def async_pose(self) -> PoseView | None:
        """The pose methods of the client for asyncio."""
        return self._pose(self._async_flavour)

    def _pose(self, flavour: Flavour) -> PoseView | None:
        pose = self.model.spec.pose
        return None if pose is None else PoseView(pose, self.model, flavour)

    @property
    def limits(self) -> str:
        """The limits of what is sent, as expressions."""
        limits = self.model.limits
        if limits is None:
            return "LIMITS = Limits()"
        others = [Text(name, after=f": {_bounds(each)}") for name, each in limits.others.items()]
        fields = [
            Bracketed(f"{name}: (", [literal(path) for path in paths], ")", lone=",")
            for name, paths in limits.fields.items()
        ]
        items: list[Part] = [_bounds(limits.usual)]
        items += [Bracketed("others={", others, "}")] if others else []
        items.append(Bracketed("fields={", fields, "}"))
        pose = self.model.spec.pose
        items += [] if pose is None else [f"targets={literal(pose.targets)}"]
        return Bracketed("LIMITS = Limits(", items, ")").fitted(0)

    @property
    def entries(self) -> list[str]:
        """The exchanges, as the entries of a dict."""
        return [_entry(each) for each in self.model.exchanges]

    @property
    def constants(self) -> list[str]:
        """What several exchanges share: how addresses are told, and how errors are."""
        buses = {view.name: view.made for view in self._views(BusView)}
        errors = {view.name: view.made for view in self._views(ErrorsView)}
        return [*buses.values(), *errors.values()]

    @property
    def import_shared(self) -> list[str]:
        """The imports of their classes."""
        return [
            *(["from framewire.client.address import Address"] if self.bus else []),
            *(["from framewire.client.counted import Counted"] if self.counting else []),
            "from framewire.client.exchange import Exchange",
            *(["from framewire.client.failures import Failures"] if self.failing else []),
        ]

    @property
    def counting(self) -> bool:
        """Whether a reply holds as many items as a request asks for."""
        return any(each.counted for each in self.model.exchanges)

    @property
    def failing(self) -> bool:
        """Whether the device says that it refuses, or fails."""
        return bool(self._views(ErrorsView))

    def _views(self, kind: type[_View]) -> list[_View]:
        return [view for view in map(kind, self.model.exchanges) if view.name]

    @property
    def bus(self) -> BusView | None:
        """How one device of several is told from others, where there are any."""
        return next(iter(self._views(BusView)), None)

    @property
    def received(self) -> str:
        """The direction to the client, as a member of the enumeration."""
        return direction_member(self.model.roles.received)

    @property
    def import_messages(self) -> str:
        """The messages of the exchanges."""
        names = {each.request.name for each in self.model.exchanges}
        for each in self.model.exchanges:
            names |= {*each.reports, *(answer.name for answer in each.answers)}
        return import_from(".messages", names)

    @property
    def imports(self) -> list[str]:
        """The imports of the client for threads."""
        return self._imports("client", "Client", self.methods)

    @property
    def async_imports(self) -> list[str]:
        """The imports of the client for asyncio."""
        return self._imports("async_client", "AsyncClient", self.async_methods)

    def _imports(self, base_module: str, base: str, methods: list[MethodView]) -> list[str]:
        returned = {method.returns for method in methods}
        modules: dict[str, set[str]] = {
            "._library": {"LIBRARY"},
            ".messages": self._messages,
            f"framewire.client.{base_module}": {base},
        }
        modules |= {module: returned.intersection(names) for module, names in _RESULTS.items()}
        if self.pose is not None:
            modules |= {"._exchanges": {"POSE"}, "framewire.client.pose": {"HOLD_MS"}}
        if self.bus is not None:
            prefix = base.removesuffix("Client")
            module = f"._{prefix.lower()}_devices" if prefix else "._devices"
            modules[module] = {f"{prefix}{each}" for each in self._device_classes}
            modules |= {"framewire.frame.message": {"Message"}} if self.silent else {}
        return [import_from(module, names) for module, names in sorted(modules.items()) if names]

    @property
    def silent(self) -> dict[str, int]:
        """The addresses that nobody answers, by name."""
        found: dict[str, int] = {}
        for each in self._views(BusView):
            found |= each.silent
        return found

    @property
    def broadcast_address(self) -> str:
        """The only one of them; empty where there are several."""
        only = [*self.silent.values()]
        return str(only[0]) if len(only) == 1 else ""

    @property
    def silent_values(self) -> str:
        """The same as a dict, in the code of a method."""
        pairs = [f"{literal(name)}: {value}" for name, value in self.silent.items()]
        return Bracketed("addresses = {", pairs, "}").fitted(8)

    @property
    def silent_names(self) -> str:
        """The type of their names, where there are several."""
        if len(self.silent) < 2:
            return ""
        return f"Literal[{', '.join(map(literal, self.silent))}]"

    @property
    def _device_classes(self) -> list[str]:
        return ["OneDevice", *(["AllDevices"] if self.silent else [])]

    @property
    def device_imports(self) -> list[str]:
        """The imports of the clients of one device and of all."""
        return self._device_imports("._controller", self.names.threads, self.methods)

    @property
    def async_device_imports(self) -> list[str]:
        """The same for asyncio."""
        return self._device_imports("._async_controller", self.names.asyncio, self.async_methods)

    def _device_imports(self, module: str, client: str, methods: list[MethodView]) -> list[str]:
        addressed = [method for method in methods if method.has_address]
        shown = " ".join(f"{method.returns} {method.signature}" for method in addressed)
        names = set(re.findall(r"\w+", shown)).intersection(self._messages) - self._gathered
        returned = {method.returns for method in addressed}
        modules: dict[str, set[str]] = {".messages": names, module: {client}}
        modules |= {each: returned.intersection(results) for each, results in _RESULTS.items()}
        return [import_from(each, found, 4) for each, found in sorted(modules.items()) if found]

    @property
    def import_gathered(self) -> str:
        """The import of the questions that are put to all, and of what answers them."""
        return import_from(".messages", self._gathered) if self._gathered else ""

    @property
    def _gathered(self) -> set[str]:
        if not self.silent:
            return set()
        asked = [each for each in self.methods if each.has_address and each.reply_name]
        return {name for each in asked for name in (each.request, each.reply_name)}

    @property
    def _messages(self) -> set[str]:
        """The messages and elements that the methods make, expect and return."""
        names = {each.request.name for each in self.model.exchanges}
        names |= {each.reply.name for each in self.model.exchanges if each.reply is not None}
        shown = " ".join(method.returns for method in self.methods)
        fields = [field for each in self.model.messages.values() for field in each.fields]
        elements = {each.element for each in fields if isinstance(each, Items) and each.element}
        names |= {each for each in elements if f"tuple[{each}, ...]" in shown}
        return names | ({self.pose.element} if self.pose else set())

    @property
    def lists_taken(self) -> str:
        """The types that methods take lists as, to be imported; empty where none does."""
        return ", ".join(sorted(self._lists_taken))

    @property
    def _lists_taken(self) -> set[str]:
        declared = " ".join(method.signature for method in self.methods)
        needed = {"Iterable"} if self.pose is not None else set()
        return needed | {name for name in ("Iterable", "Mapping") if f"{name}[" in declared}


def _bounds(range_: Range) -> str:
    """Return a pair of numbers as Python code."""
    return f"({range_.low}, {range_.high})"


def counted(each: Exchange) -> str:
    """Return what compares the length of a reply with what was asked for, as Python code."""
    failure = each.failure
    told = [] if failure is None else [f"failure={literal(failure.name)}"]
    told += [f"good={each.good}"] if failure is not None and each.good else []
    reply = "" if each.reply is None else each.reply.name
    return f"Counted({', '.join([literal(each.asks_for), reply, *told])})"


def _entry(each: Exchange) -> str:
    arguments = [literal(name) for name in each.method.arguments]
    items: list[Part] = [
        literal(each.method.name),
        Bracketed("(", arguments, ")", lone=","),
    ]
    if each.reply is not None:
        items.append(f"reply={each.reply.name}")
    if each.method.result:
        items.append(f"result={literal(each.method.result)}")
    if each.reports:
        items.append(Bracketed("reports=(", list(each.reports), ")", lone=","))
    if each.acknowledged is not None:
        items.append(f"acknowledged={each.acknowledged}")
    if each.lasts is not None:
        steps = STEPS_PER_SECOND[each.lasts.field.unit]
        items.append(Bracketed("lasts=(", [literal(each.lasts.name), str(steps)], ")"))
    for view, key in ((BusView(each), "address"), (ErrorsView(each), "failures")):
        items += [f"{key}={view.name}"] if view.name else []
    if each.counter is not None:
        size = str(each.counter.high + 1)
        items.append(Bracketed("counter=(", [literal(each.counter.name), size], ")"))
    if each.echoed:
        pairs = [Bracketed("(", list(map(literal, pair)), ")") for pair in each.echoed]
        items.append(Bracketed("echoed=(", pairs, ")", lone=","))
    items += [f"counted={counted(each)}"] if each.counted else []
    return Bracketed(f"{each.request.name}: Exchange(", items, "),").fitted(4)
