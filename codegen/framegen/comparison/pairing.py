"""Pairings: which of the names in one edition are which in the other."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

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


def paired(
    old: Mapping[str, object], new: Mapping[str, object], was: Mapping[str, Sequence[str]]
) -> Pairing:
    """Pair names: as `was` says, by which new names say theirs of old; or the same; or in place.

    Both mappings give the place of each name: whatever can be told of it but for its name. A name
    that is gone and one that came are taken for the same thing where their places are equal, and
    that is a guess.
    """
    to_new: dict[str, str] = {}
    for name in new:
        before = next((each for each in was.get(name, ()) if each in old), None)
        # What has its name already says there from what older editions called it.
        if before is not None and name not in old and before not in to_new:
            to_new[before] = name
    to_new |= {
        name: name for name in old if name in new and name not in {*to_new, *to_new.values()}
    }
    taken, guessed = set(to_new.values()), set[str]()
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
