"""Units: what is spelt in two ways is the same, and what only looks alike is not."""

import pytest
from framegen.comparison.units import quantity
from framegen.language.spec import NumberField

SAME = [
    ("ms", "millisecond"),
    ("mbar", "hPa"),
    ("us", "µs"),
    ("deg", "°"),
]
OTHER = [
    ("ms", "s"),
    ("cm", "cm^2"),
    ("mT", "mgauss"),
    ("mbar", "Pa"),
    ("h", "hPa"),
    ("min", "m"),
    ("m", "dam"),
]


def field(unit: str) -> NumberField:
    """Return a number with a unit."""
    return NumberField.model_validate({"type": "u16", "about": "A number.", "unit": unit})


@pytest.mark.parametrize(("one", "other"), SAME)
def test_one_unit_has_two_spellings(one: str, other: str) -> None:
    assert quantity(field(one)) == quantity(field(other))


@pytest.mark.parametrize(("one", "other"), OTHER)
def test_two_units_are_not_one(one: str, other: str) -> None:
    assert quantity(field(one)) != quantity(field(other))
