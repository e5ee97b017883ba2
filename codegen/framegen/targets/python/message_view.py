"""A message as the templates show it: its class, its strategy, its examples."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Constant, Items, Number
from framegen.pluralize import describe_range
from framegen.targets.python.escape import Bracketed, Part, Sum, byte_literal, literal, session
from framegen.targets.python.list_view import ListView, given
from framegen.targets.python.names import strategy_name
from framegen.targets.python.number_view import AbsentView, NumberView, absent_view
from framegen.targets.python.spelling import direction_member, range_expression, struct_order

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Example
    from framegen.language.values import Citation
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


_WORD = re.compile(r"\w+")
# So many bytes of a frame have room in a line of an example.
_SHOWN = 31


@dataclass(frozen=True, slots=True)
class MessageView:
    """One message class."""

    layout: MessageLayout
    model: Model

    @property
    def name(self) -> str:
        return self.layout.name

    @property
    def doc(self) -> list[str]:
        """The summary, and a paragraph for each further fact."""
        message, frame, formula = self.layout.message, self.layout.frame, self.layout.formula
        found = [message.summary, message.description]
        if message.deprecated:
            found.append(f"Deprecated: {message.deprecated}")
        if message.reply and message.reply not in _WORD.findall(message.description):
            found.append(f"Answered by {message.reply}.")
        identity = f"{frame.id.name.capitalize()} {self.layout.id} (0x{self.layout.id:02X})"
        lengths = f"{frame.length.name} {formula}"
        if formula.factor:
            lengths += f": {describe_range(self.layout.lengths)}"
        sender, receiver = self.layout.direction.sender, self.layout.direction.receiver
        source = f"Source: {self.cited(message.cite)}."
        found.append(f"{identity}, {sender} to {receiver}, {lengths}. {source}")
        return found

    def cited(self, cite: Citation) -> str:
        title = self.model.spec.sources[cite.source].title
        return f"{title}, {cite.place}" if cite.place else title

    @property
    def vendor_name(self) -> str:
        return self.layout.message.vendor_name

    @property
    def deprecated(self) -> str:
        return self.layout.message.deprecated

    @property
    def command(self) -> int:
        return self.layout.id

    @property
    def direction(self) -> str:
        return direction_member(self.layout.direction)

    @property
    def lengths(self) -> str:
        """The legal lengths, as a range expression."""
        return range_expression(self.layout.lengths)

    @property
    def fields(self) -> list[NumberView | ListView]:
        """The fields in the order of the frame, the count among them."""
        return [self._view(slot) for slot in self.layout.fields]

    @property
    def arguments(self) -> list[NumberView | ListView]:
        """The fields that a user gives."""
        return [self._view(slot) for slot in self.layout.arguments]

    def _view(self, slot: Number | Items) -> NumberView | ListView:
        spec = self.model.spec
        return ListView(slot, spec) if isinstance(slot, Items) else NumberView(slot, spec)

    @property
    def numbers(self) -> list[NumberView]:
        """The numbers that a user gives."""
        return [each for each in self.arguments if isinstance(each, NumberView)]

    @property
    def items(self) -> ListView | None:
        """The list, where it has one."""
        items = self.layout.items
        return None if items is None else ListView(items, self.model.spec)

    @property
    def absent(self) -> AbsentView | None:
        """The property that tells whether there is nothing to report, where there is one."""
        return absent_view(self.numbers)

    @property
    def match_args(self) -> str:
        names = [literal(each.name) for each in self.arguments]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        """The declaration of the constructor."""
        given = [
            each.argument if isinstance(each, ListView) else f"{each.name}: int"
            for each in self.arguments
        ]
        return Bracketed("def __new__(", ["cls", *given], ") -> typing.Self:").fitted(4)

    @property
    def packing(self) -> str:
        """The arguments of the call that packs its frame: format, head and fields."""
        head = [self._in_front(slot) for slot in self.layout.frame.head]
        fields = [slot.name for slot in self.layout.fields if isinstance(slot, Number)]
        items: list[Part] = [
            Sum(self._notation),
            Bracketed("(", head, ")", lone=","),
            Bracketed("(", fields, ")", lone=","),
            *([] if self.layout.items is None else ["flat"]),
        ]
        call = "return cls._packed("
        return Bracketed(call, items, ")").fitted(8).removeprefix(call).removesuffix(")")

    @property
    def _notation(self) -> list[str]:
        """The format of its slots for `struct`; those of the list once for each element."""
        fixed, listed = struct_order(self.model.spec.byte_order), []
        for slot in self.layout.slots:
            if isinstance(slot, Constant):
                fixed += f"{slot.size}s"
            elif isinstance(slot, Number):
                fixed += slot.number_type.code
            else:
                codes = "".join(field.number_type.code for field in slot.fields)
                listed = [f"{slot.counter.name} * {literal(codes)}"]
        return [literal(fixed), *listed]

    def _in_front(self, slot: Constant | Number) -> str:
        """Return the packed expression for a slot of the envelope."""
        if isinstance(slot, Constant):
            return "HEADER" if slot.data == self.layout.frame.header else byte_literal(slot.data)
        return str(self.layout.formula) if slot.role == "length" else str(self.layout.id)

    @property
    def example(self) -> Example:
        """The shortest example, for the docstring."""
        return min(self.layout.message.examples, key=lambda example: len(example.hex))

    @property
    def example_lines(self) -> list[str]:
        """That example as an interactive session."""
        given_values = self.given_values(self.example.values)
        frame = self.example.hex
        cut = "" if len(frame) <= _SHOWN else f"[:{_SHOWN}]"
        call = Bracketed(f"{self.name}(", given_values, f").encode(){cut}.hex(' ')")
        return [*session(call, 4), f"'{frame[:_SHOWN].hex(' ')}'"]

    def given_values(self, values: dict[str, Any]) -> list[Part]:
        """Return the arguments that make the message of an example."""
        return [given(each, values[each.name], f"{each.name}=") for each in self.layout.arguments]

    def command_words(self, values: dict[str, Any]) -> list[str]:
        """Return the fields of an example as the command accepts them: `targets=1:800,9:800`."""
        words: list[str] = []
        for argument in self.layout.arguments:
            value = values[argument.name]
            if isinstance(argument, Items):
                names = [field.name for field in argument.fields]
                parts = [
                    [str(item)] if argument.element is None else [str(item[name]) for name in names]
                    for item in value
                ]
                value = ",".join(":".join(part) for part in parts)
            words.append(f"{argument.name}={value}")
        return words

    @property
    def function(self) -> str:
        """The name of its strategy: `servo_move` for ServoMove."""
        return strategy_name(self.name)

    @property
    def strategy_declared(self) -> str:
        """The declaration of its strategy."""
        before = f"def {self.function}() -> SearchStrategy["
        return Bracketed(before, [self.name], "]:", comma="").fitted(0)
