"""Released editions in the site: a reference of each, and the way from each to the newest."""

import re
from collections.abc import Iterable
from functools import cache
from typing import Any

import pytest
from framegen.comparison.listing import edition_of
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable
from framegen.site.page import Page as SitePage

from tests.factories import data_in
from tests.in_turn import in_turn
from tests.mutations.prose import with_prose
from tests.mutations.spec_edits import edited
from tests.unit.site.editions import FIRST, SECOND, THIRD, Editions, three
from tests.unit.site.reference import Page, respelled
from tests.unit.site.test_hostile_pages import HOSTILE

ROOT = "reference/lamps/"
RENAMED = "LampState is called LampLevel."


def notice(page: Page) -> tuple[str, str]:
    """Return what a page of an older edition says at its top, and where that leads to."""
    (found,) = re.findall(r'<aside class="edition older".*?</p>', page.text, re.DOTALL)
    [*_, link] = re.findall(r'href="([^"]*)"', found)
    return " ".join(re.sub(r"<[^>]*>", "", found).split()), page.leads_to(link)[0]


def test_each_older_edition_has_a_reference_of_its_own() -> None:
    pages = three().pages
    second, first = {"LampsSet", "LampRead", "LampLevel"}, {"LampsSet", "LampRead", "LampState"}
    messages = {"": {"LampRead", "LampLevel"}, "2.0.0/": second, "1.0.0/": first}
    for folder, names in messages.items():
        found = [re.fullmatch(f"{ROOT}{folder}messages/(.*).html", path) for path in pages]
        assert {each[1] for each in found if each} == names
    assert "u8" in three().page("2.0.0/messages/LampRead.html").words
    assert "u16" in three().page("messages/LampRead.html").words


def test_every_link_of_every_edition_leads_somewhere() -> None:
    assert len(three().pages) > 40
    assert three().broken_links == []


@in_turn(
    "page, said, path",
    lambda: [
        ("2.0.0/index", "This page in 3.0.0", "index"),
        ("2.0.0/errata", "This page in 3.0.0", "errata"),
        ("2.0.0/messages/LampRead", "This page in 3.0.0", "messages/LampRead"),
        ("2.0.0/messages/LampLevel", "This page in 3.0.0", "messages/LampLevel"),
        ("2.0.0/messages/LampsSet", "LampsSet is gone in 3.0.0.", "index"),
        ("1.0.0/messages/LampState", f"In 3.0.0, {RENAMED}", "messages/LampLevel"),
        ("1.0.0/messages/LampsSet", "LampsSet is gone in 3.0.0.", "index"),
    ],
)
def test_an_older_page_leads_to_the_newest(page: str, said: str, path: str) -> None:
    begins = f"Version {page.partition('/')[0]}, which is not the newest."
    found = notice(three().page(f"{page}.html"))
    assert found == (f"{begins} {said}", f"{ROOT}{path}.html")


def test_a_name_that_only_seems_to_be_another_is_said_to_be_a_guess() -> None:
    guessed = SECOND.replace("    was: LampState\n", "")
    site = Editions(guessed, (FIRST,))
    said, _ = notice(site.page("1.0.0/messages/LampState.html"))
    assert said.endswith("In 2.0.0, LampState may be LampLevel.")
    assert site.broken_links == []


def test_the_newest_page_offers_the_same_in_other_editions() -> None:
    page = three().page("messages/LampLevel.html")
    (details,) = re.findall(r'<details class="edition">.*?</details>', page.text, re.DOTALL)
    assert "<summary>Version 3.0.0</summary>" in details
    links = [page.leads_to(link)[0] for link in re.findall(r'href="([^"]*)"', details)]
    others = ["2.0.0/messages/LampLevel", "1.0.0/messages/LampState", "changelog"]
    assert links == [f"{ROOT}{path}.html" for path in others]
    assert ", as LampState" in details


def test_where_a_message_is_new_older_editions_say_so() -> None:
    site = Editions(FIRST, (edited(FIRST, {"remove": "LampsSet:"}),))
    assert "1.0.0: not there, see" in site.page("messages/LampsSet.html").text


def test_a_spec_without_other_editions_offers_none() -> None:
    for released in ((), (FIRST,)):
        for path in ("index", "messages/LampRead", "changelog"):
            page = Editions(FIRST, released).page(f"{path}.html")
            assert 'class="edition' not in page.text, path


def test_the_last_release_is_not_rendered_twice() -> None:
    """Its address leads to the newest edition, which is the same; comments aside."""
    same = Editions(f"# Released.\n{THIRD}", (THIRD,))
    alone = Editions(f"# Released.\n{THIRD}", ())
    added = f"{ROOT}3.0.0/index.html"
    assert same.rendered.keys() - alone.rendered.keys() == {added}
    assert f"{ROOT}index.html" in same.page("3.0.0/index.html").reached
    assert {path: text for path, text in same.rendered.items() if path != added} == alone.rendered


def test_another_order_is_another_edition() -> None:
    first, read, end = (
        FIRST.index(f"  {name}:\n") for name in ("LampsSet", "LampRead", "LampState")
    )
    other = FIRST[:first] + FIRST[read:end] + FIRST[first:read] + FIRST[end:]
    paths = {page.path for page in Editions(other, (FIRST,)).site.pages}
    assert f"{ROOT}1.0.0/messages/LampRead.html" in paths


def test_what_waits_for_its_release_says_so() -> None:
    site = Editions(THIRD, (SECOND, FIRST))
    assert "Version 3.0.0, not released yet" in site.page("index.html").words
    assert "not released yet" not in three().page("index.html").words
    assert site.broken_links == []


def test_older_editions_are_in_no_navigation_and_not_searched() -> None:
    linked = [link for section in three().site.sidebar for link in section.every_link]
    assert [each.path for each in linked if re.match(rf"{ROOT}[0-9]", each.path)] == []
    assert "1.0.0/" not in three().rendered["search.html"]
    versions = [each.path for each in linked if each.label == "Versions"]
    assert versions == [f"{ROOT}changelog.html"]


def test_search_engines_are_led_to_the_newest() -> None:
    found = {page.path.removeprefix(ROOT): page.canonical for page in three().site.pages}
    for path, newest in {
        "2.0.0/messages/LampRead.html": "messages/LampRead.html",
        "1.0.0/messages/LampState.html": "messages/LampLevel.html",
        "1.0.0/stream.html": "stream.html",
        "3.0.0/index.html": "index.html",
        # Of what is gone, no newer page tells.
        **dict.fromkeys(["2.0.0/messages/LampsSet.html", "messages/LampRead.html"], ""),
    }.items():
        assert found[path] == (newest and f"{ROOT}{newest}")


def test_titles_and_trails_of_older_pages_have_the_version() -> None:
    page = three().page("1.0.0/messages/LampRead.html")
    assert "<title>LampRead \N{EN DASH} Lamps 1.0.0</title>" in page.text
    trail = re.findall(r'<nav class="trail".*?</nav>', page.text, re.DOTALL)[0]
    assert re.findall(r">([^<]+)</a>", trail) == ["Home", "Lamps", "Versions", "1.0.0"]


# What a release can put into pages of the newest edition, and one of each kind of its own.
EXPOSED = ("changelog", "index", "1.0.0/index", "1.0.0/messages/LampState", "1.0.0/errata")


@cache
def elements_of_release(payload: str) -> dict[str, list[tuple[str, list[str]]]]:
    """Return the elements of pages of a site one of whose releases says it wherever it can.

    Code is left out: between two backticks, it is what a sentence may have.
    """
    site = Editions(SECOND, (respelled(with_prose(data_in(FIRST), payload)).text,))
    tags = {path: site.page(f"{path}.html").tags for path in EXPOSED}
    return {
        path: [(tag, sorted(given)) for tag, given in found if tag != "code"]
        for path, found in tags.items()
    }


def test_a_hostile_release_stays_inert() -> None:
    """With an odd and with an even number of backticks: code is what stands between two."""
    for payload in (HOSTILE, f"{HOSTILE} `"):
        assert elements_of_release(payload) == elements_of_release("words")


def test_the_same_editions_give_the_same_bytes() -> None:
    again = Editions(THIRD, (THIRD, SECOND, FIRST))
    for path in ("changelog.html", "downloads.html", "2.0.0/messages/LampRead.html"):
        assert again.page(path).text == three().page(path).text


# A length of four bytes, so that lists may be as long as they say.
WIDE = FIRST.replace("length, type: u8", "length, type: u32").replace(
    "lamp_count: {type: u8", "lamp_count: {type: u32"
)
BOTH = Editions(SECOND, (FIRST,))


def test_one_page_of_an_edition_leads_to_the_next() -> None:
    site = BOTH.site

    def beside(pages: Iterable[SitePage]) -> list[tuple[Any, ...]]:
        links = [site.navigation.neighbours(page) for page in pages]
        return [tuple(getattr(each, "path", None) for each in both) for both in links]

    (older,) = site.collection.older
    paths = [page.path for page in older.pages]
    assert beside(older.pages) == [*zip([None, *paths], [*paths[1:], None], strict=False)]
    newest = {path for pair in beside(site.references[0].pages) for path in pair}
    assert newest.isdisjoint(paths)


def test_live_fields_are_on_messages_of_the_newest_edition() -> None:
    pages = {
        path: text for path, text in BOTH.rendered.items() if re.search("/messages/.*l$", path)
    }
    live = {("/1.0.0/" not in path, "live-data" in text) for path, text in pages.items()}
    assert live == {(True, True), (False, False)}


@in_turn("count", lambda: [40_000, 5_000_000_000])
def test_frames_that_no_memory_holds_are_refused(count: int) -> None:
    """They would be made to be compared."""
    text = WIDE.replace("count: 1..8", f"count: 1..{count}")
    message = r"released/lamps\.yaml: LampsSet has frames of up to [0-9]+ bytes, and no frame"
    with pytest.raises(Unusable, match=message):
        edition_of(Source("spec/released/lamps.yaml", text))


def test_long_frames_that_are_legal_are_not_refused() -> None:
    text = WIDE.replace("count: 1..8", "count: 1..32000")
    edition = edition_of(Source("spec/released/lamps.yaml", text))
    assert 64_000 < edition.model.messages["LampsSet"].largest <= 65_535
