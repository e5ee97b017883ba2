"""Units: what a raw number means, however its unit is spelt."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.language.spec import NumberField

_PREFIXES = {
    "n": Fraction(1, 10**9),
    "u": Fraction(1, 10**6),
    "µ": Fraction(1, 10**6),
    "μ": Fraction(1, 10**6),
    "m": Fraction(1, 1000),
    "c": Fraction(1, 100),
    "d": Fraction(1, 10),
    "da": Fraction(10),
    "h": Fraction(100),
    "k": Fraction(1000),
    "M": Fraction(10**6),
    "G": Fraction(10**9),
}
# Units that take prefixes. All others are names, and equal if they are spelt alike.
_PREFIXED = frozenset(
    (
        "s",
        "m",
        "g",
        "V",
        "A",
        "W",
        "Hz",
        "Pa",
        "N",
        "Nm",
        "Ah",
        "Wh",
        "K",
        "J",
        "bar",
        "gauss",
        "rad",
        "Ω",
        "T",
        "F",
    )
)
_SPELLINGS = {
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "millisecond": "ms",
    "milliseconds": "ms",
    "microsecond": "us",
    "microseconds": "us",
    "volt": "V",
    "volts": "V",
    "millivolt": "mV",
    "millivolts": "mV",
    "ampere": "A",
    "amperes": "A",
    "percent": "%",
    "degree": "°",
    "degrees": "°",
    "deg": "°",
    "degC": "°C",
    "celsius": "°C",
    "ohm": "Ω",
}
_MULTIPLES = {
    "min": (Fraction(60), "s"),
    "h": (Fraction(3600), "s"),
    "rpm": (Fraction(1, 60), "rev/s"),
    "%": (Fraction(1, 100), ""),
    "‰": (Fraction(1, 1000), ""),
    "bar": (Fraction(10**5), "Pa"),
    "gauss": (Fraction(1, 10**4), "T"),
}


@dataclass(frozen=True, slots=True)
class Quantity:
    """What a raw number means: `step` times the number and `offset`, in a unit without prefix."""

    step: Fraction
    offset: Fraction
    unit: str

    def value(self, raw: float) -> Fraction:
        """Return what a raw number means in the unit."""
        return self.step * Fraction(raw) + self.offset

    def raw(self, value: Fraction) -> Fraction:
        """Return the raw number that means a value; not every one is a whole number."""
        return (value - self.offset) / self.step


def quantity(field: NumberField) -> Quantity | None:
    """Return what a number means as its unit or its scale says it; None where neither does."""
    if field.scale is not None:
        factor, unit = _base(field.scale.unit)
        step, offset = Fraction(field.scale.step), Fraction(field.scale.offset)
        return Quantity(step * factor, offset * factor, unit)
    if not field.unit:
        return None
    factor, unit = _base(field.unit)
    return Quantity(factor, Fraction(0), unit)


def _base(unit: str) -> tuple[Fraction, str]:
    """Return a unit as a factor and a unit without prefix: `mV` is a thousandth of `V`."""
    unit = _SPELLINGS.get(unit, _SPELLINGS.get(unit.lower(), unit))
    if unit in _MULTIPLES:
        return _MULTIPLES[unit]
    if unit in _PREFIXED:
        return Fraction(1), unit
    for prefix, factor in _PREFIXES.items():
        named = unit.removeprefix(prefix)
        if named != unit and named in _PREFIXED:
            multiple, base = _MULTIPLES.get(named, (Fraction(1), named))
            return factor * multiple, base
    return Fraction(1), unit
