"""Effects on programs."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Effect
    from framegen.comparison.pair import Pair


def program_effects(pair: Pair) -> Iterator[Effect]:
    """Yield the effects on programs."""
    yield from ()
