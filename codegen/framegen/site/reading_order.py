"""The order in which pages are read, and what would stand at the place of another page."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.site.guides.guide import Guide
    from framegen.site.page import Page
    from framegen.site.sidebar import Link


def beside(links: Sequence[Link], page: Page) -> tuple[Link | None, Link | None]:
    """Return the links before and after that of a page; None where there is none."""
    at = next((at for at, link in enumerate(links) if link.path == page.path), None)
    if at is None:
        return None, None
    return (links[at - 1] if at else None, links[at + 1] if at + 1 < len(links) else None)


def refuse_twins(guides: Iterable[Guide], pages: Iterable[Page]) -> None:
    """Refuse a guide that would replace another page, or be replaced by it. Raises Unusable."""
    counts = Counter(page.path for page in pages)
    for guide in guides:
        if counts[guide.page] > 1:
            raise Unusable(
                f"docs/{visible(guide.path)} would become {visible(guide.page)}, which is another "
                "page",
                hint="give it another name",
            )
