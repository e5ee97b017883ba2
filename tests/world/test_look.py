"""A site of one's own, in a real browser."""

from pathlib import Path

from framegen.cli import main

from tests.unit.site.browser import Visit, launched, needs_chromium
from tests.unit.site.looks import faults_at_widths
from tests.unit.site.reference import Page
from tests.unit.site.test_look import OWN, project

__all__ = ["project"]


@needs_chromium
def test_a_site_of_ones_own_fits_each_width_and_loads_nothing_from_elsewhere(
    project: Path,
) -> None:
    (project / "docs" / "site.yaml").write_text(OWN, encoding="utf-8")
    assert main(["docs", "--out", "site"]) == 0
    pages = {
        file.relative_to("site").as_posix(): Page(file.name, file.read_text("utf-8"))
        for file in Path("site").rglob("*.html")
    }
    assert not [load for page in pages.values() for load in page.loads if "://" in load]
    with launched() as browser:
        visit = Visit(browser.new_context(), project / "site")
        for path in ("index.html", "first.html"):
            assert faults_at_widths(visit.open(path)) == []
        shown = visit.tab.locator("header img").evaluate("each => each.naturalWidth")
        assert shown > 0
        assert visit.troubles == []
        assert all(each.startswith("file:") for each in visit.requests)
