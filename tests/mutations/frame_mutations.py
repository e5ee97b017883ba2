"""What authors do to the frame: header, length, ids, address, counter and checksums."""

from collections.abc import Callable, Sequence
from functools import partial
from typing import Any

from tests.factories import Data
from tests.mutations.desk import Desk, Inapplicable, inserted, other_order, renamed_in, reordered


def _is(kind: str) -> Callable[[Data], Any]:
    return lambda part: part["is"] == kind


def _bytes(what: str, desk: Desk) -> None:
    parts, name = desk.part(_is("constant"))
    data = bytes.fromhex(parts[name]["bytes"])
    other = {"other": bytes([data[0] ^ 1]) + data[1:], "more": data + b"\x5a", "fewer": data[:-1]}
    if not other[what]:
        raise Inapplicable
    parts[name]["bytes"] = other[what].hex(" ").upper()


def spare_changed(desk: Desk) -> None:
    parts, name = desk.part(_is("reserved"))
    parts[name]["bytes"] = bytes(each ^ 1 for each in bytes.fromhex(parts[name]["bytes"])).hex(" ")


def _became(old: str, new: str, desk: Desk) -> None:
    parts, name = desk.part(_is(old))
    parts[name]["is"] = new


def _other_names(key: str, but: Sequence[str], desk: Desk) -> None:
    """One part more, or one fewer, is counted or covered."""
    parts, name = desk.part(lambda part: key in part)
    other = desk.pick(each for each in parts if parts[each]["is"] not in but)
    chosen = {*parts[name][key]} ^ {other}
    parts[name][key] = [each for each in parts if each in chosen]


def _wider(kind: str, desk: Desk) -> None:
    parts, name = desk.part(_is(kind))
    parts[name]["type"] = {"u8": "u16", "u16": "u8"}.get(parts[name]["type"], "u16")


def _other_order(kind: str, desk: Desk) -> None:
    parts, name = desk.part(lambda part: part["is"] == kind and part["type"] != "u8")
    other_order(desk, parts[name])


_ALIKE = {
    "u8": ("sum", "inverted sum", "negated sum", "xor", "crc-8/smbus"),
    "u16": ("crc-16/modbus", "crc-16/xmodem", "fletcher-8", "sum"),
}


def method_changed(desk: Desk) -> None:
    parts, name = desk.part(_is("checksum"))
    others = [each for each in _ALIKE.get(parts[name]["type"], ()) if each != parts[name]["method"]]
    parts[name]["method"] = desk.pick(others)


def checksum_added(desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    covers = [name for name in parts if parts[name]["is"] != "checksum"][1:]
    parts[desk.fresh("check")] = {"is": "checksum", "type": "u8", "method": "sum", "covers": covers}


def _without(kind: str, desk: Desk) -> None:
    parts, name = desk.part(_is(kind))
    del parts[name]
    for part in parts.values():
        for key in ("counts", "covers"):
            if key in part:
                part[key] = [each for each in part[key] if each != name]
    if kind == "length":
        raise Inapplicable


def _with(kind: str, desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    if any(part["is"] == kind for part in parts.values()):
        raise Inapplicable
    names = [*parts]
    at = desk.chance.randint(1, names.index("body") if "body" in names else 1)
    inserted(parts, at, desk.fresh(kind), {"is": kind, "type": "u8"})


def constant_added(desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    at = desk.chance.choice([1, len(parts)])
    inserted(parts, at, desk.fresh("mark"), {"is": "constant", "bytes": "7E"})


def _renamed(kind: str, said: bool, desk: Desk) -> None:
    parts, old = desk.part(_is(kind))
    new = desk.fresh("part")
    desk.rename_part(parts, old, new)
    if said:
        parts[new]["was"] = old


def parts_swapped(desk: Desk) -> None:
    parts = desk.pick(desk.kinds.values())
    names = [*parts]
    body = next(at for at, name in enumerate(names) if parts[name]["is"] == "body")
    at = desk.pick(range(body - 1))
    names[at], names[at + 1] = names[at + 1], names[at]
    reordered(parts, names)


def _addresses(low_by: int, high_by: int, desk: Desk) -> None:
    parts, name = desk.part(lambda part: part["is"] == "address" and "range" in part)
    low, _, high = parts[name]["range"].partition("..")
    parts[name]["range"] = f"{int(low) + low_by}..{int(high) + high_by}"


def addresses_bounded(desk: Desk) -> None:
    parts, name = desk.part(_is("address"))
    if "range" in parts[name]:
        del parts[name]["range"]
    else:
        parts[name]["range"] = "1..100"


def address_named(desk: Desk) -> None:
    parts, name = desk.part(_is("address"))
    taken = {each["value"] for each in parts[name].get("values", {}).values()}
    value = desk.pick({255, 254, 0, 7} - taken)
    named = {"value": value, "about": "It is new.", "silent": desk.chance.choice([True, False])}
    parts[name].setdefault("values", {})[desk.fresh("station")] = named


def _named(desk: Desk) -> Data:
    parts, name = desk.part(lambda part: part["is"] == "address" and part.get("values"))
    found: Data = parts[name]["values"]
    return found


def address_unnamed(desk: Desk) -> None:
    values = _named(desk)
    del values[desk.pick(values)]


def address_silenced(desk: Desk) -> None:
    value = desk.one_of(_named(desk))
    value["silent"] = not value.get("silent", False)


def address_moved(desk: Desk) -> None:
    values = _named(desk)
    value = values[desk.pick(values)]
    value["value"] = desk.pick({253, 252, 251} - {each["value"] for each in values.values()})


def _address_renamed(said: bool, desk: Desk) -> None:
    values = _named(desk)
    renamed_in(values, desk.pick(values), desk.fresh("known"), said=said)


def kinds_split(desk: Desk) -> None:
    """Each direction has a kind of frame of its own."""
    if "frames" in desk.spec:
        raise Inapplicable
    parts = desk.spec.pop("frame")
    ways = [*dict.fromkeys(message["direction"] for message in desk.messages.values())]
    names = {way: f"kind{number}" for number, way in enumerate(ways)}
    desk.spec["frames"] = {
        name: {part: {**what} for part, what in parts.items()} for name in names.values()
    }
    for message in desk.messages.values():
        message["frame"] = names[message["direction"]]


def kind_renamed(desk: Desk) -> None:
    if "frames" not in desk.spec:
        raise Inapplicable
    old, new = desk.pick(desk.spec["frames"]), desk.fresh("kind")
    renamed_in(desk.spec["frames"], old, new)
    for message in desk.messages.values():
        if message.get("frame") == old:
            message["frame"] = new


def baud(desk: Desk) -> None:
    desk.spec["link"]["baud"] *= 2


def parity(desk: Desk) -> None:
    desk.spec["link"]["parity"] = "odd"


FRAME_MUTATIONS: dict[str, Callable[[Desk], None]] = {
    "frame: other constant": partial(_bytes, "other"),
    "frame: longer constant": partial(_bytes, "more"),
    "frame: shorter constant": partial(_bytes, "fewer"),
    "frame: constant added": constant_added,
    "frame: spare bytes otherwise": spare_changed,
    "frame: spare bytes checked": partial(_became, "reserved", "constant"),
    "frame: constant not checked": partial(_became, "constant", "reserved"),
    "frame: parts swapped": parts_swapped,
    "length: counts others": partial(_other_names, "counts", ("body",)),
    **{
        f"{kind}: another type": partial(_wider, kind)
        for kind in ("length", "id", "address", "counter")
    },
    **{
        f"{kind}: byte order": partial(_other_order, kind)
        for kind in ("length", "address", "checksum")
    },
    **{f"{kind}: removed": partial(_without, kind) for kind in ("checksum", "address", "counter")},
    **{f"{kind}: added": partial(_with, kind) for kind in ("address", "counter")},
    **{
        f"{kind}: renamed, {'said' if said else 'unsaid'}": partial(_renamed, kind, said)
        for kind, said in (("address", True), ("address", False), ("counter", True))
    },
    **{
        f"{kind}: renamed": partial(_renamed, kind, False)
        for kind in ("length", "id", "body", "checksum")
    },
    "checksum: another method": method_changed,
    "checksum: covers others": partial(_other_names, "covers", ("body", "checksum")),
    "checksum: added": checksum_added,
    "address: range narrower": partial(_addresses, 1, -1),
    "address: range wider": partial(_addresses, 0, 1),
    "address: range given, or not": addresses_bounded,
    "address: one named": address_named,
    "address: a name removed": address_unnamed,
    "address: a name silent, or not": address_silenced,
    "address: a name moved": address_moved,
    "address: a name renamed, said": partial(_address_renamed, True),
    "address: a name renamed, unsaid": partial(_address_renamed, False),
    "kinds of frames split": kinds_split,
    "a kind of frame renamed": kind_renamed,
    "link: baud": baud,
    "link: parity": parity,
}
