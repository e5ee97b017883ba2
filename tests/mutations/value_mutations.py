"""What authors do to what numbers mean: units, scales, ranges, named values and bits."""

from collections.abc import Callable
from functools import partial
from typing import Any

from tests.factories import Data
from tests.mutations.desk import Desk, Inapplicable, bounds_of, is_whole, renamed_in


def _unit(old: tuple[str, str], new: tuple[str, str], desk: Desk) -> None:
    """Say a unit in one way or another; it is written into the old edition by a change before."""
    field = desk.number(lambda field: (field.get("unit", ""), field.get("scale", "")) == old).field
    _say(field, new)


def _say(field: Data, said: tuple[str, str]) -> None:
    for key, text in zip(("unit", "scale"), said, strict=True):
        if text and (key == "unit" or is_whole(field)):
            field[key] = text
        else:
            field.pop(key, None)


def _dropped(key: str, desk: Desk) -> None:
    desk.number(lambda field: key in field).field.pop(key)


def _scaled(what: str, desk: Desk) -> None:
    field = desk.number(lambda field: "scale" in field).field
    step, _, unit = field["scale"].partition(" ")
    unit = unit.partition(" ")[0]
    larger = f"{float(step) * 10:.6f}".rstrip("0").rstrip(".")
    field["scale"] = f"{larger} {unit}" if what == "step" else f"{step} {unit} - 7"


def unit_larger(desk: Desk) -> None:
    field = desk.number(lambda field: field.get("unit") in _LARGER).field
    field["unit"] = _LARGER[field["unit"]]


_LARGER = {"ms": "s", "s": "ms", "mV": "V", "V": "mV", "°C": "K", "m": "km", "%": "‰"}


def unit_respelt(desk: Desk) -> None:
    field = desk.number(lambda field: field.get("unit") in _RESPELT and is_whole(field)).field
    if "scale" in field:
        raise Inapplicable
    field["scale"] = _RESPELT[field.pop("unit")]


_RESPELT = {"ms": "0.001 s", "s": "1000 ms", "mV": "0.001 V", "dV": "0.1 V", "V": "1 V"}


def range_given(desk: Desk) -> None:
    field = desk.number(lambda field: is_whole(field) and "range" not in field).field
    low, high = bounds_of(field)
    top = desk.chance.choice([high - 1, high // 2, 100])
    field["range"] = f"{desk.chance.choice([low, 0, 1])}..{min(top, high)}"


def _ranged(low_by: int, high_by: int, desk: Desk) -> None:
    field = desk.number(lambda field: is_whole(field) and "range" in field).field
    low, high = bounds_of(field)
    field["range"] = f"{low + low_by}..{high + high_by}"


def value_added(desk: Desk) -> None:
    field = desk.number(is_whole).field
    taken = {each["value"] for each in field.get("values", {}).values()}
    low, high = bounds_of(field)
    value = desk.pick(each for each in (low, low + 1, high, high - 1) if each not in taken)
    added = {"value": value, "about": "It is new."}
    field.setdefault("values", {})[desk.fresh("case")] = added


def _with(key: str, desk: Desk, least: int = 1) -> Any:
    """Return a number with so many named values, or bits, at least."""
    return desk.number(lambda field: len(field.get(key, ())) >= least).field


def _none_named(key: str, desk: Desk) -> None:
    del _with(key, desk)[key]


def _one_removed(key: str, least: int, desk: Desk) -> None:
    named = _with(key, desk, least)[key]
    del named[desk.pick(named)]


def _one_renamed(key: str, said: bool, desk: Desk) -> None:
    named = _with(key, desk)[key]
    renamed_in(named, desk.pick(named), desk.fresh("called"), said=said)


def _two_swapped(key: str, inner: str, desk: Desk) -> None:
    named = _with(key, desk, 2)[key]
    one, other = (named[name] for name in desk.chance.sample([*named], 2))
    one[inner], other[inner] = other[inner], one[inner]


def _free_values(field: Data) -> list[int]:
    taken = {each["value"] for each in field["values"].values()}
    low, high = bounds_of(field)
    return [each for each in (low, low + 1, low + 2, high, high - 1) if each not in taken]


def value_moved(desk: Desk) -> None:
    field = _with("values", desk)
    desk.one_of(field["values"])["value"] = desk.pick(_free_values(field))


def value_moved_and_renamed(desk: Desk) -> None:
    field = _with("values", desk)
    values, old = field["values"], desk.pick(field["values"])
    free = _free_values(field)
    values[desk.fresh("moved")] = {**values.pop(old), "value": desk.pick(free), "was": old}


def bits_given(desk: Desk) -> None:
    field = desk.number(lambda field: field["type"][0] == "u" and "bits" not in field).field
    if {"values", "scale", "unit", "signed_as"} & field.keys():
        raise Inapplicable
    field["bits"] = {desk.fresh("flag"): {"at": 0}, desk.fresh("rest"): {"at": "1..3"}}


def _free_bits(field: Data) -> set[int]:
    taken = {bit for each in field["bits"].values() for bit in _range(each["at"])}
    return {*range(int(field["type"][1:]))} - taken


def bit_added(desk: Desk) -> None:
    field = _with("bits", desk)
    field["bits"][desk.fresh("flag")] = {"at": desk.pick(_free_bits(field))}


def _range(at: int | str) -> range:
    low, _, high = str(at).partition("..")
    return range(int(low), int(high or low) + 1)


def bit_moved(desk: Desk) -> None:
    field = _with("bits", desk)
    free = desk.pick(_free_bits(field))
    desk.one_of(field["bits"])["at"] = free


VALUE_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    **{
        f"unit: {' '.join(new).strip()} documented": partial(_unit, ("", ""), new)
        for new in (("ms", ""), ("mV", ""), ("", "0.001 V"), ("", "0.5 °C - 40"), ("quirk", ""))
    },
    "unit: dropped": partial(_dropped, "unit"),
    "unit: larger": unit_larger,
    "unit: respelt as a scale": unit_respelt,
    "scale: dropped": partial(_dropped, "scale"),
    "scale: another step": partial(_scaled, "step"),
    "scale: another offset": partial(_scaled, "offset"),
    "range: documented": range_given,
    "range: dropped": partial(_dropped, "range"),
    "range: narrower below": partial(_ranged, 1, 0),
    "range: narrower above": partial(_ranged, 0, -1),
    "range: wider below": partial(_ranged, -1, 0),
    "range: wider above": partial(_ranged, 0, 1),
    "range: moved": partial(_ranged, 1, 1),
    "a value named": value_added,
    "a named value removed": partial(_one_removed, "values", 1),
    "no named values": partial(_none_named, "values"),
    "a named value renamed, said": partial(_one_renamed, "values", True),
    "a named value renamed, unsaid": partial(_one_renamed, "values", False),
    "a named value moved": value_moved,
    "a named value moved and renamed": value_moved_and_renamed,
    "named values swapped": partial(_two_swapped, "values", "value"),
    "bits documented": bits_given,
    "bits: dropped": partial(_none_named, "bits"),
    "bits: one added": bit_added,
    "bits: one removed": partial(_one_removed, "bits", 2),
    "bits: one renamed, said": partial(_one_renamed, "bits", True),
    "bits: one renamed, unsaid": partial(_one_renamed, "bits", False),
    "bits: swapped": partial(_two_swapped, "bits", "at"),
    "bits: one moved": bit_moved,
}
