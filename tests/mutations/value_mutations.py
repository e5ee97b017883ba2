"""What authors do to what numbers mean: units, scales, ranges, named values and bits."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from tests.mutations.desk import Inapplicable, bounds_of, is_whole, removed

if TYPE_CHECKING:
    from collections.abc import Callable

    from tests.factories import Data
    from tests.mutations.desk import Desk


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


def unit_dropped(desk: Desk) -> None:
    desk.number(lambda field: "unit" in field).field.pop("unit")


def scale_dropped(desk: Desk) -> None:
    desk.number(lambda field: "scale" in field).field.pop("scale")


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


def range_dropped(desk: Desk) -> None:
    desk.number(lambda field: "range" in field).field.pop("range")


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


def _with_values(desk: Desk, least: int = 1) -> Data:
    return desk.number(lambda field: len(field.get("values", ())) >= least).field


def value_removed(desk: Desk) -> None:
    values = _with_values(desk)["values"]
    removed(values, desk.pick(values))


def values_dropped(desk: Desk) -> None:
    del _with_values(desk)["values"]


def _value_renamed(said: bool, desk: Desk) -> None:
    _rename(desk, _with_values(desk)["values"], said=said)


def _rename(desk: Desk, things: Data, *, said: bool) -> None:
    old = desk.pick(things)
    new = desk.fresh("called")
    renamed = {**things[old], **({"was": old} if said else {})}
    named = {new if key == old else key: things[key] for key in things}
    things.clear()
    things.update({**named, new: renamed})


def value_moved(desk: Desk) -> None:
    field = _with_values(desk)
    taken = {each["value"] for each in field["values"].values()}
    low, high = bounds_of(field)
    free = [each for each in (low, low + 1, low + 2, high, high - 1) if each not in taken]
    field["values"][desk.pick(field["values"])]["value"] = desk.pick(free)


def value_moved_and_renamed(desk: Desk) -> None:
    field = _with_values(desk)
    values = field["values"]
    taken = {each["value"] for each in values.values()}
    low, high = bounds_of(field)
    free = [each for each in (low, low + 1, low + 2, high, high - 1) if each not in taken]
    old = desk.pick(values)
    values[desk.fresh("moved")] = {**values.pop(old), "value": desk.pick(free), "was": old}


def values_swapped(desk: Desk) -> None:
    values = _with_values(desk, 2)["values"]
    one, other = desk.chance.sample([*values], 2)
    values[one]["value"], values[other]["value"] = values[other]["value"], values[one]["value"]


def bits_given(desk: Desk) -> None:
    field = desk.number(lambda field: field["type"][0] == "u" and "bits" not in field).field
    if {"values", "scale", "unit", "signed_as"} & field.keys():
        raise Inapplicable
    field["bits"] = {desk.fresh("flag"): {"at": 0}, desk.fresh("rest"): {"at": "1..3"}}


def _with_bits(desk: Desk, least: int = 1) -> Data:
    return desk.number(lambda field: len(field.get("bits", ())) >= least).field


def bits_dropped(desk: Desk) -> None:
    del _with_bits(desk)["bits"]


def bit_added(desk: Desk) -> None:
    field = _with_bits(desk)
    taken = {bit for each in field["bits"].values() for bit in _range(each["at"])}
    free = desk.pick({*range(int(field["type"][1:]))} - taken)
    field["bits"][desk.fresh("flag")] = {"at": free}


def _range(at: int | str) -> range:
    low, _, high = str(at).partition("..")
    return range(int(low), int(high or low) + 1)


def bit_removed(desk: Desk) -> None:
    bits = _with_bits(desk, 2)["bits"]
    removed(bits, desk.pick(bits))


def _bit_renamed(said: bool, desk: Desk) -> None:
    _rename(desk, _with_bits(desk)["bits"], said=said)


def bits_swapped(desk: Desk) -> None:
    bits = _with_bits(desk, 2)["bits"]
    one, other = desk.chance.sample([*bits], 2)
    bits[one]["at"], bits[other]["at"] = bits[other]["at"], bits[one]["at"]


def bit_moved(desk: Desk) -> None:
    field = _with_bits(desk)
    taken = {bit for each in field["bits"].values() for bit in _range(each["at"])}
    free = desk.pick({*range(int(field["type"][1:]))} - taken)
    field["bits"][desk.pick(field["bits"])]["at"] = free


VALUE_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    **{
        f"unit: {' '.join(new).strip()} documented": partial(_unit, ("", ""), new)
        for new in (("ms", ""), ("mV", ""), ("", "0.001 V"), ("", "0.5 °C - 40"), ("quirk", ""))
    },
    "unit: dropped": unit_dropped,
    "unit: larger": unit_larger,
    "unit: respelt as a scale": unit_respelt,
    "scale: dropped": scale_dropped,
    "scale: another step": partial(_scaled, "step"),
    "scale: another offset": partial(_scaled, "offset"),
    "range: documented": range_given,
    "range: dropped": range_dropped,
    "range: narrower below": partial(_ranged, 1, 0),
    "range: narrower above": partial(_ranged, 0, -1),
    "range: wider below": partial(_ranged, -1, 0),
    "range: wider above": partial(_ranged, 0, 1),
    "range: moved": partial(_ranged, 1, 1),
    "a value named": value_added,
    "a named value removed": value_removed,
    "no named values": values_dropped,
    "a named value renamed, said": partial(_value_renamed, True),
    "a named value renamed, unsaid": partial(_value_renamed, False),
    "a named value moved": value_moved,
    "a named value moved and renamed": value_moved_and_renamed,
    "named values swapped": values_swapped,
    "bits documented": bits_given,
    "bits: dropped": bits_dropped,
    "bits: one added": bit_added,
    "bits: one removed": bit_removed,
    "bits: one renamed, said": partial(_bit_renamed, True),
    "bits: one renamed, unsaid": partial(_bit_renamed, False),
    "bits: swapped": bits_swapped,
    "bits: one moved": bit_moved,
}
