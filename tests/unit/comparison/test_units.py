"""Units: what is spelt in two ways is the same, and what only looks alike is not."""

from fractions import Fraction

import pytest
from framegen.comparison.units import Quantity, is_known, quantity
from framegen.comparison.wire import try_out, wire_effects
from framegen.language.spec import NumberField

from tests.in_turn import in_turn
from tests.mutations.edits import SPECS, pair_of
from tests.mutations.places import with_

SAME = [
    *(("ms", "millisecond"), ("mbar", "hPa"), ("us", "µs"), ("deg", "°"), ("‰", "permille")),
    *(("d%", "‰"), ("rpm", "rev/min"), ("1/min", "rpm"), ("1/s", "Hz"), ("degC", "°C")),
    ("msec", "ms"),
]
OTHER = [
    *(("ms", "s"), ("cm", "cm^2"), ("mT", "mgauss"), ("mbar", "Pa"), ("h", "hPa"), ("min", "m")),
    *(("m", "dam"), ("°C", "K"), ("°C", "°F"), ("d°C", "°C"), ("rpm", "Hz")),
]
# By hand: what a number of a unit is, in another one.
TEMPERATURES = [
    *(("°C", 100, "°F", 212), ("°C", -40, "°F", -40)),
    *(("K", 0, "c°C", -27315), ("d°C", 215, "m°C", 21500)),
]
KNOWN = ["ms", "°C", "°F", "K", "%", "‰", "rpm", "mV", "deg"]


def meant(**said: str) -> Quantity:
    """Return what a number with a unit or a scale means."""
    about = {"type": "u16", "about": "A number."}
    found = quantity(NumberField.model_validate({**about, **said}))
    assert found is not None
    return found


def field(unit: str) -> NumberField:
    return NumberField.model_validate({"type": "u16", "about": "A number.", "unit": unit})


@in_turn("one, other, alike", lambda: [*((*a, True) for a in SAME), *((*a, False) for a in OTHER)])
def test_one_unit_has_two_spellings_and_two_are_not_one(one: str, other: str, alike: bool) -> None:
    assert (meant(unit=one) == meant(unit=other)) is alike


@in_turn("unit, number, other, there", lambda: TEMPERATURES)
def test_temperatures_have_their_own_zero(unit: str, number: int, other: str, there: int) -> None:
    one, another = meant(unit=unit), meant(unit=other)
    assert (one.unit, one.value(number)) == (another.unit, another.value(there))


def test_a_step_and_an_offset_are_in_the_unit_of_a_scale() -> None:
    assert meant(scale="0.1 °C") == meant(unit="d°C")
    # By hand: 21.5 °C, in steps of half a degree above 20 °C and of five tenths of a degree.
    for scale, raw in [("0.5 °C + 20", 3), ("5 d°C + 200", 3), ("500 m°C + 20000", 3)]:
        found = meant(scale=scale)
        assert (found.value(raw), found.unit) == (Fraction("294.65"), "K"), scale
        assert found.raw(Fraction("294.65")) == raw


@in_turn("unit", lambda: KNOWN)
def test_a_unit_that_people_use_is_known(unit: str) -> None:
    assert is_known(meant(scale=f"1 {unit}").unit)


@pytest.mark.parametrize(
    ("old", "new", "outcomes"),
    [
        ("ms", "mV", {"misread"}),
        ("°C", "°F", {"misread"}),
        ("K", "°C", {"misread"}),
        ("°C", "degC", set()),
        # A spelling that is not known may be that of the same unit.
        ("knots", "kn", {"uncertain"}),
        ("ms", "ticks", {"misread"}),
        ("s", "ticks", {"uncertain"}),
    ],
)
def test_two_units_are_misread_if_both_are_known(old: str, new: str, outcomes: set[str]) -> None:
    specs = [
        with_(SPECS["busservo"], "messages", "ActionGroupSpeed", "fields", "percent", "unit", each)
        for each in (old, new)
    ]
    pair = pair_of(*specs)
    effects = wire_effects(pair, try_out(pair))
    assert {each.outcome for each in effects} == outcomes
