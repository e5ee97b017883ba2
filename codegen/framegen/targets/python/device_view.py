"""The device's end as its template shows it: handlers, and the messages that it sends."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.exchanges import snake_case
from framegen.targets.python.client_view import counted
from framegen.targets.python.escape import Bracketed, literal
from framegen.targets.python.exports import import_from
from framegen.targets.python.spelling import direction_member
from framegen.targets.python.union_view import type_alias

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class HandlerView:
    """The handler of one message that the device receives."""

    layout: MessageLayout

    @property
    def message(self) -> str:
        """The message class that it handles."""
        return self.layout.name

    @property
    def name(self) -> str:
        """The name: `on_servo_move` for ServoMove."""
        return f"on_{snake_case(self.layout.name)}"

    @property
    def signature(self) -> str:
        """The declaration, with a reply where the spec names one."""
        returns = " | ".join([*self._answers, "None"])
        given = ["self", f"message: {self.message}"]
        return Bracketed(f"def {self.name}(", given, f") -> {returns}:").fitted(4)

    @property
    def _answers(self) -> list[str]:
        message = self.layout.message
        return [each for each in (message.reply, message.refusal) if each is not None]

    @property
    def doc(self) -> list[str]:
        """The docstring: the request, what may be returned, and what may be sent later."""
        message = self.layout.message
        found = [message.summary]
        if message.reply:
            refusing = f", the {message.refusal} to refuse," if message.refusal else ","
            found.append(
                f"Return the {message.reply} as the reply{refusing} or None to stay silent."
            )
        if message.reports:
            found.append(f"`send` may follow with: {', '.join(message.reports)}.")
        return found


@dataclass(frozen=True, slots=True)
class DeviceView:
    """The device's end of the line."""

    model: Model

    @property
    def incoming(self) -> Direction:
        """The direction of what it receives."""
        return self.model.roles.sent

    @property
    def direction(self) -> str:
        """That direction as a member of the enumeration."""
        return direction_member(self.incoming)

    @property
    def name(self) -> str:
        """The name of this end."""
        return self.model.roles.device

    @property
    def about(self) -> list[str]:
        """The docstring of the class."""
        roles = self.model.roles
        use = (
            f"`receive` takes bytes of the {roles.client}, and returns the bytes to send back. "
            "A handler that is not overridden does nothing and answers nothing. "
            "Rejected input is counted in `rejects`, by reason."
        )
        what = f"The {roles.device}'s end of the line: override a handler to say what it does."
        return [what, use, *self._about_addresses]

    @property
    def _about_addresses(self) -> list[str]:
        if not self.addresses:
            return []
        mine = "It takes only what is for one of the `addresses` that it is made with"
        found = [f"{mine}, or for any where there are none."]
        if self.silent:
            silent = ", ".join(f"{value} ({name})" for name, value in self.silent.items())
            found.append(
                f"What goes to {silent} is for every device: its handler is called, and what that "
                "returns is not sent, since nobody answers there. A handler that does answer calls "
                "`send`."
            )
        return found

    @property
    def addresses(self) -> list[str]:
        """The names of the addresses in what it receives."""
        frames = (message.frame.address for message in self.model.sent(self.incoming))
        return list(dict.fromkeys(each.name for each in frames if each is not None))

    @property
    def silent(self) -> dict[str, int]:
        """The addresses that nobody answers, by name."""
        found: dict[str, int] = {}
        for each in self.model.exchanges:
            found |= each.silent
        return found

    @property
    def address_names(self) -> str:
        """The assignment of the names of the addresses."""
        names = [literal(name) for name in self.addresses]
        return Bracketed("_addresses = (", names, ")", lone=",").fitted(4)

    @property
    def silent_addresses(self) -> str:
        """The assignment of the addresses that nobody answers."""
        values = [str(value) for value in self.silent.values()]
        return Bracketed("_silent = frozenset([", values, "])").fitted(4)

    @property
    def counted(self) -> str:
        """What compares replies with what was asked for, by request; empty where nothing does."""
        rows = [
            Bracketed("(", [each.request.name, counted(each)], ")")
            for each in self.model.exchanges
            if each.counted
        ]
        return Bracketed("_counted = (", rows, ")", lone=",").fitted(4) if rows else ""

    @property
    def handlers(self) -> list[HandlerView]:
        """A handler for each message that it receives."""
        return [HandlerView(message) for message in self.model.sent(self.incoming)]

    @property
    def handler_table(self) -> str:
        """The name of the handler of each message."""
        rows = [f"({each.message}, {literal(each.name)})" for each in self.handlers]
        return Bracketed("_handlers = (", rows, ")", lone=",").fitted(4)

    @property
    def reports(self) -> list[str]:
        """The names of the messages that it sends."""
        return sorted(message.name for message in self.model.sent(self.incoming.reversed))

    @property
    def import_messages(self) -> str:
        """The import of what it receives and sends; empty where nothing goes either way."""
        names = [*self.reports, *(handler.message for handler in self.handlers)]
        return import_from(".messages", names) if names else ""

    @property
    def report_type(self) -> str:
        """The type of anything that it sends."""
        return type_alias("Report", self.reports or ["Message"])
