"""Effects on conversation."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.comparison.effect import Effect
    from framegen.comparison.pair import Pair


def conversation_effects(pair: Pair) -> Iterator[Effect]:
    """Yield the effects on conversation."""
    yield from ()
