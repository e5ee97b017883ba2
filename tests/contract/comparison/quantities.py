"""What raw numbers mean, worked out from what a spec says of them, apart from framegen."""

import math
from fractions import Fraction
from typing import Any

# By hand: a unit as a number of another one. A unit that is not here is only equal to itself.
_ROWS = (
    *(("ns", "0.000000001", "s"), ("us", "0.000001", "s"), ("ms", "0.001", "s")),
    *(("min", "60", "s"), ("h", "3600", "s"), ("mV", "0.001", "V"), ("dV", "0.1", "V")),
    *(("mA", "0.001", "A"), ("mAh", "0.001", "Ah"), ("kHz", "1000", "Hz"), ("mg", "0.001", "g")),
    *(("mm", "0.001", "m"), ("cm", "0.01", "m"), ("km", "1000", "m")),
    *(("cK", "0.01", "K"), ("°C", "1", "K"), ("%", "0.01", ""), ("‰", "0.001", "")),
)
UNITS = {unit: (factor, base) for unit, factor, base in _ROWS}
ZEROS = {"°C": Fraction("273.15")}
# Of two of these, neither is another spelling of the other.
KNOWN = {"s", "V", "A", "m", "Ah", "K", "g", "Hz", "", "°", "rad"}

Quantity = tuple[Fraction, Fraction, str]


def quantity_of(field: dict[str, Any]) -> Quantity | None:
    """Return step, offset and unit of a number; None for one that is only a number."""
    step, offset, unit = Fraction(1), Fraction(0), field.get("unit", "")
    if "scale" in field:
        words = str(field["scale"]).split()
        step = Fraction(words.pop(0))
        unit = words.pop(0) if words and words[0] not in "+-" else ""
        if words:
            offset = Fraction(words[1]) * (-1 if words[0] == "-" else 1)
    elif not unit:
        return None
    factor, base = UNITS.get(unit, ("1", unit))
    zero = ZEROS.get(unit, Fraction(0))
    return step * Fraction(factor), offset * Fraction(factor) + zero, base


def judge_numbers(ours: dict[str, Any], theirs: dict[str, Any], sent: float, read: float) -> str:
    """Judge a number as sent and as read, by what its two descriptions say that it means."""
    one, other = quantity_of(ours), quantity_of(theirs)
    if one is None or other is None or not (math.isfinite(sent) and math.isfinite(read)):
        alike = sent == read or (math.isnan(sent) and math.isnan(read))
        return "same" if alike else "misread"
    if one[2] != other[2]:
        alike = one[:2] == other[:2] and sent == read and not {one[2], other[2]} <= KNOWN
        return "uncertain" if alike else "misread"
    meant, understood = (
        each[0] * Fraction(number) + each[1] for each, number in ((one, sent), (other, read))
    )
    return "same" if meant == understood else "misread"


def said_again(ours: dict[str, Any], theirs: dict[str, Any], sent: float) -> float | None:
    """Return the number with which the other edition says the same; None where none does."""
    one, other = quantity_of(ours), quantity_of(theirs)
    if one is None or other is None or one[2] != other[2] or not math.isfinite(sent):
        return sent
    if one == other:
        return sent
    number = (one[0] * Fraction(sent) + one[1] - other[1]) / other[0]
    if theirs["type"][0] == "f":
        return float(number)
    return int(number) if number.denominator == 1 else None
