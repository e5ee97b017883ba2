"""How changes are said: what a path is called, and what became of a value."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.spec import ListField
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from framegen.comparison.changes.things import Thing
    from framegen.language.spec import AnyField, Concern, Reserved
    from framegen.language.values import Method, Range
    from framegen.reading.yamltree import KeyPath

_NAMED = ("fields", "values", "bits")


def called(path: KeyPath) -> str:
    """Return a path as people say it, `ServoMove.time_ms`."""
    if path[:1] == ("messages",) and len(path) > 1:
        rest = path[2:]
        said: list[str | int] = [path[1]]
        while len(rest) > 1 and rest[0] in _NAMED:
            said.append(rest[1])
            rest = rest[2:]
        return dotted((*said, *rest))
    if path[:1] in (("frame",), ("frames",)) and path[-2:-1] == ("values",):
        return dotted((*path[:-2], path[-1]))
    return dotted(path)


def became(what: str, old: object, new: object) -> str:
    """Return what became of a value, in words: `unit ms became s`, `unit s is new`."""
    what = f"{what} " if what else ""
    if old in (None, "", ()):
        return f"{what}{new} is new"
    if new in (None, "", ()):
        return f"{what}{old} is gone"
    return f"{what}{old} became {new}"


def number_or_range(bounds: Range | None) -> str:
    """Return `3` for a range of one number, and else the range."""
    if bounds is None:
        return ""
    return str(bounds.low) if bounds.low == bounds.high else str(bounds)


def signature(method: Method) -> str:
    """Return a method as a spec has it: `read_positions(servo_ids) -> positions`."""
    result = f" -> {method.result}" if method.result else ""
    return f"{method.name}({', '.join(method.arguments)}){result}"


def described(field: Thing[AnyField]) -> str:
    """Return what a field is, shortly: `u16`, or `a list of Lamp`."""
    if isinstance(field.what, ListField):
        return f"a list of {field.what.element}"
    is_list = field.what.counted_by or field.what.sized_by or field.what.count
    return f"a list of {field.what.type}" if is_list else field.what.type


def reservation(reserved: Reserved) -> str:
    """Return what is reserved: `id 30 (lamp -> host), name LampDim`."""
    way = "" if reserved.direction is None else f" ({reserved.direction})"
    said = [] if reserved.id is None else [f"id {reserved.id}{way}"]
    if reserved.name:
        said.append(f"name {reserved.name}")
    return ", ".join(said)


def concern(concerned: Concern) -> str:
    """Return what an erratum or an open question is about: `LampRead, field lamp_id`."""
    said = [concerned.message]
    for key in ("fact", "parameter", "example", "field"):
        value = getattr(concerned, key)
        if value is not None:
            said.append(f"{key} {value}")
    return ", ".join(said)
