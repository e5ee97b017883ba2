"""The comparison of two editions: all effects, what explains them, and what is due."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.comparison.accepted import accept
from framegen.comparison.changes import changes
from framegen.comparison.conversation import conversation_effects
from framegen.comparison.kept import look_at_kept
from framegen.comparison.pair import Pair
from framegen.comparison.programs import program_effects
from framegen.comparison.reused import reuse_effects, without_shown
from framegen.comparison.unreserved import unreserved_effects
from framegen.comparison.wire import Trials, try_out, wire_effects

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.comparison.changes.change import Change
    from framegen.comparison.edition import Edition
    from framegen.comparison.effect import Effect
    from framegen.comparison.kept import Found
    from framegen.comparison.partners import Listed


@dataclass(frozen=True, eq=False)
class Comparison:
    """Two editions, held against each other; what is asked for is worked out once.

    `kept` are editions before the old one, whose boards and programs are in use as well.
    """

    old: Edition
    new: Edition
    kept: Sequence[Listed] = ()

    @cached_property
    def pair(self) -> Pair:
        """Who is who in the two editions."""
        return Pair(self.old, self.new)

    @cached_property
    def trials(self) -> list[Trials]:
        """What became of every message's frames, for each pair of ends."""
        return try_out(self.pair)

    @cached_property
    def found_in_kept(self) -> Found:
        """What the kept editions show, and the old one does not."""
        return look_at_kept(self.pair, self.kept)

    @cached_property
    def effects(self) -> list[Effect]:
        """What users notice on each axis, and what is used again; what is accepted says why."""
        found = [
            *wire_effects(self.pair, self.trials),
            *conversation_effects(self.pair),
            *program_effects(self.pair),
            *without_shown([*reuse_effects(self.pair), *self.found_in_kept.effects]),
            *unreserved_effects(self.pair),
        ]
        return [*accept(found, self.pair, self.changes)]

    @cached_property
    def changes(self) -> list[Change]:
        """What became of what, from the first to the last line of the new edition."""
        return changes(self.pair)
