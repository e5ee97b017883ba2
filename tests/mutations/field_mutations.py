"""What authors do to fields: types, order, presence, names, constants."""

from collections.abc import Callable
from functools import partial

from tests.factories import Data
from tests.mutations.desk import (
    Desk,
    Inapplicable,
    Spot,
    copied,
    inserted,
    is_constant,
    is_counter,
    is_single,
    is_whole,
    other_order,
    reordered,
    varies,
)

# Types that an author might take for each other.
RETYPED = (
    *("u8-u16", "u16-u8", "u16-u32", "u32-u16", "u8-i8", "i8-u8", "u16-i16", "i16-u16", "u16-u24"),
    *("u24-u16", "u32-f32", "f32-u32", "f32-f64", "f64-f32", "i32-u32", "u64-i64", "u32-i32"),
)
ADDED: dict[str, Data] = {
    "a byte": {"type": "u8"},
    "a number": {"type": "u16"},
    "a constant": {"type": "u8", "always": 7},
    "padding": {"type": "u8", "reserved": 0},
    "text": {"type": "u8", "count": 3, "text": "ascii"},
}


def _without(field: Data, *keys: str) -> None:
    for key in keys:
        field.pop(key, None)


def _retyped(pair: str, desk: Desk) -> None:
    old, new = pair.split("-")
    field = desk.number(lambda field: field["type"] == old).field
    field["type"] = new
    _without(field, "range", "bits", "signed_as", "limits")
    if new[0] == "f":
        _without(field, "values", "bits", "scale")


def counter_retyped(desk: Desk) -> None:
    field = desk.spot(is_counter).field
    field["type"] = {"u8": "u16", "u16": "u8"}.get(field["type"], "u8")


def order_of_bytes(desk: Desk) -> None:
    other_order(desk, desk.number(lambda field: field["type"][1:] != "8").field)


def order_of_bytes_said(desk: Desk) -> None:
    field = desk.number(lambda field: "byte_order" not in field).field
    field["byte_order"] = desk.spec["byte_order"]


def order_of_all_bytes(desk: Desk) -> None:
    desk.spec["byte_order"] = "little" if desk.spec["byte_order"] == "big" else "big"


def _swapped(desk: Desk) -> Spot:
    """Swap a field with the one behind it, the last with the first; return where it was."""
    spot = desk.spot(lambda spot: len(spot.fields) > 1 and _movable(spot))
    names = [*spot.fields]
    at = names.index(spot.name)
    to = (at + 1) % len(names)
    names[at], names[to] = names[to], names[at]
    reordered(spot.fields, names)
    return spot


def neighbours_swapped(desk: Desk) -> None:
    _swapped(desk)


def first_put_last(desk: Desk) -> None:
    spot = desk.spot(lambda spot: len(spot.fields) > 2 and _movable(spot))
    names = [each for each in spot.fields if each != spot.name]
    at = len(names) - any(varies(each) for each in spot.fields.values())
    reordered(spot.fields, [*names[:at], spot.name, *names[at:]])


def _movable(spot: Spot) -> bool:
    return not varies(spot.field) and "optional" not in spot.field


def _taken_away(where: str, desk: Desk) -> None:
    def fits(spot: Spot) -> bool:
        names = [*spot.fields]
        at = names.index(spot.name)
        place = "front" if at == 0 else "end" if at == len(names) - 1 else "middle"
        return place == where and not is_counter(spot)

    spot = desk.spot(fits)
    del spot.fields[spot.name]
    _unmentioned(spot)


def _unmentioned(spot: Spot) -> None:
    """Drop a method that names a field which is no argument any more."""
    if not spot.inner:
        spot.message.pop("method", None)


def _put_in(where: str, what: Data, desk: Desk) -> None:
    message = desk.pick(desk.messages.values())
    fields = message["fields"]
    names = [*fields]
    # Behind a list of a size that varies there is nothing, nor behind what may be absent.
    last = next(
        (at for at, name in enumerate(names) if varies(fields[name]) or "optional" in fields[name]),
        len(names),
    )
    at = {"front": 0, "middle": last // 2, "end": last}[where]
    inserted(fields, at, desk.fresh("added"), {**what, "about": "It is new."})
    message.pop("method", None)


def optional_added(desk: Desk) -> None:
    fixed = [
        each for each in desk.messages.values() if not any(map(varies, each["fields"].values()))
    ]
    roles = [[part["is"] for part in desk.parts_of(each).values()] for each in fixed]
    message = desk.pick(m for m, parts in zip(fixed, roles, strict=True) if "length" in parts)
    kind = desk.chance.choice(["u8", "u16"])
    message["fields"][desk.fresh("extra")] = {"type": kind, "optional": True, "about": "New."}
    message.pop("method", None)


def became_optional(desk: Desk) -> None:
    spot = desk.number(lambda field: "optional" not in field)
    if spot.inner or [*spot.fields][-1] != spot.name:
        raise Inapplicable
    spot.field["optional"] = True


def _sure(all_of_them: bool, desk: Desk) -> None:
    """What may be absent always comes: the first of some message, or all."""
    several = [
        [field for field in message["fields"].values() if "optional" in field]
        for message in desk.messages.values()
    ]
    first, *others = desk.pick(each for each in several if each)
    for field in [first, *others] if all_of_them else [first]:
        del field["optional"]


def _renamed(said: bool, desk: Desk) -> None:
    spot = desk.spot(lambda spot: not spot.field.get("was"))
    desk.rename_field(spot, desk.fresh("renamed"), said=said)


def _renamed_and_moved(said: bool, desk: Desk) -> None:
    desk.rename_field(_swapped(desk), desk.fresh("moved"), said=said)


def _renamed_and_retyped(said: bool, desk: Desk) -> None:
    spot = desk.number(lambda field: is_whole(field) and field["type"] != "u32")
    spot.field["type"] = "u32"
    _without(spot.field, "bits", "signed_as", "limits")
    desk.rename_field(spot, desk.fresh("wide"), said=said)


def replaced(desk: Desk) -> None:
    """Another field stands in the place of one that is gone."""
    spot = desk.number()
    names = [*spot.fields]
    at = names.index(spot.name)
    other = copied(spot.field)
    del spot.fields[spot.name]
    inserted(spot.fields, at, desk.fresh("another"), other)
    _unmentioned(spot)


def split_in_two(desk: Desk) -> None:
    """Two bytes instead of one number of two."""
    spot = desk.number(lambda field: field["type"] == "u16")
    at = [*spot.fields].index(spot.name)
    del spot.fields[spot.name]
    for number, stem in enumerate(("low", "high")):
        inserted(spot.fields, at + number, desk.fresh(stem), {"type": "u8", "about": "Half."})
    _unmentioned(spot)


def joined(desk: Desk) -> None:
    """One number of two bytes instead of two of one."""

    def fits(spot: Spot) -> bool:
        names = [*spot.fields]
        at = names.index(spot.name)
        pair = [spot.fields[name] for name in names[at : at + 2]]
        return len(pair) == 2 and all(is_single(each) and each["type"] == "u8" for each in pair)

    spot = desk.spot(lambda spot: fits(spot) and not is_counter(spot))
    names = [*spot.fields]
    at = names.index(spot.name)
    del spot.fields[names[at + 1]]
    del spot.fields[spot.name]
    inserted(spot.fields, at, desk.fresh("joined"), {"type": "u16", "about": "Both."})
    _unmentioned(spot)


def _constant_changed(key: str, desk: Desk) -> None:
    field = desk.spot(lambda spot: key in spot.field).field
    field[key] = field[key] ^ 1


def _became(key: str, desk: Desk) -> None:
    """A number that was given is always the same, or means nothing any more."""
    spot = desk.number(is_whole)
    _without(spot.field, *spot.field.keys() - {"type", "about", "byte_order", "#"})
    spot.field[key] = desk.chance.choice([0, 1])
    _unmentioned(spot)


def constant_given(desk: Desk) -> None:
    spot = desk.spot(lambda spot: is_constant(spot.field))
    _without(spot.field, "always", "reserved", "count")
    _unmentioned(spot)


def constant_unchecked(desk: Desk) -> None:
    field = desk.spot(lambda spot: "always" in spot.field).field
    field["reserved"] = field.pop("always")


def unused_checked(desk: Desk) -> None:
    field = desk.spot(lambda spot: "reserved" in spot.field and "count" not in spot.field).field
    field["always"] = field.pop("reserved")


FIELD_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    **{each.replace("-", " became "): partial(_retyped, each) for each in RETYPED},
    **{
        f"a field in {where} removed": partial(_taken_away, where)
        for where in ("front", "middle", "end")
    },
    **{
        f"{name} added in {where}": partial(_put_in, where, what)
        for where in ("front", "middle", "end")
        for name, what in ADDED.items()
    },
    **{
        f"a field {name}, {'said' if said else 'unsaid'}": partial(change, said)
        for name, change in {
            "renamed": _renamed,
            "renamed and moved": _renamed_and_moved,
            "renamed and retyped": _renamed_and_retyped,
        }.items()
        for said in (True, False)
    },
    "a counter retyped": counter_retyped,
    "byte order of a field": order_of_bytes,
    "byte order of a field said": order_of_bytes_said,
    "byte order of all": order_of_all_bytes,
    "neighbouring fields swapped": neighbours_swapped,
    "a field put last": first_put_last,
    "an optional field added": optional_added,
    "a field became optional": became_optional,
    "an optional field became sure": partial(_sure, False),
    "no field is optional": partial(_sure, True),
    "a field replaced by another": replaced,
    "a field split in two": split_in_two,
    "two fields joined": joined,
    "a constant changed": partial(_constant_changed, "always"),
    "an unused field written otherwise": partial(_constant_changed, "reserved"),
    "a field became a constant": partial(_became, "always"),
    "a field became unused": partial(_became, "reserved"),
    "a constant became a field": constant_given,
    "a constant is not checked": constant_unchecked,
    "an unused field is checked": unused_checked,
}
