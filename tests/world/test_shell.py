"""The frame of the site in a real browser: what every page has, used as readers use it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.unit.site.browser import Visit, needs_chromium, project_on_disk, texts
from tests.unit.site.looks import faults

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser, BrowserContext
    from playwright.sync_api import Page as Tab

MESSAGE = "reference/busservo/messages/ServoMove.html"
PAGES = ["index.html", "getting-started.html", "project/contributing.html", MESSAGE]

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the site of this project, as `make docs` builds it."""
    return project_on_disk(tmp_path_factory.mktemp("stick") / "the site")


@pytest.fixture
def context(browser: Browser) -> Iterator[BrowserContext]:
    context = browser.new_context(permissions=["clipboard-read", "clipboard-write"])
    yield context
    context.close()


def width(tab: Tab, pixels: int, height: int = 900) -> None:
    tab.set_viewport_size({"width": pixels, "height": height})


def focused(tab: Tab) -> str:
    return str(tab.evaluate("document.activeElement.outerHTML.slice(0, 120)"))


# ---------------------------------------------------------------------------- at any width


@pytest.mark.parametrize("path", PAGES)
def test_inline_code_is_not_broken_at_a_hyphen_on_a_phone(visit: Visit, path: str) -> None:
    tab = visit.open(path)
    width(tab, 380)
    broken = tab.evaluate(
        "[...document.querySelectorAll('.word')]"
        ".filter((word) => word.checkVisibility() && word.getClientRects().length > 1)"
        ".map((word) => word.textContent)"
    )
    assert broken == []


# ---------------------------------------------------------------------------- the sidebar


def test_on_a_wide_display_the_sidebar_shows_where_one_is(visit: Visit) -> None:
    tab = visit.open("reference/lxservo/messages/VoltageRead.html")
    width(tab, 1440)
    sidebar = tab.get_by_role("navigation", name="Documentation")
    current = sidebar.locator("[aria-current=page]")
    assert texts(current) == ["→ VoltageRead"] or "VoltageRead" in texts(current)[0]
    outer, inner = sidebar.bounding_box(), current.bounding_box()
    assert outer is not None
    assert inner is not None
    assert outer["y"] <= inner["y"]
    assert inner["y"] + inner["height"] <= outer["y"] + outer["height"]
    # The page itself has not moved for it, and does not grow with the messages.
    assert tab.evaluate("scrollY") == 0
    assert outer["height"] <= 900


def test_on_a_phone_the_sidebar_folds_away(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    width(tab, 380)
    sidebar = tab.locator("#sidebar")
    assert not sidebar.is_visible()
    tab.get_by_role("button", name="Menu").press("Enter")
    assert sidebar.is_visible()
    assert sidebar.get_by_role("link", name="ServoMove").is_visible()
    tab.keyboard.press("Escape")
    assert not sidebar.is_visible()
    assert "Menu" in focused(tab)


def test_without_a_script_all_can_be_reached(browser: Browser, folder: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    tab = context.new_page()
    for pixels in (380, 1440):
        width(tab, pixels)
        tab.goto((folder / MESSAGE).as_uri())
        if pixels == 380:
            tab.get_by_role("button", name="Menu").click()
        tab.locator("#sidebar").get_by_role("link", name="Getting started").click()
        assert tab.url.endswith("getting-started.html")
        assert [each for each in tab.locator("button.copy").all() if each.is_visible()] == []
    context.close()


# ---------------------------------------------------------------------------- contents, tabs


def test_the_contents_mark_what_is_being_read(visit: Visit) -> None:
    tab = visit.open("getting-started.html")
    width(tab, 1440)
    contents = tab.get_by_role("navigation", name="On this page")
    link = contents.get_by_role("link").nth(5)
    link.click()
    tab.wait_for_function("() => document.querySelector('.contents [aria-current]')")
    tab.wait_for_function(
        "(text) => document.querySelector('.contents [aria-current]').textContent === text",
        arg=link.inner_text(),
    )
    assert contents.locator("[aria-current]").count() == 1
    # The heading that was led to is below the header.
    top = tab.evaluate(
        "document.getElementById(decodeURIComponent(location.hash.slice(1))).getBoundingClientRect().top"
    )
    assert top >= tab.locator("body > header").bounding_box()["height"]  # type: ignore[index]


def test_tabs_are_chosen_by_keys_and_remembered_on_all_pages(visit: Visit) -> None:
    with_tabs = [path for path in PAGES if "data-tabs" in (visit.folder / path).read_text("utf-8")]
    if not with_tabs:
        pytest.skip("no page has tabs")
    tab = visit.open(with_tabs[0])
    group = tab.locator(".tabs").first
    tabs, panels = group.get_by_role("tab"), group.locator(":scope > [role=tabpanel]")
    assert [each.is_visible() for each in panels.all()][:2] == [True, False]
    tabs.first.focus()
    tab.keyboard.press("ArrowRight")
    assert tabs.nth(1).get_attribute("aria-selected") == "true"
    assert tabs.nth(1).inner_text() in focused(tab)
    assert [each.is_visible() for each in panels.all()][:2] == [False, True]
    assert [each.get_attribute("tabindex") for each in tabs.all()].count("0") == 1
    tab.reload()
    assert tabs.nth(1).get_attribute("aria-selected") == "true"
    tabs.nth(1).press("Home")
    assert tabs.first.get_attribute("aria-selected") == "true"
    assert faults(tab) == []


def test_an_address_opens_the_tab_that_it_names(visit: Visit) -> None:
    with_tabs = [path for path in PAGES if "data-tabs" in (visit.folder / path).read_text("utf-8")]
    if not with_tabs:
        pytest.skip("no page has tabs")
    tab = visit.open(with_tabs[0])
    panels = tab.locator(".tabs").first.locator(":scope > [role=tabpanel]")
    second = panels.nth(1)
    assert not second.is_visible()
    tab.evaluate("(id) => { location.hash = id; }", second.get_attribute("id"))
    second.wait_for(state="visible")
    assert not panels.first.is_visible()
    tab.evaluate("() => { location.hash = '%'; }")
    assert second.is_visible()


# ---------------------------------------------------------------------------- copying


def test_copying_tells_those_who_listen_and_keeps_the_focus(visit: Visit) -> None:
    tab = visit.open("getting-started.html")
    button = tab.locator("button.copy").first
    button.focus()
    tab.keyboard.press("Enter")
    # It says so for a moment: both are looked for at once.
    tab.wait_for_function(
        """(button) => [document.getElementById("announcement"), button]
            .every((each) => each.textContent === "Copied")""",
        arg=button.element_handle(),
    )
    assert tab.locator("#announcement").get_attribute("role") == "status"
    assert "copy" in focused(tab)
    assert tab.evaluate("navigator.clipboard.readText()") == button.get_attribute("data-copy")
    tab.wait_for_function("() => document.activeElement.textContent === 'Copy'")
    assert "copy" in focused(tab)


def test_copying_works_without_the_clipboard_of_the_page(browser: Browser, folder: Path) -> None:
    context = browser.new_context(permissions=["clipboard-read"])
    context.add_init_script("delete Navigator.prototype.clipboard")
    visit = Visit(context, folder)
    tab = visit.open("getting-started.html")
    button = tab.locator("button.copy").first
    button.focus()
    tab.keyboard.press("Enter")
    tab.wait_for_function("() => document.getElementById('announcement').textContent === 'Copied'")
    assert "copy" in focused(tab)
    assert tab.locator("textarea").count() == 0
    visit.end()
    context.close()


# ---------------------------------------------------------------------------- keys, colours, paper


def test_the_first_key_leads_around_the_navigation(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.keyboard.press("Tab")
    assert "Skip to the content" in focused(tab)
    assert tab.get_by_role("link", name="Skip to the content").bounding_box()["x"] >= 0  # type: ignore[index]
    tab.keyboard.press("Enter")
    assert tab.url.endswith("#content")


def test_with_colours_of_the_user_one_sees_where_one_is(browser: Browser, folder: Path) -> None:
    context = browser.new_context(forced_colors="active")
    visit = Visit(context, folder)
    tab = visit.open(MESSAGE)
    width(tab, 1440)
    ground = "(each) => getComputedStyle(each).backgroundColor"
    current = tab.locator("#sidebar [aria-current]")
    other = tab.locator("#sidebar a:not([aria-current])").first
    assert current.evaluate(ground) != other.evaluate(ground)
    # Directions are told by words and arrows.
    assert texts(tab.locator("main .way"))[0].split() == ["host", "→", "to", "controller"]
    assert faults(tab) == []
    visit.end()
    context.close()


def test_the_colours_of_code_can_be_read_in_both_schemes(browser: Browser, folder: Path) -> None:
    """A contrast of 4.5 for every class of code on its ground, by the formula of WCAG."""
    script = """() => {
        const channel = (c) => (c /= 255) <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4;
        const light = (colour) => {
            const [r, g, b] = colour.match(/[\\d.]+/g).map(Number);
            return 0.2126 * channel(r) + 0.7152 * channel(g) + 0.0722 * channel(b);
        };
        const block = document.querySelector(".code pre");
        const code = block.querySelector("code");
        const ground = light(getComputedStyle(block).backgroundColor);
        const names = ["prompt", "printed", "comment", "keyword", "text", "number", "name",
                       "inserted", "deleted", "typed"];
        return Object.fromEntries(names.map((name) => {
            const piece = code.appendChild(document.createElement("span"));
            piece.className = name;
            const ink = light(getComputedStyle(piece).color);
            return [name, (Math.max(ink, ground) + 0.05) / (Math.min(ink, ground) + 0.05)];
        }));
    }"""
    for scheme in ("light", "dark"):
        context = browser.new_context(color_scheme=scheme)
        tab = context.new_page()
        tab.goto((folder / "getting-started.html").as_uri())
        contrasts = tab.evaluate(script)
        assert {name: ratio for name, ratio in contrasts.items() if ratio < 4.5} == {}
        context.close()
