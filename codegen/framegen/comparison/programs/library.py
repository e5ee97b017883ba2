"""The library: what becomes of each name that a program may use."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect
from framegen.comparison.programs.calls import call_problems, listed
from framegen.comparison.programs.types import gives

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.programs.libraries import Libraries
    from framegen.comparison.surface import Entry
    from framegen.reading.yamltree import KeyPath

_SELF = re.compile(r"\bself\.(\w+)")


def library_effects(libraries: Libraries) -> Iterator[Effect]:
    """Yield what becomes of each name of the old library, and then the names that are new."""
    seen: set[tuple[object, ...]] = set()
    for effect in (*_lost(libraries), *_gained(libraries)):
        # What is true of one client is true of the others.
        text = libraries.asyncio.sub("", effect.text)
        key = (effect.outcome, effect.path, text.rpartition(".")[2])
        if key not in seen:
            seen.add(key)
            yield replace(effect, text=text)


def _lost(libraries: Libraries) -> Iterator[Effect]:
    for name, entry in libraries.old.entries.items():
        owner, _, last = name.rpartition(".")
        if owner and libraries.now.get(owner, owner) is None:
            continue
        now = libraries.now[name]
        old, new = libraries.paths(name)
        if now is None:
            text = f"`{name}` is gone"
            if name in libraries.new and libraries.now.get(owner, owner) == owner:
                text = f"`{name}` is another thing now"
            yield _effect("removed", old, new, text)
            continue
        if now.rpartition(".")[2] != last:
            yield _effect("renamed", old, new, f"`{name}` is now `{now.rpartition('.')[2]}`")
        for outcome, text in _changed(libraries, name, now, entry, libraries.new[now]):
            yield _effect(outcome, old, new, text)


def _gained(libraries: Libraries) -> Iterator[Effect]:
    known = {each for each in libraries.now.values() if each is not None}
    for name in libraries.new:
        owner = name.rpartition(".")[0]
        is_new = name not in known and (owner in known or owner in ("", "messages"))
        role = libraries.new_origins[name].role if name in libraries.new_origins else ""
        told = libraries.asyncio.search(name) or role in ("mask", "command", "way", "union")
        if is_new and not told and not name.startswith(("Device.on_", "strategies.")):
            path = libraries.new_path(name)
            yield Effect("programs", "added", None, path, f"`{name}` is new", breaks=False)


def _changed(
    libraries: Libraries, name: str, now: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    """Yield how what a name stands for has changed: in a word, and in a sentence."""
    if old.kind != new.kind:
        yield "type", f"`{now}` is a {new.kind} now; it was a {old.kind}"
        return
    yield from _of_type(libraries, name, now, old, new)
    yield from _of_value(libraries, name, now, old, new)
    problems = [*call_problems(libraries, name, old, new)]
    if problems:
        yield problems[0][0], f"`{now}()`: {'; '.join(text for _, text in problems)}"
        return
    positions = [libraries.argument(name, each) for each in old.positions]
    there = [each for each in positions if each is not None]
    if len(there) == len(positions) and [*new.positions[: len(there)]] != there:
        yield "order", f"`{now}` is matched as ({listed(new.positions)})"


def _of_type(
    libraries: Libraries, name: str, now: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    was = libraries.spelt(old.type)
    if name.startswith("Device.on_"):
        # What a handler returns is given by the program.
        if not {*was.split(" | ")} <= {*new.type.split(" | ")}:
            yield "result", f"`{now}()` may return {new.type}; it might return {old.type}"
    elif not gives(was, new.type, libraries.new):
        if old.kind == "function":
            yield "result", f"`{now}` returns {new.type}; it returned {old.type}"
        else:
            yield "type", f"`{now}` is {new.type}; it was {old.type}"


def _of_value(
    libraries: Libraries, name: str, now: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    origin = libraries.old_origins.get(name)
    if old.kind != "property":
        if libraries.spelt(old.value) != new.value and not name.startswith("Direction."):
            yield "value", f"`{now}` is {new.value}; it was {old.value}"
    elif origin is not None and origin.role in ("signed", "absent"):
        # Which bits a property reads is told of its constant. What the library has for all messages
        # gives the same, however it is read.
        read = _SELF.sub(lambda each: libraries.attribute(name, each), old.value)
        if read != new.value:
            yield "meaning", f"`{now}` is {new.value}; it was {read}"


def _effect(outcome: str, old: KeyPath | None, new: KeyPath | None, text: str) -> Effect:
    return Effect("programs", outcome, old, new, text)
