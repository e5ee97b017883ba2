"""Partners: which spec of an earlier state of a project became which one of a later state."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.comparison.pair import Pair
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from framegen.comparison.edition import Edition


@dataclass(frozen=True, eq=False)
class Listed:
    """A spec that a state of the project has; it is read when it is first needed.

    `path` is for people, `file` its name in the folder of specs, and `name` that of its protocol,
    where it is known without reading.
    """

    path: str
    file: str
    read: Callable[[], Edition]
    name: str = ""

    @cached_property
    def edition(self) -> Edition:
        """The edition. Raises Unusable."""
        return self.read()

    @cached_property
    def protocol(self) -> str:
        """The name of its protocol; "" where it cannot be read."""
        if self.name:
            return self.name
        try:
            return self.edition.spec.protocol.name
        except Unusable:
            return ""


def partners(earlier: Sequence[Listed], later: Sequence[Listed]) -> dict[Listed, Listed]:
    """Return the later specs that have an earlier one, each with that.

    Protocols are the same by name, wherever their files are, or else by the file. If one earlier
    spec is left, it is the one whose messages a spec without a partner has: it was renamed.
    """
    found: dict[Listed, Listed] = {}
    for alike in (_both, _protocol, _file):
        for each in later:
            free = (other for other in earlier if other not in found.values())
            if each not in found and (same := next(filter(alike(each), free), None)) is not None:
                found[each] = same
    left = [each for each in earlier if each not in found.values()]
    if len(left) == 1:
        shared = {each: _shared(left[0], each) for each in later if each not in found}
        nearest = max(shared, key=shared.__getitem__, default=None)
        if nearest is not None and shared[nearest]:
            found[nearest] = left[0]
    return found


def _protocol(spec: Listed) -> Callable[[Listed], bool]:
    return lambda other: other.protocol == spec.protocol != ""


def _file(spec: Listed) -> Callable[[Listed], bool]:
    return lambda other: other.file == spec.file


def _both(spec: Listed) -> Callable[[Listed], bool]:
    return lambda other: _file(spec)(other) and _protocol(spec)(other)


def _shared(old: Listed, new: Listed) -> int:
    """Return how many messages two specs have in common."""
    if not old.protocol or not new.protocol:
        return 0
    return len(Pair(old.edition, new.edition).messages.to_new)
