"""Calls: what those of a function break on, when its arguments change."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.comparison.programs.types import takes

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.comparison.programs.libraries import Libraries
    from framegen.comparison.surface import Argument, Entry


def call_problems(
    libraries: Libraries, name: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    """Yield what calls break on, in a word and in a sentence.

    Arguments that only have other names are left out: these are told of the attributes.
    """
    if old.arguments is None:
        return
    if new.arguments is None:
        yield "arguments", "is not called any more"
        return
    theirs = {each.name: each for each in new.arguments}
    pairs: list[tuple[Argument, Argument]] = []
    gone = False
    for each in old.arguments:
        now = libraries.argument(name, each.name)
        if now is None or now not in theirs:
            gone = True
            # A field that is gone is told where it was an attribute.
            if now is not None or libraries.field_of(name, each.name) not in libraries.now:
                yield "arguments", f"`{each.name}` is not taken any more"
            continue
        pairs.append((each, theirs[now]))
        yield from _argument(libraries, name, each, theirs[now])
    met = {other.name for _, other in pairs}
    needed = [each for each in new.arguments if each.name not in met and each.default is None]
    for each in needed:
        yield "arguments", f"`{each.name}` has to be given as well"
    placed = [other.name for one, other in pairs if one.kind == other.kind == "by place"]
    at = [each.name for each in new.arguments if each.kind == "by place"]
    moved = [each for each in at if each in placed] != placed
    if moved or (not gone and not needed and at[: len(placed)] != placed):
        given = listed(each.name for each in old.arguments)
        yield "order", f"takes ({listed(theirs)}) now; it took ({given})"


def _argument(
    libraries: Libraries, function: str, old: Argument, new: Argument
) -> Iterator[tuple[str, str]]:
    if old.kind == "by place" and new.kind == "by name":
        yield "arguments", f"`{new.name}` has to be named"
    if old.kind == "many" and new.kind != "many":
        yield "arguments", f"`{new.name}` takes one value; it took any number of them"
    if old.default is not None and new.default is None:
        yield "arguments", f"`{new.name}` has to be given"
    elif old.default is not None and new.default != old.default:
        yield "arguments", f"`{new.name}` is {new.default} by default; it was {old.default}"
    spelt = libraries.spelt(old.type)
    if not takes(spelt, new.type) and not _is_of_other_type(libraries, function, old.name):
        yield "type", f"`{new.name}` takes {new.type}; it took {old.type}"


def _is_of_other_type(libraries: Libraries, function: str, argument: str) -> bool:
    """Tell whether an argument is an attribute whose type changes, which is told there."""
    name = libraries.field_of(function, argument)
    now = libraries.now.get(name)
    return now is not None and libraries.spelt(libraries.old[name].type) != libraries.new[now].type


def listed(names: Iterable[str]) -> str:
    """Return names in a row."""
    return ", ".join(names)
