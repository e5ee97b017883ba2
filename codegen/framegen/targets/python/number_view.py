"""A number as the templates show it: how it is declared, documented and read as signed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.number_types import NUMBER_TYPES
from framegen.targets.python.escape import WIDTH, Bracketed, Part, Text, literal
from framegen.targets.python.names import bit_name, constant_name, mask_name, signed_name
from framegen.targets.python.notes import noted

if TYPE_CHECKING:
    from framegen.language.spec import Bits, Spec
    from framegen.model.slots import Number


# What stands in front of an expression that a property returns, 8 columns from the left.
RETURN = "return "


@dataclass(frozen=True, slots=True)
class Constant:
    """A named value, as a class attribute: `TIMES_UNLIMITED = 0`."""

    name: str
    value: int | str
    about: str


@dataclass(frozen=True, slots=True)
class BitsView:
    """Named bits of a number, as a property beside it."""

    name: str
    doc: list[str]
    type: str
    read: str


@dataclass(frozen=True, slots=True)
class SignedView:
    """A number read as signed, as a property beside it."""

    name: str
    doc: list[str]
    read: str


@dataclass(frozen=True, slots=True)
class AbsentView:
    """The property that tells whether there is nothing to report."""

    doc: list[str]
    read: str


@dataclass(frozen=True, slots=True)
class NumberView:
    """A number of a message, or of an element."""

    slot: Number
    spec: Spec
    tail: int = 0

    @property
    def name(self) -> str:
        return self.slot.name

    @property
    def doc(self) -> list[str]:
        """The description; its range and unit are in the code above it."""
        field = self.slot.field
        scale = [f"A step is {field.scale}."] if field.scale else []
        return [" ".join([field.about, *scale, *self._sent, *self._notes])]

    @property
    def argument_doc(self) -> list[str]:
        """The description as an argument of a method, with its range and unit."""
        field = self.slot.field
        unit = f" {field.unit}" if field.unit else ""
        scale = f", in steps of {field.scale}" if field.scale else ""
        bounds = "any number" if self.slot.is_float else f"{self.slot.low}..{self.slot.high}"
        about = bounded(field.about, f"{bounds}{unit}{scale}")
        named = [f"{value.value} ({name}): {value.about}" for name, value in field.values.items()]
        return [about, *self._sent, *named, *self._notes]

    @property
    def _notes(self) -> list[str]:
        return noted(self.slot.field.notes, self.spec)

    @property
    def _sent(self) -> list[str]:
        """The values that a client sends unless its limits are changed."""
        limits = self.slot.field.limits
        if limits is None:
            return []
        others = [f"{name} take {range_}" for name, range_ in limits.others.items()]
        devices = f" ({', '.join(others)})" if others else ""
        return [f"A client sends {limits.usual} unless its `limits` say otherwise{devices}."]

    @property
    def type(self) -> str:
        """The class of the field: `U16`."""
        slot = self.slot
        return f"{'Swapped' if self._is_swapped else ''}{slot.number_type.name.upper()}"

    @property
    def _is_swapped(self) -> bool:
        """Whether its byte order is not the usual one."""
        return self.slot.order != self.spec.byte_order and self.slot.size > 1

    @property
    def value_type(self) -> str:
        """The type of its value."""
        value = "float" if self.slot.is_float else "int"
        return f"{value} | None" if self.slot.optional else value

    @property
    def argument(self) -> str:
        """The declaration as an argument."""
        default = " = None" if self.slot.optional else " = 0" if self._is_counter else ""
        return f"{self.name}: {self.value_type}{default}"

    @property
    def _is_counter(self) -> bool:
        return self.slot.role == "counter"

    @property
    def classes(self) -> dict[str, str]:
        """The classes that declare it, each with its module."""
        optional = {"Optional": "optional"} if self.slot.optional else {}
        return {self.type: self._home} | optional

    @property
    def _home(self) -> str:
        """The module of its class; a number of several bytes has one for each byte order."""
        if self.slot.size == 1:
            return "number"
        order = self.spec.byte_order
        if self._is_swapped:
            return f"{order}_swapped"
        # Of what is rare, modules of their own, so that nobody imports it who has none.
        if self.slot.is_float:
            return f"{order}_floats"
        return f"{order}_three_bytes" if self.slot.size == 3 else order

    @property
    def described(self) -> str:
        """The call that makes the field."""
        call = self.call([str(self.slot.at)])
        if self.slot.optional:
            tail = [f"tail={self.tail}"] if self.tail else []
            call = Bracketed("Optional(", [call, *tail], ")")
        return call.fitted(4, last=f"{self.name} = ")

    @property
    def notation(self) -> str:
        """What `struct` packs it as."""
        return self.slot.number_type.code if self._is_plain else f"{self.slot.size}s"

    @property
    def packed(self) -> str:
        """The expression that `struct` packs."""
        return self.name if self._is_plain else f"cls.{self.name}.struct.pack({self.name})"

    @property
    def _is_plain(self) -> bool:
        """Whether `struct` knows it, in the order of all others."""
        return not self._is_swapped and self.slot.number_type.code != ""

    def call(self, place: list[str]) -> Bracketed:
        """Return that call, with the arguments that the type does not imply."""
        slot, field = self.slot, self.slot.field
        items: list[Part] = [*place]
        if not slot.is_float:
            items += [f"low={slot.low}"] if slot.low != slot.number_type.low else []
            items += [f"high={slot.high}"] if slot.high != slot.number_type.high else []
        items += [Text(field.unit, before="unit=")] if field.unit else []
        names = [
            f"{literal(name)}: {constant.name}"
            for name, constant in zip(field.values, self.constants, strict=True)
        ]
        items += [Bracketed("names={", names, "}")] if names else []
        bits = [f"{literal(name)}: {mask_name(field, self.name, name)}" for name in field.bits]
        items += [Bracketed("bits={", bits, "}")] if bits else []
        others = [
            constant.name
            for constant in self.constants
            if slot.role == "address" and not slot.low <= int(constant.value) <= slot.high
        ]
        items += [Bracketed("others=(", others, ")", lone=",")] if others else []
        return Bracketed(f"{self.type}(", items, ")")

    @property
    def constants(self) -> list[Constant]:
        return [
            Constant(constant_name(self.name, name), value.value, value.about)
            for name, value in self.slot.field.values.items()
        ]

    @property
    def masks(self) -> list[Constant]:
        """A constant for all named bits: `ERROR_VOLTAGE = 0x01`."""
        field = self.slot.field
        return [
            Constant(
                mask_name(field, self.name, name),
                f"0x{_mask(bits):0{2 * self.slot.size}X}",
                bits.about or f"The bits of `{self.name}` for {name}.",
            )
            for name, bits in field.bits.items()
        ]

    @property
    def bits(self) -> list[BitsView]:
        """A property for all named bits: a truth value for one, a number for several."""
        return [self._bits(name, bits) for name, bits in self.slot.field.bits.items()]

    def _bits(self, name: str, bits: Bits) -> BitsView:
        whole, shift = f"self.{self.name}", bits.at.low
        mask = f"0x{_mask(bits) >> shift:X}"
        type_, read = "bool", f"{whole} & 0x{_mask(bits):X} != 0"
        if bits.at.high != shift:
            type_, read = "int", f"{whole} >> {shift} & {mask}" if shift else f"{whole} & {mask}"
        if self.slot.optional:
            type_, read = f"{type_} | None", f"None if {whole} is None else {read}"
        where = f"bit {shift}" if bits.at.high == shift else f"bits {bits.at}"
        if len(f"        return {read}") > WIDTH:
            read = f"(\n            {read}\n        )"
        doc = [
            bits.about or f"What `{self.name}` says of {name}.",
            f"It is {where} of `{self.name}`.",
        ]
        return BitsView(bit_name(self.name, name), doc, type_, read)

    @property
    def signed(self) -> SignedView | None:
        """The property that reads it as signed, where there is one."""
        signed_as = self.slot.field.signed_as
        if signed_as is None:
            return None
        number_type = NUMBER_TYPES[signed_as]
        sign = number_type.high + 1
        rest = "; one that is `absent` has none" if self.absent_values else ""
        doc = [f"`{self.name}` read as {signed_as}, which may be below zero{rest}."]
        read = _signed(f"self.{self.name} ^ {sign:#x}", f" - {sign:#x}")
        return SignedView(signed_name(self.name), doc, read)

    @property
    def absent_values(self) -> list[int]:
        """The values that mark absence."""
        return [each.value for each in self.slot.field.values.values() if each.absent]


def _mask(bits: Bits) -> int:
    high = bits.at.low if bits.at.high is None else bits.at.high
    return (1 << high + 1) - (1 << bits.at.low)


def bounded(about: str, bounds: str) -> str:
    """Return a description with its bounds before the full stop: `How long it takes (0..9 s).`."""
    return f"{about.removesuffix('.')} ({bounds})."


def absent_view(fields: list[NumberView]) -> AbsentView | None:
    """Return the property that tells whether an element or a message is absent."""
    for field in fields:
        values = field.absent_values
        if values:
            names = [each.name for each in field.constants if each.value in values]
            whole = f"self.{field.name}"
            test = (
                f"{whole} == {values[0]}"
                if len(values) == 1
                else Bracketed(f"{whole} in (", [str(value) for value in values], ")").fitted(
                    8, last=RETURN
                )
            )
            return AbsentView([f"Whether `{field.name}` is {' or '.join(names)}."], test)
    return None


def _signed(inner: str, outer: str) -> str:
    """Return the difference of `(inner)` and `outer`, in three lines where one is too long."""
    line = f"({inner}){outer}"
    if 8 + len(RETURN) + len(line) <= WIDTH:
        return line
    return f"(\n            {inner}\n        ){outer}"
