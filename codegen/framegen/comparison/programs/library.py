"""The library: what becomes of each name that a program may use."""

from __future__ import annotations

import re
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.comparison.effect import Effect
from framegen.comparison.programs.moves import Moves
from framegen.comparison.programs.origins import origins, requests
from framegen.comparison.programs.types import gives, takes

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.pair import Pair
    from framegen.comparison.programs.origins import Origin
    from framegen.comparison.surface import Argument, Entry, Surface
    from framegen.reading.yamltree import KeyPath

_DOTTED = re.compile(r"[A-Za-z_][\w.]*")
_SELF = re.compile(r"\bself\.(\w+)")
_QUOTED = re.compile(r"'[^']*'")
# What addresses and answers of devices bring with them.
_OF_FRAMES = re.compile(r"(Async)?(OneDevice|AllDevices|Controller|Device)\b|Reason\b")
_ASYNC = re.compile(r"\bAsync(?=Controller|OneDevice|AllDevices|Motion)")


@dataclass(eq=False)
class Libraries:
    """The libraries of two editions, and which name of the one is which of the other."""

    pair: Pair
    old: Surface
    new: Surface
    moves: Moves = field(init=False)

    def __post_init__(self) -> None:
        self.moves = Moves(self.pair)

    @cached_property
    def old_origins(self) -> dict[str, Origin]:
        """What each name of the old library is called after."""
        return origins(self.pair.old.model)

    @cached_property
    def new_origins(self) -> dict[str, Origin]:
        """What each name of the new library is called after."""
        return origins(self.pair.new.model)

    @cached_property
    def _named(self) -> dict[Origin, str]:
        named: dict[Origin, str] = {}
        for name, origin in self.new_origins.items():
            if name in self.new:
                named.setdefault(origin, name)
        return named

    @cached_property
    def now(self) -> dict[str, str | None]:
        """Each name of the old library with what it is called in the new; None for what is gone."""
        found: dict[str, str | None] = {}
        for name in self.old:
            found[name] = self._now(name, found)
        return found

    def _now(self, name: str, before: dict[str, str | None]) -> str | None:
        origin = self.old_origins.get(name)
        owner, dot, last = name.rpartition(".")
        if origin is None:
            # Modules never change their names.
            around = before.get(owner, owner)
            there = None if around is None else f"{around}{dot}{last}"
            return there if there in self.new else None
        moved = self.moves.origin(origin)
        found = None if moved is None else self._named.get(moved)
        if found is not None:
            return found
        other = self.new_origins.get(name)
        # Of the class of some elements, the list that is the first to have them may be another.
        same = other is not None and other.role == origin.role and origin.role == "element"
        inner = before.get(owner, None) == owner and self.old_origins.get(owner) is not None
        inside = inner and self.old_origins[owner].role == "element" and name in self.new
        return name if (same and name in self.new) or inside else None

    def paths(self, name: str) -> tuple[KeyPath, KeyPath | None]:
        """Return what a name of the old library is called after in both editions."""
        origin = self._origin(name, self.old_origins)
        if origin is None:
            path = self._shared(name, self.pair.old.spec.frames)
            return path, self._shared(name, self.pair.new.spec.frames)
        return origin, self.moves.path(origin)

    def new_path(self, name: str) -> KeyPath:
        """Return what a name of the new library is called after."""
        origin = self._origin(name, self.new_origins)
        return self._shared(name, self.pair.new.spec.frames) if origin is None else origin

    @staticmethod
    def _origin(name: str, known: dict[str, Origin]) -> KeyPath | None:
        while name:
            if name in known:
                return known[name].path
            name = name.rpartition(".")[0]
        return None

    @staticmethod
    def _shared(name: str, frames: object) -> KeyPath:
        if name in ("RefusedError", "FailureError"):
            return ("messages",)
        if name.startswith("Direction"):
            return ("endpoints",)
        return (("frames",) if frames else ("frame",)) if _OF_FRAMES.match(name) else ("protocol",)

    def attribute(self, beside: str, found: re.Match[str]) -> str:
        """Return `self.name` in the class of an old name, as the new library spells it."""
        now = self.now.get(f"{beside.rpartition('.')[0]}.{found[1]}")
        return found[0] if now is None else f"self.{now.rpartition('.')[2]}"

    def spelt(self, text: str) -> str:
        """Return a type or a value of the old library as the new one spells it."""

        def one(found: re.Match[str]) -> str:
            return self.now.get(found[0]) or found[0]

        quoted = _QUOTED.search(text)
        return text if quoted else _DOTTED.sub(one, text)


def library_effects(libraries: Libraries) -> Iterator[Effect]:
    """Yield what becomes of each name of the old library, and then the names that are new."""
    seen: set[tuple[object, ...]] = set()
    for effect in (*_lost(libraries), *_gained(libraries)):
        # What is true of one client is true of the others.
        text = _ASYNC.sub("", effect.text)
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
    for name, entry in libraries.new.entries.items():
        owner = name.rpartition(".")[0]
        is_new = name not in known and (owner in known or owner in ("", "messages"))
        role = libraries.new_origins[name].role if name in libraries.new_origins else ""
        told = _ASYNC.search(name) or role in ("mask", "command", "way", "union")
        if is_new and not told and not name.startswith(("Device.on_", "strategies.")):
            path = libraries.new_path(name)
            yield Effect("programs", "added", None, path, f"`{name}` is new", breaks=False)


def _changed(
    libraries: Libraries, name: str, now: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    """Yield how what a name stands for has changed: in a word, and in a sentence."""
    spelt = libraries.spelt
    if old.kind != new.kind:
        yield "type", f"`{now}` is a {new.kind} now; it was a {old.kind}"
        return
    if name.startswith("Device.on_"):
        if not {*spelt(old.type).split(" | ")} <= {*new.type.split(" | ")}:
            yield "result", f"`{now}()` may return {new.type}; it might return {old.type}"
    elif not gives(spelt(old.type), new.type, libraries.new):
        outcome, does = ("result", "returns") if old.kind == "function" else ("type", "is")
        did = "it returned" if old.kind == "function" else "it was"
        yield outcome, f"`{now}` {does} {new.type}; {did} {old.type}"
    if old.kind == "property":
        read = _SELF.sub(lambda each: libraries.attribute(name, each), old.value)
        if read != new.value:
            yield "meaning", f"`{now}` is {new.value}; it was {read}"
    elif spelt(old.value) != new.value and not name.startswith("Direction."):
        yield "value", f"`{now}` is {new.value}; it was {old.value}"
    if old.arguments is not None and new.arguments is not None:
        problems = [*_arguments(libraries, name, old, new)]
        if problems:
            said = "; ".join(text for _, text in problems)
            yield problems[0][0], f"`{now}()`: {said}"
            return
    elif old.arguments is not None:
        yield "arguments", f"`{now}()` cannot be called"
    positions = [_argument_now(libraries, name, each) for each in old.positions]
    there = [each for each in positions if each is not None]
    if len(there) == len(positions) and [*new.positions[: len(there)]] != there:
        yield "order", f"`{now}` is matched as ({_listed(new.positions)})"


def _arguments(
    libraries: Libraries, name: str, old: Entry, new: Entry
) -> Iterator[tuple[str, str]]:
    """Yield what calls of a function break on, but for names that changed: these are told once."""
    assert old.arguments is not None
    assert new.arguments is not None
    theirs = {each.name: each for each in new.arguments}
    pairs: list[tuple[Argument, Argument]] = []
    gone = False
    for each in old.arguments:
        now = _argument_now(libraries, name, each.name)
        if now is None or now not in theirs:
            gone = True
            # A field that is gone is told where it was an attribute.
            if now is not None or not _is_field(libraries, name, each.name):
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
        given = _listed(each.name for each in old.arguments)
        yield "order", f"takes ({_listed(theirs)}) now; it took ({given})"


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
    if not takes(spelt, new.type) and not _is_field_of_other_type(libraries, function, old.name):
        yield "type", f"`{new.name}` takes {new.type}; it took {old.type}"


def _field_name(libraries: Libraries, function: str, argument: str) -> str:
    """Return the attribute that an argument becomes."""
    if "." not in function:
        return f"{function}.{argument}"
    method = function.rpartition(".")[2]
    return f"{requests(libraries.pair.old.model).get(method, '')}.{argument}"


def _argument_now(libraries: Libraries, function: str, argument: str) -> str | None:
    name = _field_name(libraries, function, argument)
    if name not in libraries.now:
        return argument
    now = libraries.now[name]
    return None if now is None else now.rpartition(".")[2]


def _is_field(libraries: Libraries, function: str, argument: str) -> bool:
    return _field_name(libraries, function, argument) in libraries.now


def _is_field_of_other_type(libraries: Libraries, function: str, argument: str) -> bool:
    name = _field_name(libraries, function, argument)
    now = libraries.now.get(name)
    if now is None:
        return False
    return libraries.spelt(libraries.old[name].type) != libraries.new[now].type


def _listed(names: object) -> str:
    return ", ".join(names)  # type: ignore[call-overload,no-any-return]


def _effect(outcome: str, old: KeyPath | None, new: KeyPath | None, text: str) -> Effect:
    return Effect("programs", outcome, old, new, text)
