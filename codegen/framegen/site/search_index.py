"""The index of the search: all that can be found, and where it stands."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.site.guide import Guide
    from framegen.targets.docs.reference import ReferenceView


def search_index(_references: Sequence[ReferenceView], _guides: Sequence[Guide]) -> list[Any]:
    """Return every entry of the index."""
    return []
