"""The libraries of two editions, and which name of the one is which of the other."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.comparison.programs.moves import Moves
from framegen.comparison.programs.origins import CLIENT, DEVICES, origins, requests
from framegen.model.client_names import client_names

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.comparison.pair import Pair
    from framegen.comparison.programs.origins import Origin
    from framegen.comparison.surface import Surface
    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath

_DOTTED = re.compile(r"[A-Za-z_][\w.]*")
_QUOTED = re.compile(r"'[^']*'")
# What addresses and answers of devices bring with them.
_OF_FRAMES = re.compile(r"(Async)?(OneDevice|AllDevices|Device)\b|UnknownFrame\b")


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
    def asyncio(self) -> re.Pattern[str]:
        """What is in front of the names for asyncio, which are those for threads but for this."""
        clients = (client_names(each.spec).threads for each in (self.pair.old, self.pair.new))
        return re.compile(rf"\bAsync(?=(?:{'|'.join([*clients, *DEVICES, 'Motion'])})\b)")

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
        inner = before.get(owner) == owner and self.old_origins.get(owner) is not None
        inside = inner and self.old_origins[owner].role == "element" and name in self.new
        return name if (same and name in self.new) or inside else None

    def paths(self, name: str) -> tuple[KeyPath, KeyPath | None]:
        """Return what a name of the old library is called after in both editions."""
        origin = self._origin(name, self.old_origins)
        if origin is None:
            old, new = self.pair.old.spec, self.pair.new.spec
            return self._shared(name, old, old), self._shared(name, old, new)
        return origin, self.moves.path(origin)

    def new_path(self, name: str) -> KeyPath:
        """Return what a name of the new library is called after."""
        origin = self._origin(name, self.new_origins)
        new = self.pair.new.spec
        return self._shared(name, new, new) if origin is None else origin

    @staticmethod
    def _origin(name: str, known: dict[str, Origin]) -> KeyPath | None:
        owner = name
        while owner:
            # What a client has beside methods of messages does not follow from its name.
            if owner in known and (owner == name or known[owner].path != CLIENT):
                return known[owner].path
            owner = owner.rpartition(".")[0]
        return None

    @staticmethod
    def _shared(name: str, own: Spec, spec: Spec) -> KeyPath:
        """Return what brings a name of the library of one spec, in that or in another."""
        if name in ("RefusedError", "FailureError"):
            return ("messages",)
        if name.startswith("Direction"):
            return ("endpoints",)
        of_client = name.partition(".")[0] in client_names(own).classes
        if of_client or _OF_FRAMES.match(name):
            return ("frames",) if spec.frames else ("frame",)
        return ("protocol",)

    def attribute(self, beside: str, found: re.Match[str]) -> str:
        """Return `self.name` in the class of an old name, as the new library spells it."""
        now = self.now.get(f"{beside.rpartition('.')[0]}.{found[1]}")
        return found[0] if now is None else f"self.{now.rpartition('.')[2]}"

    def spelt(self, text: str) -> str:
        """Return a type or a value of the old library as the new one spells it."""

        def one(found: re.Match[str]) -> str:
            owner, dot, last = found[0].rpartition(".")
            if dot and found[0] not in self.now:
                # What a class inherits is called as it is in the runtime.
                return f"{self.now.get(owner) or owner}.{last}"
            return self.now.get(found[0]) or found[0]

        quoted = _QUOTED.search(text)
        return text if quoted else _DOTTED.sub(one, text)

    def argument(self, function: str, name: str) -> str | None:
        """Return what an argument is called now; None where it is gone."""
        field_name = self.field_of(function, name)
        if field_name not in self.now:
            return name
        now = self.now[field_name]
        return None if now is None else now.rpartition(".")[2]

    def field_of(self, function: str, argument: str) -> str:
        """Return the attribute that an argument becomes, if it becomes one."""
        if "." not in function:
            return f"{function}.{argument}"
        return f"{self._requests.get(function.rpartition('.')[2], '')}.{argument}"

    @cached_property
    def _requests(self) -> Mapping[str, str]:
        return requests(self.pair.old.model)
