"""Guides as pages: where their links lead, which files become pages, and odd ones of all kinds."""

import re
import shutil
from pathlib import Path

import pytest
from framegen.reading.yamltree import Unusable
from framegen.render import snippets
from framegen.site.guides.guide import Guide, page_of
from framegen.site.guides.markdown import slugs
from framegen.site.project import Project, read_project
from framegen.site.site import render_site

from tests.factories import compiled_file, write_files
from tests.in_turn import in_turn
from tests.unit.site.lamps import lamps, links, rendered_lamps
from tests.unit.site.reference import LAMP, broken_links

PLAN = "# Lamps\n\nAll of them.\n\n## Learn\n\n"


def test_links_of_a_guide_lead_to_pages_or_are_text() -> None:
    site = lamps()
    found = dict(links(site["first.html"].text.partition("<article")[2].partition("</article")[0]))
    assert {
        "second.html": "the second",
        "reference/greenhouse/index.html#frames": "the frames",
        "reference/greenhouse/messages/VentsOpen.html": "a message",
        "reference/greenhouse/spec.html": "the spec",
        "reference/greenhouse/decoder.html": "the workbench",
        "project/changelog.html": "changes",
        "https://example.org/": "elsewhere",
    }.items() <= found.items()
    assert "a file" not in found.values()
    assert "<span>a file</span>" in site["first.html"].text
    changes = dict(links(site["project/changelog.html"].text.partition("<main")[2]))
    assert changes["../first.html#a-step"] == "the steps"
    assert broken_links(site, rendered_lamps()) == []


def test_a_markdown_file_becomes_a_page() -> None:
    pages = {
        "first.md": "first.html",
        "README.md": "index.html",
        "more/README.md": "more/index.html",
        "../CONTRIBUTING.md": "project/contributing.html",
        "../benchmarks/README.md": "project/benchmarks.html",
        "../README.md": "project/readme.html",
    }
    assert {path: page_of(path) for path in pages} == pages


def test_words_with_a_hyphen_stay_whole_and_cells_are_aligned_by_classes() -> None:
    body = Guide("a.md", "`--all b --a-much-longer-option-than-that`").body
    assert '<code><span class="word">--all</span> b --a-much-longer-option-than-that</code>' in body
    body = Guide("a.md", "| a | b | c |\n|---|--:|:-:|\n| 1 | 2 | 3 |\n").body
    assert "style" not in body
    assert '<td>1</td>\n<td class="right">2</td>\n<td class="center">3</td>' in body


def test_files_outside_the_guides_are_pages_where_the_plan_lists_them(tmp_path: Path) -> None:
    docs = tmp_path / "root" / "docs"
    plan = "# T\n\n## S\n\n- [a](../A.md)\n- [b](../../B.md)\n- [c](../C.md)\n- [d](../D.txt)\n"
    files = dict.fromkeys(["../A.md", "../../B.md", "../D.txt", "../E.md"], "# X\n")
    write_files({"README.md": plan, "images/a.png": "\x89", **files}, docs)
    found = read_project({}, docs)
    assert found.guides.keys() == {"README.md", "../A.md"}
    assert found.files == {"images/a.png": "\x89".encode(), "files/D.txt": b"# X\n"}
    assert found.version == ""
    write_files({"../pyproject.toml": '[project]\nversion = "1.2.3"\n'}, docs)
    assert read_project({}, docs).version == "1.2.3"


def built(docs: Path, guides: dict[str, str]) -> dict[str, str]:
    """Return the site of these guides as files, and of no others that were there."""
    shutil.rmtree(docs, ignore_errors=True)
    write_files({"README.md": PLAN, **guides}, docs)
    return render_site(read_project({LAMP: compiled_file(LAMP)}, docs), snippets())


def prose(page: str) -> str:
    """Return what a guide itself says, in HTML."""
    return page.partition("<main")[2].partition("</main>")[0]


def test_guides_in_folders_are_pages(tmp_path: Path) -> None:
    guides = {
        "README.md": f"{PLAN}- [Deep](sub/deep.md): below\n",
        "first.md": "# First\n\n[deep](sub/deep.md#part)\n",
        "sub/deep.md": "# Deep\n\n## Part\n\n[up](../first.md)\n",
        "reference/stage_lamp/README.md": "# Made\n",
        "reference/hints.md": "# By hand\n",
    }
    site = built(tmp_path / "docs", guides)
    assert '<a href="sub/deep.html#part">deep</a>' in site["first.html"]
    assert '<a href="../first.html">up</a>' in site["sub/deep.html"]
    assert 'href="../index.html#learn"' in site["sub/deep.html"]
    assert "Made" not in "".join(site.values())
    assert "By hand" in site["reference/hints.html"]


def test_links_and_the_plan_take_any_letters(tmp_path: Path) -> None:
    guides = {
        "README.md": f"{PLAN}- [So big](größe.md): how big\n",
        "größe.md": "\ufeff# Größe\n",
        "first.md": "# First\n\n[size](größe.md) [same](gr%C3%B6%C3%9Fe.md)\n",
    }
    site = built(tmp_path / "docs", guides)
    assert prose(site["first.html"]).count('href="gr%C3%B6%C3%9Fe.html"') >= 2
    assert "So big" in site["first.html"]
    assert "<h1" in site["größe.html"]
    assert "\ufeff" not in site["größe.html"]


# Headings in their order, and their anchors.
ANCHORS = (
    (["Same", "Same", "Same"], ["same", "same-1", "same-2"]),
    (["Same", "Same 1", "Same"], ["same", "same-1", "same-2"]),
    (["Größe — 日本"], ["größe--日本"]),
    (["!!!", "???"], ["section", "section-1"]),
    (["Content"], ["content-1"]),
)


@in_turn("headings, expected", lambda: ANCHORS)
def test_each_heading_has_an_anchor_of_its_own(headings: list[str], expected: list[str]) -> None:
    assert [*slugs(headings)] == expected


def test_no_id_stands_twice_in_a_guide(tmp_path: Path) -> None:
    text = "# First\n\n## Same\n\n## Same\n\n## Content\n\n## Sidebar\n\n## !!!\n"
    page = built(tmp_path / "docs", {"first.md": text})["first.html"]
    ids = re.findall(r' id="([^"]*)"', page)
    assert "" not in ids
    assert len(ids) == len(set(ids))


# A picture as it is written, and what stands in its place.
PICTURES = (
    ("![A lamp](images/none.png)", "<p>A lamp</p>"),
    ("![A &lt;b> lamp](none.png)", "<p>A &lt;b&gt; lamp</p>"),
    ("![A lamp](https://e.org/a.png)", '<p><a href="https://e.org/a.png">A lamp</a></p>'),
    ("![A lamp](//e.org/a.png)", '<p><a href="//e.org/a.png">A lamp</a></p>'),
    (
        "[![A lamp](https://e.org/a.png)](https://e.org/)",
        '<p><a href="https://e.org/">A lamp</a></p>',
    ),
)


@in_turn("written, expected", lambda: PICTURES)
def test_pictures_that_are_not_in_the_site_become_words(
    tmp_path: Path, written: str, expected: str
) -> None:
    page = built(tmp_path / "docs", {"first.md": f"# First\n\n{written}\n"})["first.html"]
    assert expected in prose(page)
    assert "<img" not in prose(page)


# A guide, and why it is refused: it would take the place of a page, or no link has such a name.
REFUSED = {name: f"docs/{name} would become" for name in ("index.md", "search.md")}
REFUSED |= dict.fromkeys(["a#b.md", "a?b.md", "100%.md"], "no link can lead to")


@in_turn("name", lambda: REFUSED)
def test_a_guide_has_a_name_and_a_place_of_its_own(tmp_path: Path, name: str) -> None:
    with pytest.raises(Unusable, match=REFUSED[name]):
        built(tmp_path / "docs", {name: "# Mine\n"})


def test_two_specs_have_two_names(tmp_path: Path) -> None:
    other = tmp_path / "other.yaml"
    shutil.copy(LAMP, other)
    twice = r"lamp\.yaml and other\.yaml are both of the protocol stage_lamp"
    with pytest.raises(Unusable, match=twice):
        read_project({file: compiled_file(file) for file in (LAMP, other)})


def test_a_list_above_all_headings_is_a_section() -> None:
    guides = {"README.md": "# Lamps\n\n- [First](first.md)\n", "first.md": "# First\n"}
    site = render_site(Project([compiled_file(LAMP)], guides), snippets())
    assert '<a href="index.html#guides">Guides</a>' in prose(site["first.html"])
    assert 'id="guides"' in site["index.html"]
