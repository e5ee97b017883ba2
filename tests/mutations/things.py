"""A second opinion on who is who in two editions: by `was`, by name, or by place.

It is written apart from `framegen.comparison`, and uses nothing of it.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from tests.factories import Data
from tests.mutations.authors import Names, kinds_of, names_of, parts_of
from tests.mutations.mutations import Editions


@dataclass(frozen=True)
class Match:
    """Old names with new ones; those that only stand in the same place are guessed."""

    to_new: Mapping[str, str]
    guessed: frozenset[str]


def match(names: Names, old: Mapping[str, Any], new: Mapping[str, Any]) -> Match:
    """Match names: what the author told of, and then what looks alike."""
    told = {name: other for name, other in names.to_new.items() if name not in names.unsaid}
    told |= {name: name for name in old if name in new and name not in {*told, *told.values()}}
    guessed: dict[str, str] = {}
    for name, looks in old.items():
        taken = {*told.values(), *guessed.values()}
        alike = [each for each in new if new[each] == looks and each not in taken]
        if name not in told and alike and looks is not None:
            guessed[name] = alike[0]
    return Match({**told, **guessed}, frozenset(guessed))


def match_messages(editions: Editions) -> Match:
    author = editions.author
    ends = author.ends.to_new
    same = {name: name for name in author.new["endpoints"]}
    only = len(kinds_of(author.old)) == len(kinds_of(author.new)) == 1
    old, new = (
        {name: _looks(spec, message, there, only) for name, message in spec["messages"].items()}
        for spec, there in ((author.old, ends), (author.new, same))
    )
    return match(author.messages, old, new)


def _looks(spec: Data, message: Data, ends: Mapping[str, str], only: bool) -> Any:
    """Return what can be told of a message but for its name: ids, ends, kind and layout."""
    sender, _, receiver = message["direction"].partition(" -> ")
    if sender not in ends or receiver not in ends:
        return None
    said = message.get("id")
    ids = tuple(said.values()) if isinstance(said, dict) else said
    kind = only or _bare(parts_of(spec, message), spec["byte_order"])
    layout = _layout(message["fields"]).values()
    return (ids, ends[sender], ends[receiver], kind, tuple(layout))


def _bare(parts: Data, order: str) -> str:
    """Return what a kind of frame looks like without any name."""
    names = [*parts]
    return repr(
        [
            (
                *(part.get(key) for key in ("is", "bytes", "type", "method", "sent")),
                part.get("byte_order", order) if "type" in part else None,
                [names.index(each) for each in part.get("counts", part.get("covers", ()))],
            )
            for part in parts.values()
        ]
    )


def match_fields(old: Data, new: Data) -> Match:
    """Match the fields of a message, of an element, or of an envelope and a message."""
    found = match(names_of(old, new), _layout(old), _layout(new))
    # There is one address at most, and one counter.
    to_new = dict(found.to_new)
    for kind in ("address", "counter"):
        one, other = (
            [name for name, each in fields.items() if each.get("is") == kind]
            for fields in (old, new)
        )
        if one and other:
            to_new[one[0]] = other[0]
    return Match(to_new, found.guessed)


def match_bits(old: Data, new: Data, key: str) -> Match:
    """Match named values, by their number, or bits, by where they are."""
    places = [{name: str(each[key]) for name, each in things.items()} for things in (old, new)]
    return match(names_of(old, new), *places)


def _layout(fields: Data) -> dict[str, Any]:
    """Return where each field is, and of which type; an address and a counter look like nothing."""
    at, found = 0, dict[str, Any]()
    for name, field in fields.items():
        if "is" in field:
            found[name] = None
            continue
        found[name] = at, _type(name, field, fields)
        at += size_of(field)
    return found


def _type(name: str, field: Data, fields: Data) -> Any:
    if "fields" in field:
        return "list", tuple(_layout(field["fields"]).values())
    constant = next((key for key in ("always", "reserved") if key in field), None)
    count = field.get("count")
    if constant:
        return constant, field["type"], field[constant], count
    varies = "counted_by" in field or "sized_by" in field
    if int(field["type"][1:]) % 8:
        return "packed", field["type"], count
    if "text" in field and not varies:
        return "text", count
    if varies or count is not None:
        return "list", ((0, (field["type"], "number")),)
    both = ((key, each) for key in ("counted_by", "sized_by") for each in fields.values())
    counts = [key for key, each in both if each.get(key) == name]
    return field["type"], (counts or ["number"])[0]


def size_of(field: Data) -> int:
    """Return the size of a field in bytes; of a list that varies, of its fewest elements."""
    inner = sum(map(size_of, field.get("fields", {}).values()))
    size = 8 * inner if "fields" in field else int(field["type"][1:])
    varies = "counted_by" in field or "sized_by" in field
    return size * int(str(field.get("count", 0 if varies else 1)).partition("..")[0]) // 8


def arguments_of(fields: Data) -> Data:
    counting = {each.get(key) for each in fields.values() for key in ("counted_by", "sized_by")}
    unsaid = (
        *counting,
        *(name for name, each in fields.items() if {"always", "reserved"} & {*each}),
    )
    return {name: each for name, each in fields.items() if name not in unsaid}


def worked_out(fields: Data, values: Mapping[str, Any]) -> dict[str, int]:
    """Return what stands in a frame though nobody gives it: how long a list is, and constants."""
    found: dict[str, int] = {}
    for name, field in fields.items():
        if "always" in field:
            found[name] = int(str(field["always"]), 0)
        if "counted_by" in field:
            found[field["counted_by"]] = len(values[name])
        if "sized_by" in field:
            one = {key: value for key, value in field.items() if key not in ("count", "sized_by")}
            one.pop("counted_by", None)
            found[field["sized_by"]] = len(values[name]) * size_of(one)
    return found
