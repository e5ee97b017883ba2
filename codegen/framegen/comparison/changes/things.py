"""Things that specs say: which of those of one kind both editions have, which came, which went."""

from __future__ import annotations

from collections import defaultdict
from dataclasses import dataclass
from typing import TYPE_CHECKING, Generic, TypeVar

if TYPE_CHECKING:
    from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence

    from framegen.comparison.pairing import Pairing
    from framegen.reading.yamltree import KeyPath

T_co = TypeVar("T_co", covariant=True)
T = TypeVar("T")


@dataclass(frozen=True, slots=True)
class Thing(Generic[T_co]):
    """What one edition alone has."""

    path: KeyPath
    what: T_co


@dataclass(frozen=True, slots=True)
class Twin(Generic[T_co]):
    """What both editions have; `guessed` where only its place says that it is the same."""

    old_path: KeyPath
    new_path: KeyPath
    old: T_co
    new: T_co
    guessed: bool = False

    @property
    def is_renamed(self) -> bool:
        """Whether its name changed; an element of a list has a number, and no name."""
        return self.old_path[-1:] != self.new_path[-1:] and isinstance(self.old_path[-1], str)


@dataclass(frozen=True, slots=True)
class Things(Generic[T_co]):
    """All things of one kind; `moved` are mappings and lists that have theirs in another order."""

    twins: tuple[Twin[T_co], ...] = ()
    removed: tuple[Thing[T_co], ...] = ()
    added: tuple[Thing[T_co], ...] = ()
    moved: tuple[Twin[tuple[str, ...]], ...] = ()


def named(
    pairing: Pairing,
    old: Mapping[str, T],
    new: Mapping[str, T],
    old_path: KeyPath,
    new_path: KeyPath,
) -> Things[T]:
    """Return the things of two mappings, as a pairing of their names says."""
    to_new = {name: pairing.to_new[name] for name in old if pairing.to_new.get(name) in new}
    return _things(to_new, pairing.guessed, old, new, old_path, new_path)


def listed(
    old: Sequence[T],
    new: Sequence[T],
    old_path: KeyPath,
    new_path: KeyPath,
    keys: Iterable[Callable[[T], Hashable]],
) -> Things[T]:
    """Return the things of two lists: the same are those with an equal key, by the first first."""
    to_new: dict[int, int] = {}
    for key in keys:
        free = defaultdict[object, list[int]](list)
        for at, each in enumerate(new):
            if at not in to_new.values():
                free[key(each)].append(at)
        for at, each in enumerate(old):
            if at not in to_new and free[key(each)]:
                to_new[at] = free[key(each)].pop(0)
    there, here = dict(enumerate(old)), dict(enumerate(new))
    return _things(to_new, frozenset(), there, here, old_path, new_path)


def joined(several: Iterable[Things[T]]) -> Things[T]:
    """Return the things of one kind from all places where there are some."""
    twins: list[Twin[T]] = []
    removed: list[Thing[T]] = []
    added: list[Thing[T]] = []
    moved: list[Twin[tuple[str, ...]]] = []
    for each in several:
        twins += each.twins
        removed += each.removed
        added += each.added
        moved += each.moved
    return Things(tuple(twins), tuple(removed), tuple(added), tuple(moved))


_Key = TypeVar("_Key", str, int)


def _things(
    to_new: Mapping[_Key, _Key],
    guessed: frozenset[_Key] | frozenset[str],
    old: Mapping[_Key, T],
    new: Mapping[_Key, T],
    old_path: KeyPath,
    new_path: KeyPath,
) -> Things[T]:
    taken = set(to_new.values())
    kept, order = (
        [to_new[key] for key in old if key in to_new],
        [key for key in new if key in taken],
    )
    before, after = (tuple(map(str, each)) for each in (kept, order))
    return Things(
        tuple(
            Twin((*old_path, key), (*new_path, there), old[key], new[there], key in guessed)
            for key, there in to_new.items()
        ),
        tuple(Thing((*old_path, key), old[key]) for key in old if key not in to_new),
        tuple(Thing((*new_path, key), new[key]) for key in new if key not in taken),
        (Twin(old_path, new_path, before, after),) if before != after else (),
    )
