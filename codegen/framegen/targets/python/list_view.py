"""The list of a message as the templates show it: how it is declared, given and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.slots import Constant as Fixed
from framegen.model.slots import Items, Packed
from framegen.model.slots import Text as TextSlot
from framegen.targets.python.element_view import ElementView
from framegen.targets.python.escape import WIDTH, Bracketed, Part, Sum, literal
from framegen.targets.python.notes import noted
from framegen.targets.python.number_view import RETURN, NumberView, bounded
from framegen.targets.python.text_view import TextView, counters

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Spec
    from framegen.model.slots import Field
    from framegen.targets.python.number_view import BitsView, Constant, SignedView

_COLUMNS_FOR = "For arrays and plots of a recording: several times as fast as reading"


def given(argument: Field, value: Any, before: str = "") -> Part:
    """Return a value of an example as an argument, behind `before`; elements as plain tuples."""
    if isinstance(value, str) or not isinstance(argument, Items | Packed):
        return f"{before}{_literal(value)}"
    if isinstance(argument, Packed) or argument.element is None:
        return Bracketed(f"{before}[", [str(item) for item in value], "]")
    names = [field.name for field in argument.fields]
    elements = [[_literal(item[name]) for name in names] for item in value]
    return Bracketed(
        f"{before}[", [Bracketed("(", element, ")", lone=",") for element in elements], "]"
    )


def _literal(value: Any) -> str:
    return literal(value) if isinstance(value, str) else str(value)


@dataclass(frozen=True, slots=True)
class ListView:
    """A list of a message, with `tail` bytes behind the fields."""

    slot: Items
    spec: Spec
    tail: int = 0

    @property
    def name(self) -> str:
        return self.slot.name

    @property
    def fields(self) -> list[NumberView | TextView]:
        """The numbers and texts of one element."""
        return [
            TextView(field, self.spec)
            if isinstance(field, TextSlot)
            else NumberView(field, self.spec)
            for field in self.slot.fields
        ]

    @property
    def bare(self) -> NumberView | None:
        """The number that each element is, where it has no fields."""
        first = self.fields[0]
        return first if self.slot.element is None and isinstance(first, NumberView) else None

    @property
    def value_type(self) -> str:
        """The type of its elements."""
        return self.slot.element or self.fields[0].value_type

    @property
    def element(self) -> ElementView | None:
        """The class of its elements, where they are not bare numbers."""
        name = self.slot.element
        if name is None:
            return None
        fixed = [slot for slot in self.slot.slots if isinstance(slot, Fixed)]
        return ElementView(name, self.name, self.fields, fixed)

    @property
    def constants(self) -> list[Constant]:
        """The named values of bare numbers; elements have their own."""
        return [] if self.bare is None else self.bare.constants

    @property
    def masks(self) -> list[Constant]:
        """The named bits of bare numbers."""
        return [] if self.bare is None else self.bare.masks

    @property
    def bits(self) -> list[BitsView]:
        """The properties that read named bits: a list has none."""
        return []

    @property
    def signed(self) -> SignedView | None:
        """The property that reads it as signed: a list has none."""
        return None

    @property
    def described(self) -> str:
        """The call that makes the field: its offset, its elements, and its bounds."""
        of: Part = self.bare.call([]) if self.bare else str(self.slot.element)
        items = [str(self.slot.at), of, str(self.slot.low), str(self.slot.high)]
        items += counters(self.slot, self.tail)
        return Bracketed("List(", items, ")").fitted(4, last=f"{self.name} = ")

    @property
    def classes(self) -> dict[str, str]:
        """The classes that declare it, each with its module."""
        return {"List": "lists"} | (self.bare.classes if self.bare else {})

    @property
    def count(self) -> str:
        """The name of its count."""
        return self.slot.counters[0].name

    @property
    def notation(self) -> str:
        """What `struct` packs it as, where it is of a fixed size."""
        return f"{self.slot.low * self.slot.size}s"

    @property
    def packed(self) -> str:
        """The expression that `struct` packs, where it is of a fixed size."""
        return f"cls.{self.name}.packed({self.name})"

    @property
    def doc(self) -> list[str]:
        """The description of the list, or of the numbers in it."""
        if self.bare is not None:
            return self.bare.doc
        return [" ".join([self.slot.field.about, *noted(self.slot.field.notes, self.spec)])]

    @property
    def argument_doc(self) -> list[str]:
        """The description as an argument of a method, with the bounds of its count."""
        slot = self.slot
        bounds = str(slot.low) if slot.is_fixed else f"{slot.low}..{slot.high}"
        about = bounded(slot.field.about, f"{bounds} items")
        return [about, *noted(slot.field.notes, self.spec)]

    @property
    def is_paired(self) -> bool:
        """Whether each element is a pair, so that a mapping of the first to the second is one."""
        return self.element is not None and len(self.fields) == 2

    @property
    def argument(self) -> Part:
        """The declaration as an argument."""
        if self.element is None:
            return f"{self.name}: Iterable[{self.value_type}]"
        element = Bracketed("tuple[", self.element.types, "]")
        if self.is_paired:
            mapping = Bracketed(f"{self.name}: Mapping[", self.element.types, "]")
            return Sum([str(mapping), f"Iterable[{element}]"], "|")
        return Bracketed(f"{self.name}: Iterable[", [element], "]", comma="")

    @property
    def read_as(self) -> str:
        """The type of its value."""
        return f"tuple[{self.value_type}, ...]"

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
