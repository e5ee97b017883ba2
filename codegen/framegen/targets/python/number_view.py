"""What the templates show of a number: how it is described, checked and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, literal

if TYPE_CHECKING:
    from framegen.layout import WireField
    from framegen.spec import Spec


@dataclass(frozen=True, slots=True)
class Constant:
    """A named value, as a class attribute: `TIMES_UNLIMITED = 0`."""

    name: str
    value: int
    about: str


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
        return [field.about, f"{self.low}..{self.high}{unit}{scale}.", *named, *notes]

    @property
    def constants(self) -> list[Constant]:
        return [
            Constant(f"{self.name}_{name}".upper(), value.value, value.about)
            for name, value in self.layout.field.values.items()
        ]

    @property
    def read(self) -> str:
        """The expression that reads it from the frame."""
        start, end = self.layout.offset, self.layout.offset + self.layout.wire.size
        if self.layout.wire.name == "u8":
            return f"self._frame[{start}]"
        signed = ", signed=True" if self.layout.wire.low < 0 else ""
        return f'int.from_bytes(self._frame[{start}:{end}], "{self.spec.byte_order}"{signed})'

    @property
    def strategy(self) -> str:
        """Hypothesis's strategy for it."""
        return f"st.integers({self.low}, {self.high})"

    @property
    def described(self) -> Bracketed:
        """The call that describes it to the runtime."""
        field = self.layout.field
        items: list[str | Bracketed] = [literal(self.name), literal(self.layout.wire.code)]
        items += [str(self.low), str(self.high)]
        if field.unit:
            items.append(f"unit={literal(field.unit)}")
        if field.values:
            names = [f"{literal(name)}: {value.value}" for name, value in field.values.items()]
            items.append(Bracketed("names={", names, "}"))
        return Bracketed("Number(", items, ")")
