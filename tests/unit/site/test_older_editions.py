"""Older editions of a protocol: read from page to page, without a codec, and bounded."""

from __future__ import annotations

from itertools import pairwise

import pytest
from framegen.comparison.listing import edition_of
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable

from tests.in_turn import in_turn
from tests.unit.site.editions import FIRST, SECOND, Editions

# A length of four bytes, so that lists may be as long as they say.
WIDE = FIRST.replace("length, type: u8", "length, type: u32").replace(
    "lamp_count: {type: u8", "lamp_count: {type: u32"
)
BOTH = Editions(SECOND, (FIRST,))


def test_one_page_of_an_edition_leads_to_the_next() -> None:
    site = BOTH.site
    (older,) = site.collection.older
    paths = [page.path for page in older.pages]
    for before, after in pairwise(older.pages):
        next_link, previous = (
            site.navigation.neighbours(before)[1],
            site.navigation.neighbours(after)[0],
        )
        assert next_link is not None
        assert previous is not None
        assert (next_link.path, previous.path) == (after.path, before.path)
    assert site.navigation.neighbours(older.pages[0])[0] is None
    assert site.navigation.neighbours(older.pages[-1])[1] is None
    newest = {
        link.path
        for page in site.references[0].pages
        for link in site.navigation.neighbours(page)
        if link
    }
    assert newest.isdisjoint(paths)


def test_live_fields_are_on_messages_of_the_newest_edition() -> None:
    shown = {
        path: "live-data" in text
        for path, text in BOTH.rendered.items()
        if path.endswith(".html") and "/messages/" in path
    }
    assert {"/1.0.0/" not in path for path, live in shown.items() if live} == {True}
    assert {"/1.0.0/" in path for path, live in shown.items() if not live} == {True}


@in_turn("count", lambda: [40_000, 5_000_000_000])
def test_frames_that_no_memory_holds_are_refused(count: int) -> None:
    """They would be made to be compared."""
    text = WIDE.replace("count: 1..8", f"count: 1..{count}")
    size = r"[0-9]+"
    message = rf"released/lamps\.yaml: LampsSet has frames of up to {size} bytes, and no frame"
    with pytest.raises(Unusable, match=message):
        edition_of(Source("spec/released/lamps.yaml", text))


def test_long_frames_that_are_legal_are_not_refused() -> None:
    text = WIDE.replace("count: 1..8", "count: 1..32000")
    edition = edition_of(Source("spec/released/lamps.yaml", text))
    assert 64_000 < edition.model.messages["LampsSet"].largest <= 65_535
