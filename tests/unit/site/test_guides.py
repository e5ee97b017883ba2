"""Guides as pages: where their links lead, and which files become pages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.site.guides.guide import Guide, page_of
from framegen.site.project import read_project

from tests.in_turn import in_turn
from tests.unit.site.lamps import lamps, links, rendered_lamps
from tests.unit.site.reference import broken_links

if TYPE_CHECKING:
    from pathlib import Path


def test_links_of_a_guide_lead_to_pages_or_are_text() -> None:
    site = lamps()
    found = dict(links(site["first.html"].text.partition("<article")[2].partition("</article")[0]))
    for link, label in {
        "second.html": "the second",
        "reference/greenhouse/index.html#frames": "the frames",
        "reference/greenhouse/messages/VentsOpen.html": "a message",
        "reference/greenhouse/spec.html": "the spec",
        "reference/greenhouse/decoder.html": "the workbench",
        "project/changelog.html": "changes",
        "https://example.org/": "elsewhere",
    }.items():
        assert found[link] == label
    assert "a file" not in found.values()
    assert "<span>a file</span>" in site["first.html"].text
    changes = dict(links(site["project/changelog.html"].text.partition("<main")[2]))
    assert changes["../first.html#a-step"] == "the steps"


@in_turn("path", lambda: sorted(lamps()))
def test_no_link_is_dead(path: str) -> None:
    site = lamps()
    assert broken_links(site, rendered_lamps(), [site[path]]) == []


@in_turn(
    "path, page",
    lambda: [
        ("first.md", "first.html"),
        ("README.md", "index.html"),
        ("more/README.md", "more/index.html"),
        ("../CONTRIBUTING.md", "project/contributing.html"),
        ("../benchmarks/README.md", "project/benchmarks.html"),
        ("../README.md", "project/readme.html"),
    ],
)
def test_a_markdown_file_becomes_a_page(path: str, page: str) -> None:
    assert page_of(path) == page


def test_words_with_a_hyphen_stay_whole() -> None:
    body = Guide("a.md", "`--all b --a-much-longer-option-than-that`").body
    assert '<code><span class="word">--all</span> b --a-much-longer-option-than-that</code>' in body


def test_files_outside_the_guides_are_pages_where_the_plan_lists_them(tmp_path: Path) -> None:
    docs = tmp_path / "root" / "docs"
    (docs / "images").mkdir(parents=True)
    (docs / "README.md").write_text(
        "# T\n\n## S\n\n- [a](../A.md)\n- [b](../../B.md)\n- [c](../C.md)\n- [d](../D.txt)\n",
        encoding="utf-8",
    )
    for file in ("../A.md", "../../B.md", "../D.txt", "../E.md"):
        (docs / file).write_text("# X\n", encoding="utf-8")
    (docs / "images" / "a.png").write_bytes(b"\x89")
    assert read_project({}, docs).guides.keys() == {"README.md", "../A.md"}
    assert read_project({}, docs).files == {"images/a.png": b"\x89", "files/D.txt": b"# X\n"}
    assert read_project({}, docs).version == ""
    (docs / "../pyproject.toml").write_text('[project]\nversion = "1.2.3"\n', encoding="utf-8")
    assert read_project({}, docs).version == "1.2.3"


def test_cells_are_aligned_by_classes() -> None:
    body = Guide("a.md", "| a | b | c |\n|---|--:|:-:|\n| 1 | 2 | 3 |\n").body
    assert "style" not in body
    assert '<td>1</td>\n<td class="right">2</td>\n<td class="center">3</td>' in body
