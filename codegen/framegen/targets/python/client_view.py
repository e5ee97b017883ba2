"""The clients as their templates show them: one method for each message of the client.

Both clients are made of this one description; they differ in `async`, `await` and their base class.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from framegen.model.exchanges import STEPS_PER_SECOND
from framegen.targets.python.escape import Bracketed, Part, Text, literal
from framegen.targets.python.exports import relative_import
from framegen.targets.python.method_view import Flavour, MethodView
from framegen.targets.python.pose_view import PoseView
from framegen.targets.python.spelling import direction_member

if TYPE_CHECKING:
    from framegen.language.values import Range
    from framegen.model.exchanges import Exchange
    from framegen.model.model import Model

_SHARED = (
    "Each method sends one message. What they share is explained at {}: {}, deadlines, reports, "
    "and closing."
)
_LISTENS = "It sends nothing, and listens. How is explained at {}: {}, reports, and closing."

# What a command returns, by module.
_RESULTS = {"motion": ["AsyncMotion", "Motion"], "request": ["Run", "Sent"]}


@dataclass(frozen=True, slots=True)
class ClientView:
    """The clients of the library."""

    model: Model

    FLAVOURS: ClassVar = {
        "Controller": Flavour("def ", "", "Motion"),
        "AsyncController": Flavour("async def ", "await ", "AsyncMotion"),
    }

    @property
    def about(self) -> list[str]:
        """The docstring of the client for threads."""
        return [f"A client for threads: {self._title}", self._shared.format("Client", "threads")]

    @property
    def async_about(self) -> list[str]:
        """The docstring of the client for asyncio."""
        return [
            f"A client for asyncio: {self._title}",
            self._shared.format("AsyncClient", "tasks"),
        ]

    @property
    def _shared(self) -> str:
        return _SHARED if self.model.exchanges else _LISTENS

    @property
    def _title(self) -> str:
        return self.model.spec.protocol.title

    @property
    def methods(self) -> list[MethodView]:
        """The methods of the client for threads."""
        return self._methods(self.FLAVOURS["Controller"])

    @property
    def async_methods(self) -> list[MethodView]:
        """The methods of the client for asyncio."""
        return self._methods(self.FLAVOURS["AsyncController"])

    def _methods(self, flavour: Flavour) -> list[MethodView]:
        return [MethodView(each, self.model, flavour) for each in self.model.exchanges]

    @property
    def pose(self) -> PoseView | None:
        """The pose methods of the client for threads, where there are any."""
        return self._pose(self.FLAVOURS["Controller"])

    @property
    def async_pose(self) -> PoseView | None:
        """The pose methods of the client for asyncio."""
        return self._pose(self.FLAVOURS["AsyncController"])

    def _pose(self, flavour: Flavour) -> PoseView | None:
        pose = self.model.spec.pose
        return None if pose is None else PoseView(pose, self.model, flavour)

    @property
    def limits(self) -> str:
        """The limits of what is sent, as expressions."""
        limited = {
            each.request.name: each.request.limited
            for each in self.model.exchanges
            if each.request.limited
        }
        if not limited:
            return "LIMITS = Limits()"
        limits = next(each for fields in limited.values() for each in fields.values())
        others = [Text(name, after=f": {_bounds(each)}") for name, each in limits.others.items()]
        fields = [
            Bracketed(f"{name}: (", [literal(path) for path in paths], ")", lone=",")
            for name, paths in limited.items()
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
    def received(self) -> str:
        """The direction to the client, as a member of the enumeration."""
        return direction_member(self.model.roles.received)

    @property
    def import_messages(self) -> str:
        """The messages of the exchanges."""
        names = {each.request.name for each in self.model.exchanges}
        names |= {each.reply.name for each in self.model.exchanges if each.reply is not None}
        for each in self.model.exchanges:
            names |= set(each.reports)
        return relative_import(".messages", names)

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
        modules: dict[str, set[str]] = {".messages": self._messages, base_module: {base}}
        modules |= {module: returned.intersection(names) for module, names in _RESULTS.items()}
        if self.pose is not None:
            modules |= {"exchanges": {"POSE"}, "pose": {"HOLD_MS"}}
        return [
            relative_import(module, names) for module, names in sorted(modules.items()) if names
        ]

    @property
    def _messages(self) -> set[str]:
        """The messages and elements that the methods make, expect and return."""
        names = {each.request.name for each in self.model.exchanges}
        names |= {each.reply.name for each in self.model.exchanges if each.reply is not None}
        shown = " ".join(method.returns for method in self.methods)
        lists = [each.items for each in self.model.messages.values()]
        elements = {each.element for each in lists if each is not None and each.element is not None}
        names |= {each for each in elements if f"tuple[{each}, ...]" in shown}
        return names | ({self.pose.element} if self.pose else set())

    @property
    def iterables(self) -> bool:
        """Whether a method takes a list."""
        return self.pose is not None or any(
            "Iterable[" in method.signature for method in self.methods
        )


def _bounds(range_: Range) -> str:
    """Return a pair of numbers as Python code."""
    return f"({range_.low}, {range_.high})"


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
    if each.echoed:
        pairs = [Bracketed("(", list(map(literal, pair)), ")") for pair in each.echoed]
        items.append(Bracketed("echoed=(", pairs, ")", lone=","))
    if each.most:
        items.append(f"most={each.most}")
    return Bracketed(f"{each.request.name}: Exchange(", items, "),").fitted(4)
