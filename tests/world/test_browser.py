"""The pages of the reference in a real browser."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.factories import write_files
from tests.unit.site.browser import (
    MILLISECONDS,
    Visit,
    arrives,
    decoded,
    needs_chromium,
    site_on_disk,
)
from tests.unit.site.reference import reference
from tests.unit.site.test_hostile_pages import hostile

if TYPE_CHECKING:
    from pathlib import Path

    from playwright.sync_api import Browser, BrowserContext
    from playwright.sync_api import Page as Tab

SITE = reference("busservo")
NAMES = [path for path in SITE.pages if "/" not in path]

pytestmark = needs_chromium


@pytest.fixture(scope="session")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the reference in a folder, as `framegen docs` builds it."""
    return site_on_disk(tmp_path_factory.mktemp("stick") / "the reference")


# ---------------------------------------------------------------------------- copying, landing


MOVE = "55 55 08 03 01 E8 03 01 20 03"
BUTTONS = [("Copy hex", MOVE), ("Copy as Python", f'bytes.fromhex("{MOVE}")')]


def copied(tab: Tab, label: str) -> str:
    """Click the first button of that label, and return the clipboard once it has said so."""
    # It says so for a moment, which a busy machine might miss: here, until the page is closed.
    tab.evaluate("() => { window.setTimeout = () => 0; }")
    tab.locator("button.copy", has_text=label).first.click()
    tab.locator("button.copy", has_text="Copied").wait_for()
    return str(tab.evaluate("navigator.clipboard.readText()"))


@pytest.mark.parametrize(("label", "text"), BUTTONS)
def test_copying(visit: Visit, label: str, text: str) -> None:
    assert copied(visit.open("messages/ServoMove.html"), label) == text


def test_copying_where_there_is_no_clipboard(visit: Visit) -> None:
    tab = visit.open("messages/ServoMove.html")
    tab.evaluate("() => { navigator.clipboard.writeText = () => Promise.reject(new Error()); }")
    assert copied(tab, "Copy hex") == MOVE


def test_anchors_land(visit: Visit) -> None:
    tab = visit.open("messages/ServoMove.html")
    tab.get_by_role("link", name="Link to targets[i].position").click()
    arrives(tab, "#field-targets-position")
    top = tab.locator("#field-targets-position").bounding_box()
    assert top is not None
    assert 0 <= top["y"] < 720
    tab.get_by_role("link", name="targets[i].position in the spec").click()
    arrives(tab, "spec.html#messages.ServoMove.fields.targets.fields.position")
    line = tab.locator(":target").inner_text()
    assert line.strip().endswith("position:")


def test_the_front_page_leads_to_the_reference(context: BrowserContext, folder: Path) -> None:
    visit = Visit(context, folder.parent.parent)
    tab = visit.open("index.html")
    tab.get_by_role("main").get_by_role("link", name="Every documented frame").click()
    arrives(tab, "busservo/examples.html")
    assert tab.get_by_role("searchbox").is_visible()
    visit.end()


# ---------------------------------------------------------------------------- looks


def test_the_cells_of_a_strip_wrap_on_a_phone(visit: Visit) -> None:
    tab = visit.open("messages/ServoMove.html")
    rows = {}
    for width in (1440, 380):
        tab.set_viewport_size({"width": width, "height": 900})
        cells = tab.locator(".strip").first.locator("li")
        rows[width] = len({box["y"] for cell in cells.all() if (box := cell.bounding_box())})
    assert rows[1440] == 1
    assert rows[380] > 1


def test_dark_mode_follows_the_preference(visit: Visit) -> None:
    visit.open("index.html")
    seen = {}
    for scheme in ("light", "dark"):
        visit.tab.emulate_media(color_scheme=scheme)
        seen[scheme] = visit.style("body", "backgroundColor"), visit.style("body", "color")
    assert seen["light"][0] == "rgb(255, 255, 255)"
    assert seen["dark"][0] != seen["light"][0]
    assert seen["dark"][1] != seen["light"][1]


def test_paper_has_no_navigation_and_breaks_no_strip(visit: Visit) -> None:
    visit.open("messages/ServoMove.html")
    visit.tab.emulate_media(media="print", color_scheme="dark")
    assert visit.style("nav", "display") == "none"
    assert visit.style(".actions", "display") == "none"
    assert visit.style("body", "backgroundColor") == "rgb(255, 255, 255)"
    for selector in (".strip", ".strip li", "tbody tr"):
        assert visit.style(selector, "breakInside") == "avoid"


def test_everything_is_readable_without_a_script(browser: Browser, folder: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    context.set_default_timeout(MILLISECONDS)
    tab = context.new_page()
    tab.goto((folder / "index.html").as_uri())
    assert tab.locator("tbody tr:visible").count() == 12
    assert not tab.locator("#search").is_visible()
    tab.goto((folder / "decoder.html").as_uri())
    assert tab.get_by_text("This page needs JavaScript").is_visible()
    assert not tab.locator("#hex").is_visible()
    tab.goto((folder / "messages" / "ServoMove.html").as_uri())
    assert "E8 03" in tab.locator("#example-1 .strip").first.inner_text()
    assert not tab.locator("button.copy").first.is_visible()
    context.close()


def test_a_page_alone_looks_as_in_its_folder(visit: Visit, tmp_path: Path, folder: Path) -> None:
    """As somebody sees it who was sent one page by mail."""
    alone = Visit(visit.tab.context, tmp_path)
    (tmp_path / "page.html").write_bytes((folder / "messages" / "ServoMove.html").read_bytes())
    shots = [
        each.open(path).screenshot()
        for each, path in (
            (visit, "messages/ServoMove.html"),
            (alone, "page.html"),
        )
    ]
    alone.tab.close()
    assert alone.troubles == []
    assert shots[0] == shots[1]


def test_nothing_of_a_hostile_spec_runs(context: BrowserContext, tmp_path: Path) -> None:
    site = hostile()
    write_files({path: page.text for path, page in site.pages.items()}, tmp_path)
    visit = Visit(context, tmp_path)
    visit.tab.on("dialog", lambda dialog: visit.troubles.append(dialog.message))
    for path in [*NAMES, "messages/ServoMove.html"]:
        tab = visit.open(path)
        tab.mouse.move(200, 200)
        assert tab.locator("img").count() == 0
        if path == "decoder.html":
            assert decoded(tab) == ["ServoMove"]
    visit.tab.close()
    assert visit.troubles == []
    assert [url for url in visit.requests if not url.startswith("file:")] == []
