"""The folder that is published: guides and reference, joined, and whole."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.docs.reference import ROOT, Page
from tests.docs.test_validity import complaints
from tests.docs.test_validity import pytestmark as needs_validator

pytest.importorskip("markdown_it", reason="markdown-it-py is not installed")


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Page]:
    folder = tmp_path_factory.mktemp("build") / "site"
    done = subprocess.run(
        [sys.executable, str(ROOT / "docs" / "site.py"), str(folder)],
        env={"PYTHONPATH": str(ROOT / "codegen")},
        capture_output=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stderr
    return {
        file.relative_to(folder).as_posix(): Page(
            file.relative_to(folder).as_posix(), file.read_text("utf-8")
        )
        for file in sorted(folder.rglob("*.html"))
    }


def guides(site: dict[str, Page]) -> dict[str, Page]:
    return {path: page for path, page in site.items() if "/" not in path}


def test_every_guide_is_a_page(site: dict[str, Page]) -> None:
    names = {file.stem for file in (ROOT / "docs").glob("*.md")} - {"README"}
    assert {path.removesuffix(".html") for path in guides(site)} - {"index"} == names
    assert "reference/index.html" in site


def test_every_link_of_a_guide_leads_somewhere(site: dict[str, Page]) -> None:
    # The index of the guides, which every page leads to, comes from docs/README.md.
    indexed = (ROOT / "docs" / "README.md").exists()
    for path, page in guides(site).items():
        for link in page.links:
            where, anchor = page.leads_to(link)
            if "://" in link or (where == "index.html" and not indexed):
                continue
            assert where in site, (path, link)
            assert not anchor or anchor in site[where].ids, (path, link)


@needs_validator
def test_guides_are_valid(site: dict[str, Page], tmp_path: Path) -> None:
    assert complaints(tmp_path, {path: page.text for path, page in guides(site).items()}) == []


def test_code_of_a_guide_is_code(site: dict[str, Page]) -> None:
    assert "AA 07 02 FF 01 03 E8 00 3C" in site["write-a-spec.html"].words
    assert "<script" not in site["troubleshooting.html"].text
