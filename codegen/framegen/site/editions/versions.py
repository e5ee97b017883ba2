"""The versions of a protocol: its newest edition, those that were released, and what differs."""

from __future__ import annotations

from contextlib import contextmanager
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.comparison.comparison import Comparison
from framegen.comparison.edition import Edition
from framegen.comparison.pair import Pair
from framegen.comparison.report.view import View
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.compile import Compiled


@contextmanager
def blaming(edition: Edition) -> Iterator[None]:
    """Say which edition it is that something goes wrong with. Raises Unusable.

    Today's rules are not held against editions of old, and so they may be what cannot be shown.
    """
    try:
        yield
    except Unusable:
        raise
    except Exception as error:
        found = edition.compiled.tolerated
        if not found:
            raise
        first = found[0].render(edition.compiled.source)
        raise Unusable(
            f"{edition.label} cannot be shown: it has {pluralize(len(found), 'finding')} by "
            f"today's rules; the first is\n{first}",
            hint="where it cannot be mended, remove it: the history still tells of its version",
        ) from error


def newest_edition(compiled: Compiled) -> Edition:
    """Return the spec of a project as an edition."""
    return Edition(compiled.source.name, compiled, compiled.spec, compiled.model)


class Versions:
    """The editions of one protocol, the newest first; what is between them is worked out once."""

    def __init__(self, newest: Edition, released: Sequence[Edition] = ()) -> None:
        """Take the edition as it is now, and those that were released, the newest first."""
        self.newest = newest
        self.released = released
        self._views: dict[tuple[str, str], View] = {}
        self._pairs: dict[str, Pair] = {}

    @cached_property
    def unchanged(self) -> Edition | None:
        """The last release, if the newest edition says what it said."""
        last = next(iter(self.released), None)
        return last if last is not None and _says(last) == _says(self.newest) else None

    @cached_property
    def older(self) -> list[Edition]:
        """The released editions that have pages of their own."""
        return [each for each in self.released if each is not self.unchanged]

    @cached_property
    def editions(self) -> list[Edition]:
        """All editions, the newest first; one that was released as it is now comes once."""
        return [self.newest, *self.older]

    def waits(self, edition: Edition) -> bool:
        """Tell whether an edition has yet to be released, in a project that releases at all."""
        return edition is self.newest and self.unchanged is None and bool(self.released)

    def before(self, edition: Edition) -> Edition | None:
        """Return the edition that was released before another; None for the first."""
        return next(iter(self.editions[self.editions.index(edition) + 1 :]), None)

    def changes(self, edition: Edition) -> View | None:
        """Return what changed since the edition before; None for the first one."""
        before = self.before(edition)
        if before is None:
            return None
        key = before.label, edition.label
        if key not in self._views:
            with blaming(before), blaming(edition):
                view = View(Comparison(before, edition))
                # Worked out here, where it is known whose fault it is that it cannot be.
                _ = view.groups, view.verdicts, view.without_effect
                self._views[key] = view
        return self._views[key]

    def pair(self, older: Edition) -> Pair:
        """Return who is who in an older edition and in the newest."""
        if older.label not in self._pairs:
            with blaming(older):
                pair = Pair(older, self.newest)
                _ = pair.messages
                self._pairs[older.label] = pair
        return self._pairs[older.label]

    def folder(self, edition: Edition) -> str:
        """Return the folder of an edition, below that of the reference; "" for the newest."""
        return "" if edition is self.newest else f"{edition.version}/"


def _says(edition: Edition) -> str:
    """Return all that an edition says; in the same order, comments aside."""
    return repr(edition.compiled.tree.data)
