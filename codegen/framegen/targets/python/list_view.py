"""What the templates show of the list of a message: how it is declared, given and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Items, Number
from framegen.targets.python.element_view import ElementView
from framegen.targets.python.escape import WIDTH, Bracketed, Part
from framegen.targets.python.number_view import RETURN, NumberView

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Spec
    from framegen.targets.python.number_view import Constant

_COLUMNS_FOR = "For arrays and plots of a recording: several times as fast as"


def given(argument: Number | Items, value: Any, before: str = "") -> Part:
    """A value of an example as an argument, behind `before`; elements as plain tuples."""
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
        """The class of its elements, where they are no bare numbers."""
        name = self.slot.element
        return None if name is None else ElementView(name, self.name, self.fields)

    @property
    def constants(self) -> list[Constant]:
        """The named values of bare numbers; elements have their own."""
        return [] if self.element else self.fields[0].constants

    @property
    def declared(self) -> str:
        """The line that declares it: its place, what it is a list of, and how many there may be."""
        of: Part = self.element.name if self.element else self.fields[0].made("", [])
        bounds = [str(self.slot.low), str(self.slot.high), f"count={self.slot.counter.name}"]
        return Bracketed(f"{self.name} = Items(", [str(self.slot.at), of, *bounds], ")").fitted(4)

    @property
    def doc(self) -> list[str]:
        """What it is, and what else is known of it."""
        return [" ".join([self.slot.field.about, *self._notes])]

    @property
    def argument_doc(self) -> list[str]:
        """The same for an argument of a method, whose declaration does not say how many may be."""
        bounds = f"{self.slot.low}..{self.slot.high} of them."
        return [self.slot.field.about, bounds, *self._notes]

    @property
    def _notes(self) -> list[str]:
        sources = self.spec.sources
        return [
            f"{note.text} ({sources[note.cite.source].title})" for note in self.slot.field.notes
        ]

    @property
    def argument(self) -> Part:
        """How it is declared as an argument."""
        if self.element is None:
            return f"{self.name}: Iterable[int]"
        element = Bracketed("tuple[", self.element.types, "]")
        return Bracketed(f"{self.name}: Iterable[", [element], "]", comma="")

    @property
    def read_as(self) -> str:
        """The type that reading it gives."""
        return f"tuple[{self.slot.element or 'int'}, ...]"

    @property
    def flat(self) -> str:
        """The statement that makes one list of all numbers that are given."""
        return Bracketed(f"flat = cls.{self.name}.flat(", [self.name], ")").fitted(8)

    @property
    def counted(self) -> str:
        """The statement that counts the elements."""
        width = len(self.fields)
        each = f" // {width}" if width > 1 else ""
        return f"{self.slot.counter.name} = len(flat){each}"

    @property
    def columns_declared(self) -> str:
        """The declaration of what reads it as columns, as many as there is room for in the line."""
        types = ", ".join("Column" for _ in self.fields)
        returned = types if len(self.fields) <= 6 else "Column, ..."
        return f"def columns(self) -> tuple[{returned}]:"

    @property
    def numbers(self) -> str:
        """The statement that reads all its numbers."""
        call = f"numbers = type(self).{self.name}.numbers("
        return Bracketed(call, ["self._frame"], ")").fitted(8)

    @property
    def columns(self) -> str:
        """The columns, of all the numbers in the order of the frame."""
        width = len(self.fields)
        parts = [f"numbers[{place}::{width}]" for place in range(width)]
        line = ", ".join(parts)
        if width > 1 and len("        return ") + len(line) <= WIDTH:
            return line
        return Bracketed("(", parts, ")", lone=",").fitted(8, last=RETURN)

    @property
    def columns_doc(self) -> list[str]:
        """What its columns are, and what they are for."""
        *others, last = [field.name for field in self.fields]
        fields = f"{', '.join(others)} and {last}" if others else last
        return [
            f"The {self.name} as columns of plain numbers.",
            f"One for each field: {fields}. {_COLUMNS_FOR} `{self.name}`.",
        ]
