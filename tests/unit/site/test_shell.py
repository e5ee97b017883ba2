"""The frame of every page: navigation, contents, the landing page and the head."""

import html
import re

from framegen.render import snippets
from framegen.site.guides.headings import headings, with_permalinks
from framegen.site.project import Project
from framegen.site.site import render_site

from tests.in_turn import in_turn
from tests.unit.site.lamps import greenhouse, lamps, links, metas, part, title
from tests.unit.site.reference import Page


def test_the_sidebar_is_the_plan_in_its_order_and_words() -> None:
    text = part(lamps()["index.html"], "Documentation")
    sections = re.findall(r'<p class="section"[^>]*>(.*?)</p>', text)
    assert sections == ["Learn", "Look up", "Maintain", "More"]
    labels = [label for _, label in links(text)]
    assert labels[:3] == ["First steps", "Second steps", "Frames"]
    assert labels[-2:] == ["Changes", "Third"]
    assert "The protocol" in text


def test_messages_show_their_direction_in_words_and_with_an_arrow() -> None:
    text = part(lamps()["reference/greenhouse/index.html"], "Documentation")
    groups = re.findall(r'<summary><span class="way brief (\w+)">(.*?)</span>', text)
    ways = [("to", "gateway → station"), ("from", "station → gateway"), ("to", "gateway → display")]
    assert groups == ways
    assert {"→ VentsOpen", "← StationState"} <= {label for _, label in links(text)}


@in_turn("path", lambda: ["first.html", "reference/greenhouse/messages/VentsOpen.html"])
def test_one_link_of_the_sidebar_is_the_page_itself(path: str) -> None:
    page = lamps()[path]
    current = re.findall(r'href="([^"]*)" aria-current="page"', page.text)
    assert [page.leads_to(link)[0] for link in current] == [path]


def test_a_trail_leads_from_home_to_the_page_and_its_section_is_marked() -> None:
    message = "reference/greenhouse/messages/VentsOpen.html"
    for path, labels in {
        message: ["Home", "Look up", "The protocol"],
        "first.html": ["Home", "Learn"],
        "index.html": [],
    }.items():
        trail = part(lamps()[path], "Where this page is")
        assert [label for _, label in links(trail)] == labels
    marked = re.findall(r'aria-current="true">(.*?)<', part(lamps()[message], "Sections"))
    assert marked == ["Look up"]


def test_previous_and_next_go_through_every_page_of_the_sidebar() -> None:
    home = lamps()["index.html"]
    listed = [home.leads_to(link)[0] for link, _ in links(part(home, "Documentation"))]
    for rel, others in (("prev", ["", *listed[:-1]]), ("next", [*listed[1:], ""])):
        for path, other in zip(listed, others, strict=True):
            page = lamps()[path]
            led = [page.leads_to(given["href"])[0] for given in page.having("rel", rel)]
            assert led == [other] * bool(other) or (rel, path) == ("prev", listed[0]), (rel, path)


@in_turn("path", lambda: sorted(lamps()))
def test_contents_name_the_headings_and_lead_to_them(path: str) -> None:
    page = lamps()[path]
    found = links(part(page, "On this page"))
    headed = re.findall(r'<h([23])[^>]* id="([^"]*)"[^>]*>(.*?)</h\1>', page.text, re.DOTALL)
    second = [id_ for level, id_, _ in headed if level == "2"]
    assert {link for link, _ in found} >= {f"#{id_}" for id_ in second}
    assert {link.removeprefix("#") for link, _ in found} <= set(page.ids)


@in_turn("path", lambda: sorted(lamps()))
def test_no_heading_is_read_aloud_with_its_link(path: str) -> None:
    page = lamps()[path].text
    for _, inside in re.findall(r"<h([1-6])[^>]*>(.*?)</h\1>", page, re.DOTALL):
        assert "permalink" not in inside
    main_part = page.partition("<main")[2]
    ids = re.findall(r'<h[1-4][^>]* id="([^"]*)"', main_part)
    beside = re.findall(r'</h[1-4]><a class="permalink" href="#([^"]*)"', main_part)
    assert set(beside) >= set(ids)
    assert set(beside) <= set(lamps()[path].ids)


def test_headings_are_read_from_what_a_page_shows() -> None:
    text = (
        '<h2 id="a">A &lt;b&gt; <code>c</code><a class="permalink" href="#a">#</a></h2>'
        '<h4 id="d">D</h4>'
    )
    (found,) = headings(text)
    assert (found.level, found.id, found.text) == (2, "a", "A &lt;b&gt; c")
    assert with_permalinks(text) == (
        '<div class="heading"><h2 id="a">A &lt;b&gt; <code>c</code></h2>'
        '<a class="permalink" href="#a" aria-label="Link to A &lt;b&gt; c">#</a></div>'
        '<div class="heading"><h4 id="d">D</h4>'
        '<a class="permalink" href="#d" aria-label="Link to D">#</a></div>'
    )


def test_a_link_inside_a_heading_comes_beside_it() -> None:
    text = '<div id="a"><h3>A<a class="permalink" href="#a">#</a></h3></div><h3>B</h3>'
    assert headings(text) == []
    assert with_permalinks(text) == (
        '<div id="a"><div class="heading"><h3>A</h3>'
        '<a class="permalink" href="#a" aria-label="Link to A">#</a></div></div><h3>B</h3>'
    )


def test_contents_of_many_headings_leave_the_third_level_out() -> None:
    text = "".join(f'<h2 id="a{i}">A</h2><h3 id="b{i}">B</h3>' for i in range(15))
    assert len(headings(text)) == 30
    assert {each.level for each in headings(text + '<h2 id="c">C</h2>')} == {2}


def test_the_landing_page_shows_the_introduction_a_frame_and_the_plan() -> None:
    site = lamps()
    page = site["index.html"]
    assert "<p>Lamps on a <em>line</em>.</p>" in page.text
    assert '<pre class="python"' in page.text
    assert '<pre class="output"' in page.text
    # Code begins a sentence as it is.
    texts = ["How to begin.", "From nothing to a lamp.", "lamps from a shell."]
    assert page.lacks([*texts, "See the tests, and the first steps."]) == []
    reached = {"first.html", "project/changelog.html", "reference/greenhouse/index.html"}
    assert reached <= page.reached
    rows = re.findall(r'<td class="number"><code class="bytes">(.*?)</code>', page.text)
    shown = re.findall(r'<span class="bytes">(.*?)</span>', page.text)
    assert rows == shown
    bytes_shown = "".join(rows).replace(" ", "").lower()
    assert any(f"hex={bytes_shown}&" in html.unescape(link) for link in page.links)


def test_without_guides_the_references_are_the_landing_page() -> None:
    compiled = greenhouse()
    page = Page("index.html", render_site(Project([compiled]), snippets())["index.html"])
    assert compiled.spec.protocol.title in page.words
    assert "reference/greenhouse/index.html" in page.links
    assert 'id="frame"' in page.text


def test_every_page_has_a_title_and_a_description_of_its_own() -> None:
    titles = {path: title(page) for path, page in lamps().items()}
    abouts = {path: metas(page)["description"] for path, page in lamps().items()}
    for texts in (titles, abouts):
        assert len({*texts.values()} - {""}) == len(texts)
    assert titles["first.html"] == "The very first steps \u2013 Lamps"
    assert abouts["first.html"] == "From nothing to a lamp."
    assert abouts["third.html"] == "Nobody lists it."
    assert abouts["index.html"] == "Lamps on a line."


@in_turn("path", lambda: sorted(lamps()))
def test_the_icon_is_part_of_the_page_and_nothing_claims_an_address(path: str) -> None:
    page = lamps()[path]
    (icon,) = page.having("rel", "icon")
    assert icon["href"].startswith("data:image/svg+xml,")
    assert re.search(r"img-src [^;]*data:", page.having("http-equiv")[0]["content"])
    assert {"og:title", "og:description"} <= metas(page).keys()
    assert not {"og:url", "og:image", "twitter:card"} & metas(page).keys()
    assert page.having("rel", "canonical") == []


def test_the_footer_names_versions() -> None:
    text = lamps()["first.html"].text.partition("<footer>")[2]
    assert "Lamps 4.5.6, built by framegen" in text
