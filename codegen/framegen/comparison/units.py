"""Units: what a raw number means, however its unit is spelt."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from decimal import Decimal

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
# Units that take prefixes, to which all others that are known come down.
_BASES = ("s", "m", "g", "V", "A", "W", "Hz", "Pa", "N", "Nm", "Ah", "Wh", "K", "J", "Ω", "T", "F")
_PREFIXED = frozenset((*_BASES, "rad", "°", "°C", "°F", "%", "bar", "gauss"))
_SPELLINGS = {
    "sec": "s",
    "second": "s",
    "seconds": "s",
    "millisecond": "ms",
    "milliseconds": "ms",
    "microsecond": "us",
    "microseconds": "us",
    "minute": "min",
    "minutes": "min",
    "hour": "h",
    "hours": "h",
    "volt": "V",
    "volts": "V",
    "millivolt": "mV",
    "millivolts": "mV",
    "ampere": "A",
    "amperes": "A",
    "percent": "%",
    "permille": "‰",
    "degree": "°",
    "degrees": "°",
    "deg": "°",
    "degC": "°C",
    "degc": "°C",
    "℃": "°C",
    "celsius": "°C",
    "degF": "°F",
    "degf": "°F",
    "℉": "°F",
    "fahrenheit": "°F",
    "kelvin": "K",
    "ohm": "Ω",
    "1/s": "Hz",
    "rev/s": "Hz",
    "1/min": "rpm",
    "rev/min": "rpm",
    "r/min": "rpm",
}
_MULTIPLES = {
    "min": (Fraction(60), "s"),
    "h": (Fraction(3600), "s"),
    "rpm": (Fraction(1, 60), "Hz"),
    "%": (Fraction(1, 100), ""),
    "‰": (Fraction(1, 1000), ""),
    "bar": (Fraction(10**5), "Pa"),
    "gauss": (Fraction(1, 10**4), "T"),
    "°C": (Fraction(1), "K"),
    "°F": (Fraction(5, 9), "K"),
}
# What zero is in the unit without prefix.
_ZEROS = {"°C": Fraction("273.15"), "°F": Fraction("459.67") * Fraction(5, 9)}


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
        return _quantity(field.scale.unit, field.scale.step, field.scale.offset)
    return _quantity(field.unit) if field.unit else None


# The same few units and scales are asked for with every value that is compared.
@lru_cache(maxsize=256)
def _quantity(unit: str, step: Decimal | int = 1, offset: Decimal | int = 0) -> Quantity:
    factor, zero, base = _base(unit)
    return Quantity(Fraction(step) * factor, Fraction(offset) * factor + zero, base)


def is_known(unit: str) -> bool:
    """Tell whether the unit of a quantity is one of those whose spellings are known."""
    return not unit or unit in _PREFIXED


def _base(unit: str) -> tuple[Fraction, Fraction, str]:
    """Return a unit as a factor, what its zero is, and a unit without prefix.

    `mV` is a thousandth of `V`, and zero is zero.
    """
    unit = _spelt(unit)
    if unit in _MULTIPLES or unit in _PREFIXED:
        return _unprefixed(Fraction(1), unit)
    for prefix, factor in _PREFIXES.items():
        named = _spelt(unit.removeprefix(prefix))
        if unit.startswith(prefix) and named in _PREFIXED:
            return _unprefixed(factor, named)
    return Fraction(1), Fraction(0), unit


def _spelt(unit: str) -> str:
    return _SPELLINGS.get(unit, _SPELLINGS.get(unit.lower(), unit))


def _unprefixed(factor: Fraction, unit: str) -> tuple[Fraction, Fraction, str]:
    multiple, base = _MULTIPLES.get(unit, (Fraction(1), unit))
    return factor * multiple, _ZEROS.get(unit, Fraction(0)), base
