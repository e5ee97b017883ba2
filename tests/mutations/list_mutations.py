"""What authors do to lists and texts: how they are counted, how many, and of what."""

from collections.abc import Callable
from functools import partial
from typing import Any

from tests.factories import Data
from tests.mutations.desk import (
    Desk,
    Inapplicable,
    Spot,
    inserted,
    is_constant,
    is_counter,
    other_order,
    reordered,
    varies,
)


def _how(old: str, new: str, desk: Desk) -> None:
    """Count elements where bytes were counted, or the other way round."""
    field = desk.spot(lambda at: at.field.get(old) in at.fields and new not in at.field).field
    field[new] = field.pop(old)


def counted_by_the_frame(desk: Desk) -> None:
    """The length of the frame says how many there are, and no counter."""
    spot = desk.spot(lambda spot: varies(spot.field) and _length_of(desk, spot))
    _uncounted(spot)
    spot.field["sized_by"] = _length_of(desk, spot)


def _uncounted(spot: Spot) -> None:
    """Let nothing say how many there are."""
    named = {spot.field.pop(key, None) for key in ("counted_by", "sized_by")}
    for name in named & spot.fields.keys():
        del spot.fields[name]


def _counted_by_a_field(key: str, desk: Desk) -> None:
    """A counter says how many there are, where the length of the frame did."""
    spot = desk.spot(lambda spot: varies(spot.field) and _counts_itself(spot))
    del spot.field["sized_by"]
    name = desk.fresh("counter")
    spot.field[key] = name
    inserted(spot.fields, 0, name, {"type": "u8", "about": "How much there is."})
    _bounded(spot.field)


def _counts_itself(spot: Spot) -> bool:
    return "counted_by" not in spot.field and spot.field.get("sized_by") not in spot.fields


def _length_of(desk: Desk, spot: Spot) -> str:
    """Return the name of the length of its frame, empty where there is none."""
    parts = desk.parts_of(spot.message)
    return next((name for name, part in parts.items() if part["is"] == "length"), "")


def _bounded(field: Data) -> None:
    field["count"] = f"{_low(field)}..{_low(field) + 8}"


def _low(field: Data) -> int:
    return int(str(field.get("count", "0..")).partition("..")[0])


def _high(field: Data) -> int | None:
    high = str(field.get("count", "0..")).partition("..")[2]
    return int(high) if high else None


def _many(low_by: int, high_by: int | None, desk: Desk) -> None:
    field = desk.spot(lambda spot: varies(spot.field)).field
    low, high = _low(field) + low_by, _high(field)
    if high_by is None:
        field["count"] = f"{low}..{low + 3}" if high is None else f"{low}.."
    elif high is None:
        if not low_by:
            raise Inapplicable
        field["count"] = f"{low}.."
    else:
        field["count"] = f"{low}..{high + high_by}"


def became_fixed(desk: Desk) -> None:
    spot = desk.spot(lambda spot: varies(spot.field))
    _uncounted(spot)
    spot.field["count"] = max(2, _low(spot.field))


def became_varying(desk: Desk) -> None:
    spot = desk.spot(_is_fixed)
    if spot.inner or [*spot.fields][-1] != spot.name or spot.field.get("type", "u8")[1:] in "4 11":
        raise Inapplicable
    spot.field["count"] = f"0..{spot.field['count']}"
    if _length_of(desk, spot):
        spot.field["sized_by"] = _length_of(desk, spot)
    else:
        name = desk.fresh("counter")
        spot.field["counted_by"] = name
        inserted(spot.fields, 0, name, {"type": "u8", "about": "How many there are."})


def _is_fixed(spot: Spot) -> bool:
    return "count" in spot.field and not varies(spot.field) and not is_constant(spot.field)


def _fixed_count(by: int, desk: Desk) -> None:
    field = desk.spot(_is_fixed).field
    field["count"] = int(field["count"]) + by


def element_grown(desk: Desk) -> None:
    field = desk.spot(lambda spot: "fields" in spot.field).field
    at = desk.chance.randint(0, len(field["fields"]))
    inserted(field["fields"], at, desk.fresh("part"), {"type": "u8", "about": "It is new."})


def element_shrunk(desk: Desk) -> None:
    field = desk.spot(lambda spot: len(spot.field.get("fields", ())) > 1).field
    del field["fields"][desk.pick(field["fields"])]


def element_renamed(desk: Desk) -> None:
    desk.spot(lambda spot: "element" in spot.field).field["element"] = desk.fresh("Thing")


def element_bare(desk: Desk) -> None:
    """Elements of one number are numbers."""
    spot = desk.spot(lambda spot: "fields" in spot.field)
    inner = next((each for each in spot.field["fields"].values() if "count" not in each), None)
    if inner is None or is_constant(inner):
        raise Inapplicable
    del spot.field["fields"], spot.field["element"]
    spot.field["type"] = inner["type"]


def bare_became_elements(desk: Desk) -> None:
    """Numbers of a list are elements of one number each."""
    spot = desk.spot(lambda spot: (varies(spot.field) or _is_fixed(spot)) and _is_bare(spot.field))
    number = {"type": spot.field.pop("type"), "about": "The number."}
    for key in ("range", "byte_order", "unit", "scale", "values"):
        if key in spot.field:
            number[key] = spot.field.pop(key)
    spot.field.update(element=desk.fresh("Thing"), fields={"number": number})


def _is_bare(field: Data) -> bool:
    return "type" in field and "text" not in field and int(field["type"][1:]) % 8 == 0


def bare_retyped(desk: Desk) -> None:
    field = desk.spot(lambda spot: varies(spot.field) and _is_bare(spot.field)).field
    field["type"] = {"u8": "u16", "u16": "u8", "i16": "u16"}.get(field["type"], "u16")
    field.pop("range", None)


def bare_ranged(desk: Desk) -> None:
    field = desk.spot(lambda spot: _is_listed(spot) and _is_bare(spot.field)).field
    if field["type"][0] == "f":
        raise Inapplicable
    field["range"] = "1..100"


def _is_listed(spot: Spot) -> bool:
    return varies(spot.field) or _is_fixed(spot)


def _packed(desk: Desk) -> Any:
    return desk.spot(lambda at: _is_fixed(at) and int(at.field.get("type", "u8")[1:]) % 8).field


def packed_otherwise(desk: Desk) -> None:
    other_order(desk, _packed(desk))


def packed_ranged(desk: Desk) -> None:
    _packed(desk)["range"] = "0..5"


def text_became_bytes(desk: Desk) -> None:
    del desk.spot(lambda spot: "text" in spot.field and not spot.inner).field["text"]


def bytes_became_text(desk: Desk) -> None:
    spot = desk.spot(lambda spot: _is_listed(spot) and spot.field.get("type") == "u8")
    if "text" in spot.field:
        raise Inapplicable
    for key in ("range", "values", "unit", "scale"):
        spot.field.pop(key, None)
    spot.field["text"] = "ascii"


def counter_moved(desk: Desk) -> None:
    """What counts comes first, or behind another field."""
    spot = desk.spot(lambda spot: is_counter(spot) and len(spot.fields) > 2)
    names = [name for name in spot.fields if name != spot.name]
    at = desk.chance.randint(0, len(names) - 1)
    reordered(spot.fields, [*names[:at], spot.name, *names[at:]])


LIST_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "a list is sized by what counted it": partial(_how, "counted_by", "sized_by"),
    "a list is counted by what sized it": partial(_how, "sized_by", "counted_by"),
    "a list is counted by the frame": counted_by_the_frame,
    "a list is counted by a field": partial(_counted_by_a_field, "counted_by"),
    "a list is sized by a field": partial(_counted_by_a_field, "sized_by"),
    "a list: one more at least": partial(_many, 1, 0),
    "a list: one fewer at least": partial(_many, -1, 0),
    "a list: one more at most": partial(_many, 0, 1),
    "a list: one fewer at most": partial(_many, 0, -1),
    "a list: bounded, or not": partial(_many, 0, None),
    "a list of a fixed size": became_fixed,
    "a list of any size": became_varying,
    "a fixed list: one more": partial(_fixed_count, 1),
    "a fixed list: one fewer": partial(_fixed_count, -1),
    "an element: a field added": element_grown,
    "an element: a field removed": element_shrunk,
    "an element: renamed": element_renamed,
    "an element: a bare number": element_bare,
    "bare numbers became elements": bare_became_elements,
    "bare numbers retyped": bare_retyped,
    "bare numbers: a range": bare_ranged,
    "packed numbers: byte order": packed_otherwise,
    "packed numbers: a range": packed_ranged,
    "text became bytes": text_became_bytes,
    "bytes became text": bytes_became_text,
    "a counter moved": counter_moved,
}
