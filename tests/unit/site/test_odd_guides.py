"""Guides as people write them: in folders, with any letters, with what is missing."""

from __future__ import annotations

import re
import shutil
from typing import TYPE_CHECKING

import pytest
from framegen.reading.yamltree import Unusable
from framegen.render import snippets
from framegen.site.guides.markdown import slugs
from framegen.site.project import Project, read_project
from framegen.site.site import render_site

from tests.factories import compiled_file
from tests.in_turn import in_turn
from tests.unit.site.reference import LAMP

if TYPE_CHECKING:
    from pathlib import Path

PLAN = "# Lamps\n\nAll of them.\n\n## Learn\n\n"


def built(docs: Path, guides: dict[str, str]) -> dict[str, str]:
    """Return the site of these guides as files, and of no others that were there."""
    shutil.rmtree(docs, ignore_errors=True)
    for name, text in {"README.md": PLAN, **guides}.items():
        (docs / name).parent.mkdir(parents=True, exist_ok=True)
        (docs / name).write_text(text, encoding="utf-8")
    return render_site(read_project({LAMP: compiled_file(LAMP)}, docs), snippets())


def prose(page: str) -> str:
    """Return what a guide itself says, in HTML."""
    return page.partition("<main")[2].partition("</main>")[0]


def test_guides_in_folders_are_pages(tmp_path: Path) -> None:
    site = built(
        tmp_path / "docs",
        {
            "README.md": f"{PLAN}- [Deep](sub/deep.md): below\n",
            "first.md": "# First\n\n[deep](sub/deep.md#part)\n",
            "sub/deep.md": "# Deep\n\n## Part\n\n[up](../first.md)\n",
            "reference/stage_lamp/README.md": "# Made\n",
            "reference/hints.md": "# By hand\n",
        },
    )
    assert '<a href="sub/deep.html#part">deep</a>' in site["first.html"]
    assert '<a href="../first.html">up</a>' in site["sub/deep.html"]
    assert 'href="../index.html#learn"' in site["sub/deep.html"]
    assert "Made" not in "".join(site.values())
    assert "By hand" in site["reference/hints.html"]


def test_links_and_the_plan_take_any_letters(tmp_path: Path) -> None:
    site = built(
        tmp_path / "docs",
        {
            "README.md": f"{PLAN}- [So big](größe.md): how big\n",
            "größe.md": "\ufeff# Größe\n",
            "first.md": "# First\n\n[size](größe.md) [same](gr%C3%B6%C3%9Fe.md)\n",
        },
    )
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


@in_turn("name", lambda: ["index.md", "search.md"])
def test_a_guide_takes_no_place_of_another_page(tmp_path: Path, name: str) -> None:
    with pytest.raises(Unusable, match=f"docs/{name} would become"):
        built(tmp_path / "docs", {name: "# Mine\n"})


@in_turn("name", lambda: ["a#b.md", "a?b.md", "100%.md"])
def test_a_guide_has_a_name_that_links_can_have(tmp_path: Path, name: str) -> None:
    with pytest.raises(Unusable, match="no link can lead to"):
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
