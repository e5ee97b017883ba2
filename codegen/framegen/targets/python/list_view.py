"""The list of a message as the templates show it: how it is declared, given and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Items, Number
from framegen.targets.python.element_view import ElementView
from framegen.targets.python.escape import WIDTH, Bracketed, Part
from framegen.targets.python.number_view import RETURN, NumberView, bounded

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Spec
    from framegen.targets.python.number_view import Constant

_COLUMNS_FOR = "For arrays and plots of a recording: several times as fast as reading"


def given(argument: Number | Items, value: Any, before: str = "") -> Part:
    """Return a value of an example as an argument, behind `before`; elements as plain tuples."""
    if isinstance(argument, Number):
        return f"{before}{value}"
    if argument.element is None:
        return Bracketed(f"{before}[", [str(item) for item in value], "]")
    names = [field.name for field in argument.fields]
    elements = [[str(item[name]) for name in names] for item in value]
    return Bracketed(
        f"{before}[", [Bracketed("(", element, ")", lone=",") for element in elements], "]"
    )


@dataclass(frozen=True, slots=True)
class ListView:
    """The list of a message."""

    slot: Items
    spec: Spec

    @property
    def name(self) -> str:
        return self.slot.name

    @property
    def fields(self) -> list[NumberView]:
        """The numbers of one element."""
        return [NumberView(field, self.spec) for field in self.slot.fields]

    @property
    def element(self) -> ElementView | None:
        """The class of its elements, where they are not bare numbers."""
        name = self.slot.element
        return None if name is None else ElementView(name, self.name, self.fields)

    @property
    def constants(self) -> list[Constant]:
        """The named values of bare numbers; elements have their own."""
        return [] if self.element else self.fields[0].constants

    @property
    def described(self) -> str:
        """The call that makes the field: its offset, its elements, and its bounds."""
        of: Part = self.element.name if self.element else self.fields[0].call([])
        bounds = [str(self.slot.low), str(self.slot.high), f"count={self.count}"]
        items = [str(self.slot.at), of, *bounds]
        return Bracketed("Items(", items, ")").fitted(4, last=f"{self.name} = ")

    @property
    def count(self) -> str:
        """The name of its count."""
        return self.slot.counter.name

    @property
    def doc(self) -> list[str]:
        """The description of the list, or of the numbers in it."""
        if self.element is None:
            return self.fields[0].doc
        return [" ".join([self.slot.field.about, *self._notes])]

    @property
    def argument_doc(self) -> list[str]:
        """The description as an argument of a method, with the bounds of its count."""
        about = bounded(self.slot.field.about, f"{self.slot.low}..{self.slot.high} items")
        return [about, *self._notes]

    @property
    def _notes(self) -> list[str]:
        sources = self.spec.sources
        return [
            f"{note.text} ({sources[note.cite.source].title})" for note in self.slot.field.notes
        ]

    @property
    def argument(self) -> Part:
        """The declaration as an argument."""
        if self.element is None:
            return f"{self.name}: Iterable[int]"
        element = Bracketed("tuple[", self.element.types, "]")
        return Bracketed(f"{self.name}: Iterable[", [element], "]", comma="")

    @property
    def read_as(self) -> str:
        """The type of its value."""
        return f"tuple[{self.slot.element or 'int'}, ...]"

    @property
    def taken(self) -> str:
        """The argument of the function that flattens its elements."""
        return _only_argument(f"flat = cls.{self.name}.flat(", self.name)

    @property
    def per_element(self) -> str:
        """The division of the number of values by the numbers of an element."""
        return f" // {len(self.fields)}" if len(self.fields) > 1 else ""

    @property
    def read_from(self) -> str:
        """The argument of the function that reads its numbers."""
        return _only_argument(f"numbers = type(self).{self.name}.numbers(", "self._frame")

    @property
    def column_types(self) -> str:
        """The types of its columns, as many as fit on the line."""
        types = ", ".join("Column" for _ in self.fields)
        return types if len(self.fields) <= 6 else "Column, ..."

    @property
    def columns(self) -> str:
        """The expression for its columns, made of all its numbers."""
        width = len(self.fields)
        parts = [f"numbers[{place}::{width}]" for place in range(width)]
        line = ", ".join(parts)
        if width > 1 and len("        return ") + len(line) <= WIDTH:
            return line
        return Bracketed("(", parts, ")", lone=",").fitted(8, last=RETURN)

    @property
    def columns_doc(self) -> list[str]:
        """The description of its columns."""
        *others, last = [field.name for field in self.fields]
        fields = f"{', '.join(others)} and {last}" if others else last
        return [
            f"Return the {self.name} as columns of plain numbers.",
            f"One for each field: {fields}. {_COLUMNS_FOR} `{self.name}`.",
        ]


def _only_argument(call: str, argument: str) -> str:
    """Return the argument of a call in a body, broken where the line would be too long."""
    return Bracketed(call, [argument], ")").fitted(8).removeprefix(call).removesuffix(")")
