"""Text and packed numbers as the templates show them, and bytes that nobody gives."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, ClassVar

from framegen.model.slots import Items
from framegen.targets.python.escape import Bracketed, Part, Text, byte_literal, literal
from framegen.targets.python.notes import noted
from framegen.targets.python.number_view import BitsView, Constant, SignedView, bounded

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.language.spec import Spec
    from framegen.model.slots import Constant as Fixed
    from framegen.model.slots import Packed
    from framegen.model.slots import Text as TextSlot


def constants_call(constants: Sequence[Fixed]) -> str:
    """Return the assignment of bytes that nobody gives; empty where there are none."""
    made = [
        Bracketed(
            f"{'Reserved' if each.role == 'reserved' else 'Always'}(",
            [literal(each.name), str(each.at), byte_literal(each.data)],
            ")",
        )
        for each in constants
    ]
    return Bracketed("CONSTANTS = (", made, ")", lone=",").fitted(4) if made else ""


def constant_classes(constants: Sequence[Fixed]) -> dict[str, str]:
    """Return the classes that declare them, each with its module."""
    return {"Reserved" if each.role == "reserved" else "Always": "fixed" for each in constants}


class _NoNumber:
    """A field of bytes that are no number by themselves, which has nothing beside it."""

    constants: ClassVar[list[Constant]] = []
    masks: ClassVar[list[Constant]] = []
    bits: ClassVar[list[BitsView]] = []
    signed: ClassVar[SignedView | None] = None

    slot: TextSlot | Items | Packed
    value_type: ClassVar[str]

    @property
    def name(self) -> str:
        return self.slot.name

    @property
    def read_as(self) -> str:
        """The type of its value."""
        return self.value_type

    @property
    def notation(self) -> str:
        """What `struct` packs it as."""
        return f"{self.slot.size}s"

    @property
    def packed(self) -> str:
        """The expression that `struct` packs."""
        return f"cls.{self.name}.packed({self.name})"


@dataclass(frozen=True)
class TextView(_NoNumber):
    """A text of a message or of an element, of a fixed size or of one that varies."""

    slot: TextSlot | Items
    spec: Spec
    tail: int = 0

    value_type: ClassVar[str] = "str"
    modules: ClassVar[set[str]] = {"text"}
    classes: ClassVar[dict[str, str]] = {"Text": "text"}

    @property
    def argument(self) -> str:
        """The declaration as an argument."""
        return f"{self.name}: str"

    @property
    def described(self) -> str:
        """The call that makes the field."""
        slot = self.slot
        items: list[Part] = [str(slot.at)]
        if isinstance(slot, Items):
            items += [str(slot.high), f"least={slot.low}", *counters(slot, self.tail)]
        else:
            items += [str(slot.size)]
        return Bracketed("Text(", items, ")").fitted(4, last=f"{self.name} = ")

    @property
    def doc(self) -> list[str]:
        """The description."""
        return [" ".join([self.slot.field.about, *noted(self.slot.field.notes, self.spec)])]

    @property
    def argument_doc(self) -> list[str]:
        """The description as an argument of a method, with its bounds."""
        slot = self.slot
        bounds = f"{slot.low}..{slot.high}" if isinstance(slot, Items) else f"at most {slot.size}"
        about = bounded(slot.field.about, f"{bounds} characters")
        return [about, *noted(slot.field.notes, self.spec)]


@dataclass(frozen=True)
class PackedView(_NoNumber):
    """A fixed number of numbers whose bits stand behind each other."""

    slot: Packed
    spec: Spec

    value_type: ClassVar[str] = "tuple[int, ...]"
    modules: ClassVar[set[str]] = {"packed"}
    classes: ClassVar[dict[str, str]] = {"Packed": "packed"}

    @property
    def argument(self) -> str:
        """The declaration as an argument."""
        return f"{self.name}: Iterable[int]"

    @property
    def described(self) -> str:
        """The call that makes the field."""
        slot = self.slot
        sizes = [slot.at, slot.number_type.bits, slot.count]
        items: list[Part] = [*map(str, sizes), literal(slot.order)]
        items += [f"low={slot.low}"] if slot.low else []
        items += [f"high={slot.high}"] if slot.high != slot.number_type.high else []
        items += [Text(slot.field.unit, before="unit=")] if slot.field.unit else []
        return Bracketed("Packed(", items, ")").fitted(4, last=f"{self.name} = ")

    @property
    def doc(self) -> list[str]:
        """The description."""
        field = self.slot.field
        scale = [f"A step is {field.scale}."] if field.scale else []
        return [" ".join([field.about, *scale, *noted(field.notes, self.spec)])]

    @property
    def argument_doc(self) -> list[str]:
        """The description as an argument of a method, with its bounds."""
        slot = self.slot
        unit = f" {slot.field.unit}" if slot.field.unit else ""
        about = bounded(slot.field.about, f"{slot.count} of {slot.low}..{slot.high}{unit}")
        return [about, *noted(slot.field.notes, self.spec)]


def counters(items: Items, tail: int) -> list[Part]:
    """Return the arguments that say what the size of a list depends on."""
    found: list[Part] = [f"{each.role}={each.name}" for each in items.counters]
    return [*found, f"tail={tail}"] if tail and not items.is_fixed else found
