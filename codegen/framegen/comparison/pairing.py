"""Pairings: which of the names in one edition are which in the other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


@dataclass(frozen=True)
class Pairing:
    """The old names, each with its new one; `guessed` are the old names that only seem renamed.

    What is removed has no new name, and what is added no old one.
    """

    to_new: Mapping[str, str]
    guessed: frozenset[str]
    removed: tuple[str, ...]
    added: tuple[str, ...]

    @cached_property
    def to_old(self) -> Mapping[str, str]:
        """The new names, each with its old one."""
        return {new: old for old, new in self.to_new.items()}

    @property
    def flipped(self) -> Pairing:
        """The same from the new edition to the old."""
        guessed = frozenset(self.to_new[name] for name in self.guessed)
        return Pairing(self.to_old, guessed, self.added, self.removed)


Was: TypeAlias = "Mapping[str, Sequence[str]]"


def paired(
    old: Mapping[str, object],
    new: Mapping[str, object],
    was: Was,
    old_was: Was = MappingProxyType({}),
) -> Pairing:
    """Pair names: as `was` says, by which names say theirs of old; or the same; or in place.

    Both mappings give the place of each name: whatever can be told of it but for its name. A name
    that is gone and one that came are taken for the same thing where their places are equal, and
    that is a guess. `old_was` is what the old edition says: it is the newer one where a change is
    taken back.
    """
    to_new = _told(old, new, was)
    for back, name in _told(new, old, old_was).items():
        if name not in to_new and back not in to_new.values():
            to_new[name] = back
    taken = {*to_new.values()}
    for name in old:
        if name in new and name not in to_new and name not in taken:
            to_new[name] = name
            taken.add(name)
    guessed = set[str]()
    for name in old:
        if name not in to_new and old[name] is not None:
            come = (each for each in new if each not in taken and new[each] == old[name])
            found = next(come, None)
            if found is not None:
                to_new[name] = found
                taken.add(found)
                guessed.add(name)
    return Pairing(
        {name: to_new[name] for name in old if name in to_new},
        frozenset(guessed),
        tuple(name for name in old if name not in to_new),
        tuple(name for name in new if name not in taken),
    )


def _told(old: Mapping[str, object], new: Mapping[str, object], was: Was) -> dict[str, str]:
    """Return the old names of which `was` says what they became.

    A name that both editions have says of its past what older editions called it, unless what had
    it has another name now.
    """
    to_new: dict[str, str] = {}
    waiting = {name: [each for each in was.get(name, ()) if each in old] for name in new}
    free = [name for name in new if name not in old]
    while free:
        name = free.pop(0)
        before = next((each for each in waiting[name] if each not in to_new), None)
        if before is not None:
            to_new[before] = name
            if before in new:
                free.append(before)
    return to_new
