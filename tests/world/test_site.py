"""The site of this project: guides and references, linked and complete."""

import re
from pathlib import Path

import pytest

from tests.factories import compiled_file
from tests.unit.site.reference import ROOT, Page, broken_links
from tests.unit.site.validity import complaints, needs_validator


@pytest.fixture(scope="module")
def site(folder: Path) -> dict[str, Page]:
    """Return the pages in the folder that `make docs` builds."""
    assert "\t$(IN)/framegen docs --strict --out $(SITE) " in (ROOT / "Makefile").read_text("utf-8")
    files = {file.relative_to(folder).as_posix(): file for file in sorted(folder.rglob("*.html"))}
    return {path: Page(path, file.read_text("utf-8")) for path, file in files.items()}


def guides(site: dict[str, Page]) -> dict[str, Page]:
    return {path: page for path, page in site.items() if "/" not in path}


def test_every_guide_is_a_page(site: dict[str, Page]) -> None:
    names = {file.stem for file in (ROOT / "docs").glob("*.md")} - {"README"}
    assert {path.removesuffix(".html") for path in guides(site)} - {"index", "search"} == names
    assert {"index.html", "reference/busservo/index.html"} <= site.keys()


def test_every_link_leads_somewhere(folder: Path, site: dict[str, Page]) -> None:
    files = {file.relative_to(folder).as_posix() for file in folder.rglob("*") if file.is_file()}
    assert broken_links(site, files) == []


@needs_validator
def test_guides_and_the_front_page_are_valid(site: dict[str, Page], tmp_path: Path) -> None:
    pages = guides(site)
    assert complaints(tmp_path, {path: page.text for path, page in pages.items()}) == []


def test_guides_lead_to_the_pages_of_the_reference(site: dict[str, Page]) -> None:
    reached = {page.leads_to(link)[0] for page in guides(site).values() for link in page.links}
    expected = ["index", "lookalikes", "spec", "decoder"]
    assert {f"reference/busservo/{name}.html" for name in expected} <= reached
    assert "reference/lxservo/index.html" in reached


def test_the_front_page_leads_to_each_reference(site: dict[str, Page]) -> None:
    front = site["index.html"]
    for file in (ROOT / "spec" / "busservo.yaml", ROOT / "spec" / "lxservo.yaml"):
        protocol = compiled_file(file).spec.protocol
        assert f"reference/{protocol.name}/index.html" in front.links
        assert protocol.version in front.words


def test_code_of_a_guide_is_code(site: dict[str, Page]) -> None:
    assert "AA 07 02 FF 01 03 E8 00 3C" in site["write-a-spec.html"].words
    blocks = [page.text.count("<pre") for page in guides(site).values()]
    fences = [
        len(re.findall(r"^```\w", file.read_text("utf-8"), re.MULTILINE))
        for file in (ROOT / "docs").glob("*.md")
    ]
    assert sum(blocks) >= sum(fences) > 100
