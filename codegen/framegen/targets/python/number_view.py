"""What the templates show of a number: how it is described, checked and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.wiretypes import WIRE_TYPES
from framegen.targets.python.escape import WIDTH, Bracketed, Part, Text, literal
from framegen.targets.python.names import constant_name, signed_name

if TYPE_CHECKING:
    from framegen.language.spec import Spec
    from framegen.model.layout import WireField


# What stands in front of an expression that a property returns, 8 columns from the left.
RETURN = "return "


@dataclass(frozen=True, slots=True)
class Constant:
    """A named value, as a class attribute: `TIMES_UNLIMITED = 0`."""

    name: str
    value: int
    about: str


@dataclass(frozen=True, slots=True)
class SignedView:
    """A number read as signed, as a property beside it."""

    name: str
    doc: list[str]
    read: str


@dataclass(frozen=True, slots=True)
class AbsentView:
    """What tells whether there is nothing to tell of, as a property."""

    doc: list[str]
    read: str


@dataclass(frozen=True, slots=True)
class NumberView:
    """A number: how it is described, checked and read."""

    layout: WireField
    spec: Spec

    @property
    def name(self) -> str:
        return self.layout.name

    @property
    def low(self) -> int:
        return self.layout.low

    @property
    def high(self) -> int:
        return self.layout.high

    @property
    def doc(self) -> list[str]:
        """What it is; its range, unit and scale; its named values; and what else is known of it."""
        field = self.layout.field
        unit = f" {field.unit}" if field.unit else ""
        scale = f", a step being {field.scale}" if field.scale else ""
        named = [f"{value.value} ({name}): {value.about}" for name, value in field.values.items()]
        notes = [
            f"{note.text} ({self.spec.sources[note.cite.source].title})" for note in field.notes
        ]
        return [field.about, f"{self.low}..{self.high}{unit}{scale}.", *self._sent, *named, *notes]

    @property
    def _sent(self) -> list[str]:
        """What a client sends of it unless told otherwise."""
        limits = self.layout.field.limits
        if limits is None:
            return []
        others = [f"{name} take {range_}" for name, range_ in limits.others.items()]
        told = f" ({', '.join(others)})" if others else ""
        return [f"A client sends {limits.usual} unless its `limits` say otherwise{told}."]

    @property
    def signed(self) -> SignedView | None:
        """What reads it as signed, where it can be."""
        signed_as = self.layout.field.signed_as
        if signed_as is None:
            return None
        wire = WIRE_TYPES[signed_as]
        sign = wire.high + 1
        return SignedView(
            signed_name(self.name),
            [
                f"`{self.name}` read as {signed_as}, which may be below zero.",
                f"{wire.low}..{wire.high}. One that is `absent` has none."
                if self.absent_values
                else f"{wire.low}..{wire.high}.",
            ],
            _signed(f"self.{self.name} ^ {sign:#x}", f" - {sign:#x}"),
        )

    @property
    def absent_values(self) -> list[int]:
        """The values that say that there is nothing to tell of."""
        return [each.value for each in self.layout.field.values.values() if each.absent]

    @property
    def constants(self) -> list[Constant]:
        return [
            Constant(constant_name(self.name, name), value.value, value.about)
            for name, value in self.layout.field.values.items()
        ]

    @property
    def read(self) -> str:
        """The expression that reads it from the frame."""
        start, end = self.layout.offset, self.layout.offset + self.layout.wire.size
        if self.layout.wire.is_byte:
            return f"self._frame[{start}]"
        signed = ", signed=True" if self.layout.wire.low < 0 else ""
        return f'int.from_bytes(self._frame[{start}:{end}], "{self.spec.byte_order}"{signed})'

    @property
    def strategy(self) -> Bracketed:
        """Hypothesis's strategy for it."""
        return self.strategy_as("")

    def strategy_as(self, before: str) -> Bracketed:
        """The same, as an argument behind `before`."""
        return Bracketed(f"{before}st.integers(", [str(self.low), str(self.high)], ")")

    @property
    def described(self) -> Bracketed:
        """The call that describes it to the runtime."""
        field = self.layout.field
        items: list[Part] = [literal(self.name), literal(self.layout.wire.code)]
        items += [str(self.low), str(self.high)]
        if field.unit:
            items.append(Text(field.unit, before="unit="))
        if field.values:
            names = [f"{literal(name)}: {value.value}" for name, value in field.values.items()]
            items.append(Bracketed("names={", names, "}"))
        return Bracketed("Number(", items, ")")


def absent_view(fields: list[NumberView]) -> AbsentView | None:
    """What tells whether an element, or a message, with these numbers is absent."""
    for field in fields:
        values = field.absent_values
        if values:
            named = field.layout.field.values
            about = [each.about for each in named.values() if each.absent]
            whole = f"self.{field.name}"
            test = (
                f"{whole} == {values[0]}"
                if len(values) == 1
                else Bracketed(f"{whole} in (", [str(value) for value in values], ")").fitted(
                    8, last=RETURN
                )
            )
            return AbsentView(
                [f"Whether `{field.name}` says that there is nothing to tell of.", *about],
                test,
            )
    return None


def _signed(inner: str, outer: str) -> str:
    """The difference of `(inner)` and `outer`, in three lines where it is too long for one."""
    line = f"({inner}){outer}"
    if 8 + len(RETURN) + len(line) <= WIDTH:
        return line
    return f"(\n            {inner}\n        ){outer}"
