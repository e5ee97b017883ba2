"""A site at an address: whole addresses, a sitemap, a page for broken links."""

import re
from xml.etree import ElementTree as ET

import pytest
from framegen.reading.yamltree import Unusable
from framegen.site.publication import base_address

from tests.in_turn import in_turn
from tests.unit.site.lamps import BASE, lamps, metas, rendered_lamps
from tests.unit.site.reference import ROOT


def test_each_page_at_an_address_has_its_own() -> None:
    site = lamps(BASE, preview=True)
    for path, page in site.items():
        if path == "404.html":
            continue
        (canonical,) = (given["href"] for given in page.having("rel", "canonical"))
        assert canonical == BASE + re.sub(r"(^|/)index\.html$", r"\1", path)
        said = metas(page)
        assert said["og:url"] == canonical
        assert said["og:image"] == f"{BASE}images/preview.png"
        assert said["og:image:alt"]
        assert said["twitter:card"] == "summary_large_image"


def test_without_a_picture_none_is_named() -> None:
    assert "og:image" not in metas(lamps(BASE)["index.html"])


def test_the_page_for_broken_links_works_at_any_address() -> None:
    page = lamps(BASE)["404.html"]
    assert [link for link in page.links if not link.startswith((BASE, "#"))] == []
    assert metas(page)["robots"] == "noindex"
    reached = {link.removeprefix(BASE).partition("#")[0] for link in page.links}
    assert {"index.html", "first.html"} <= reached
    assert reached - {""} <= lamps(BASE).keys()
    assert "404.html" not in lamps()


def test_the_sitemap_lists_every_page_once_and_robots_lead_to_it() -> None:
    made = rendered_lamps(BASE)
    root = ET.fromstring(made["sitemap.xml"])  # noqa: S314 - our own
    places = [each.text for each in root.iter("{http://www.sitemaps.org/schemas/sitemap/0.9}loc")]
    pages = [path for path in made if path.endswith(".html") and path != "404.html"]
    assert sorted(map(str, places)) == sorted(
        BASE + re.sub(r"(^|/)index\.html$", r"\1", path) for path in pages
    )
    assert f"Sitemap: {BASE}sitemap.xml\n" in made["robots.txt"]


def test_an_address_is_taken_with_or_without_a_slash() -> None:
    taken = {
        "": "",
        "https://example.org": "https://example.org/",
        "https://example.org/": "https://example.org/",
        "http://localhost:8000/docs": "http://localhost:8000/docs/",
        "https://[::1]/docs/": "https://[::1]/docs/",
    }
    assert {given: base_address(given) for given in taken} == taken


REFUSED = {
    **dict.fromkeys(["example.org", "ftp://example.org/", "//example.org/"], "no address"),
    **dict.fromkeys(["https://", "https:///docs"], "no host"),
    **{f"https://example.org/{end}": "nothing follows a ?" for end in ("?a=b", "#a", "#")},
    "https://me:secret@example.org/": "a password",
    "https://example.org:port/": "port",
    "https://example.org:99999/": "Port out of range",
    **{f"https://example.org/{end}": "spell it with %" for end in ("a b/", '"><b>', "\n")},
    "https://exämple.org/": "spell it with %",
}


@in_turn("given", lambda: REFUSED)
def test_what_is_no_address_is_refused_with_the_reason(given: str) -> None:
    with pytest.raises(Unusable, match=re.escape(REFUSED[given])) as refused:
        base_address(given)
    assert "https://example.org/docs/" in str(refused.value.hint)


def test_the_picture_of_the_project_is_of_the_size_that_previews_show() -> None:
    data = (ROOT / "docs" / "images" / "preview.png").read_bytes()
    assert data.startswith(b"\x89PNG")
    assert (int.from_bytes(data[16:20], "big"), int.from_bytes(data[20:24], "big")) == (1200, 630)
    assert len(data) < 100_000
