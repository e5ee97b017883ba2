"""Both libraries of two editions, and what the ends of a line make of each other's frames."""

import atexit
from collections.abc import Iterator
from contextlib import ExitStack
from functools import cache, cached_property
from types import ModuleType
from typing import Literal

from framegen.comparison.edition import Edition
from framegen.comparison.effect import Witness
from framegen.comparison.pair import Pair
from framegen.comparison.wire import Trial, Trials, trials_of

from tests.contract.comparison.oracle import Oracle
from tests.factories import Data, library, library_files
from tests.mutations.authors import edition_of
from tests.mutations.mutations import Editions

Sender = Literal["old", "new"]
SENDERS: tuple[Sender, Sender] = ("old", "new")
# Libraries of the specs as they are; they stay until the end, and are few.
_UNTIL_THE_END = ExitStack()
atexit.register(_UNTIL_THE_END.close)


def library_of(edition: Edition, name: str, until: ExitStack) -> ModuleType:
    data: Data = edition.compiled.tree.data
    named = edition_of({**data, "protocol": {**data["protocol"], "name": name}}, name)
    assert named is not None
    return until.enter_context(library(library_files(named.compiled)))


@cache
def _before(edition: Edition) -> ModuleType:
    return library_of(edition, f"before_{id(edition)}", _UNTIL_THE_END)


class Talk:
    """Two editions, their libraries, and a judge for each sender."""

    def __init__(self, editions: Editions, until: ExitStack) -> None:
        self.editions = editions
        self.old = self._made(editions.old, until)
        self.new = self._made(editions.new, until)
        self.pair = Pair(editions.old, editions.new)
        self.oracles = {
            "old": Oracle(editions, self.old, self.new, "old"),
            "new": Oracle(editions.turned, self.new, self.old, "new"),
        }

    @staticmethod
    def _made(edition: Edition, until: ExitStack) -> ModuleType:
        return _before(edition) if edition.label == "old" else library_of(edition, "after", until)

    @cached_property
    def tried(self) -> list[Trials]:
        return [trial.found_in(frames) for trial, frames in self._frames]

    @cached_property
    def _frames(self) -> list[tuple[Trial, list[tuple[Witness, bool]]]]:
        """Each trial of each sender with its frames, which are tried once for all that asks."""
        trials = (trial for sender in SENDERS for trial in trials_of(self.pair, sender))
        return [(trial, [*trial.frames()]) for trial in trials]

    def frames(self) -> Iterator[tuple[Oracle, Trial, list[tuple[Witness, bool]]]]:
        """Yield each trial of each sender and its frames, with the judge of what it sends."""
        for trial, frames in self._frames:
            yield self.oracles[trial.sender], trial, frames

    def trials(self) -> Iterator[tuple[Oracle, Trial, Trials]]:
        """Yield each trial of each sender and its verdict, with the judge of what it sends."""
        for (trial, _), tried in zip(self._frames, self.tried, strict=True):
            yield self.oracles[trial.sender], trial, tried
