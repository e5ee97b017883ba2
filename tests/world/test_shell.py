"""The pages of the site in a real browser: what every page has, and the page of a message."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser, BrowserContext
from playwright.sync_api import Page as Tab

from tests.factories import write_files
from tests.unit.site.browser import Visit, arrives, decoded, needs_chromium, texts
from tests.unit.site.looks import faults
from tests.unit.site.reference import reference
from tests.unit.site.test_hostile_pages import hostile
from tests.world.conftest import visiting

REFERENCE = "reference/busservo"
MESSAGE = f"{REFERENCE}/messages/ServoMove.html"
GUIDE = "getting-started.html"
PAGES = ["index.html", GUIDE, "project/contributing.html", MESSAGE]
NAMES = [path for path in reference("busservo").pages if "/" not in path]

pytestmark = needs_chromium


def width(tab: Tab, pixels: int, height: int = 900) -> None:
    tab.set_viewport_size({"width": pixels, "height": height})


def focused(tab: Tab) -> str:
    return str(tab.evaluate("document.activeElement.outerHTML.slice(0, 120)"))


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


# ---------------------------------------------------------------------------- the sidebar, contents


def test_on_a_wide_display_the_sidebar_shows_where_one_is(visit: Visit) -> None:
    tab = visit.open("reference/lxservo/messages/VoltageRead.html")
    width(tab, 1440)
    sidebar = tab.get_by_role("navigation", name="Documentation")
    current = sidebar.locator("[aria-current=page]")
    assert "VoltageRead" in texts(current)[0]
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


def test_the_contents_mark_what_is_being_read(visit: Visit) -> None:
    tab = visit.open(GUIDE)
    width(tab, 1440)
    contents = tab.get_by_role("navigation", name="On this page")
    link = contents.get_by_role("link").nth(5)
    link.click()
    tab.wait_for_function(
        "(text) => document.querySelector('.contents [aria-current]')?.textContent === text",
        arg=link.inner_text(),
    )
    assert contents.locator("[aria-current]").count() == 1
    # The heading that was led to is below the header.
    top = tab.evaluate(
        "document.getElementById(decodeURIComponent(location.hash.slice(1))).getBoundingClientRect().top"
    )
    assert top >= tab.locator("body > header").bounding_box()["height"]  # type: ignore[index]


def test_the_first_key_leads_around_the_navigation(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.keyboard.press("Tab")
    assert "Skip to the content" in focused(tab)
    assert tab.get_by_role("link", name="Skip to the content").bounding_box()["x"] >= 0  # type: ignore[index]
    tab.keyboard.press("Enter")
    assert tab.url.endswith("#content")


def test_the_front_page_leads_to_the_reference(context: BrowserContext, tmp_path: Path) -> None:
    write_files({path: page.text for path, page in reference("busservo").site.items()}, tmp_path)
    visit = Visit(context, tmp_path)
    tab = visit.open("index.html")
    tab.get_by_role("main").get_by_role("link", name="Every documented frame").click()
    arrives(tab, "busservo/examples.html")
    assert tab.get_by_role("searchbox").is_visible()
    visit.end()


def test_anchors_land(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.get_by_role("link", name="Link to targets[i].position").click()
    arrives(tab, "#field-targets-position")
    top = tab.locator("#field-targets-position").bounding_box()
    assert top is not None
    assert 0 <= top["y"] < 720
    tab.get_by_role("link", name="targets[i].position in the spec").click()
    arrives(tab, "spec.html#messages.ServoMove.fields.targets.fields.position")
    line = tab.locator(":target").inner_text()
    assert line.strip().endswith("position:")


def test_an_erratum_and_its_message_lead_to_each_other(visit: Visit) -> None:
    tab = visit.open(f"{REFERENCE}/messages/ServoUnload.html")
    tab.locator(".erratum").get_by_role("link", name="Erratum 5").click()
    tab.wait_for_url("**/errata.html#erratum-5")
    erratum = tab.locator("section", has=tab.locator("#erratum-5"))
    erratum.get_by_role("link", name="ServoUnload", exact=True).first.click()
    tab.wait_for_url("**/messages/ServoUnload.html#erratum-5")
    assert tab.locator("#erratum-5").is_visible()


# ---------------------------------------------------------------------------- tabs

CLIENT = ("Client", "from busservo import open_controller")
CODEC = ("Codec", "from busservo import ServoMove")
SHELL = ("Shell", "busservo send --port COM5 ServoMove time_ms=1000 targets=1:800")
KEYS = [
    *(("ArrowRight", CODEC), ("ArrowRight", SHELL), ("ArrowRight", CLIENT)),
    *(("ArrowLeft", SHELL), ("Home", CLIENT), ("End", SHELL)),
]


def chosen(tab: Tab) -> tuple[str, str]:
    """Return the tab that is selected, and the first line of what it shows."""
    name = tab.get_by_role("tab", selected=True).inner_text()
    (code,) = [each for each in tab.locator(".tabs pre").all() if each.is_visible()]
    return name, code.inner_text().split("\n")[0]


def test_tabs_are_chosen_by_keyboard(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.evaluate("localStorage.clear()")
    tab.reload()
    assert chosen(tab) == CLIENT
    tab.get_by_role("tab", name="Client").focus()
    for key, expected in KEYS:
        tab.keyboard.press(key)
        assert chosen(tab) == expected
        assert tab.evaluate("document.activeElement.textContent") == expected[0]
        stops = [each.get_attribute("tabindex") for each in tab.get_by_role("tab").all()]
        assert stops.count("0") == 1
    assert faults(tab) == []


def test_the_choice_of_a_tab_is_kept_from_page_to_page(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.get_by_role("tab", name="Shell").click()
    tab = visit.open(f"{REFERENCE}/messages/BatteryVoltage.html")
    assert chosen(tab) == ("Shell", "busservo send --port COM5 BatteryVoltageRead")
    tab.get_by_role("tab", name="Codec").click()
    assert chosen(visit.open(MESSAGE)) == CODEC


def test_tabs_work_where_nothing_can_be_kept(browser: Browser, folder: Path) -> None:
    refused = "Object.defineProperty(window, 'localStorage', {get() { throw new Error('no'); }})"
    with visiting(browser, folder, refused) as visit:
        tab = visit.open(MESSAGE)
        assert chosen(tab) == CLIENT
        tab.get_by_role("tab", name="Shell").click()
        assert chosen(tab) == SHELL


def test_an_address_opens_the_tab_that_it_names(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    tab.get_by_role("tab").first.click()
    panels = tab.locator(".tabs").first.locator(":scope > [role=tabpanel]")
    second = panels.nth(1)
    assert not second.is_visible()
    tab.evaluate("(id) => { location.hash = id; }", second.get_attribute("id"))
    second.wait_for(state="visible")
    assert not panels.first.is_visible()
    tab.evaluate("() => { location.hash = '%'; }")
    assert second.is_visible()


# ---------------------------------------------------------------------------- copying

MOVE = "55 55 08 03 01 E8 03 01 20 03"
BUTTONS = [("Copy hex", MOVE), ("Copy as Python", f'bytes.fromhex("{MOVE}")')]


@pytest.mark.parametrize(("label", "text"), BUTTONS)
def test_copying(visit: Visit, label: str, text: str) -> None:
    tab = visit.open(MESSAGE)
    # It says so for a moment, which a busy machine might miss: here, until the page is closed.
    tab.evaluate("() => { window.setTimeout = () => 0; }")
    tab.locator("button.copy", has_text=label).first.click()
    tab.locator("button.copy", has_text="Copied").wait_for()
    assert tab.evaluate("navigator.clipboard.readText()") == text


def test_copying_tells_those_who_listen_and_keeps_the_focus(visit: Visit) -> None:
    tab = visit.open(GUIDE)
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


@pytest.mark.parametrize(
    "script",
    [
        "delete Navigator.prototype.clipboard",
        "Clipboard.prototype.writeText = () => Promise.reject(new Error())",
    ],
)
def test_copying_works_without_the_clipboard_of_the_page(
    browser: Browser, folder: Path, script: str
) -> None:
    with visiting(browser, folder, script, permissions=["clipboard-read"]) as visit:
        tab = visit.open(GUIDE)
        button = tab.locator("button.copy").first
        button.focus()
        tab.keyboard.press("Enter")
        tab.wait_for_function(
            "() => document.getElementById('announcement').textContent === 'Copied'"
        )
        copied = None if "delete" in script else button.get_attribute("data-copy")
        assert tab.evaluate("navigator.clipboard?.readText()") == copied
        assert "copy" in focused(tab)
        assert tab.locator("textarea").count() == 0


# ---------------------------------------------------------------------------- looks


def test_the_cells_of_a_strip_wrap_on_a_phone(visit: Visit) -> None:
    tab = visit.open(MESSAGE)
    rows = {}
    for pixels in (1440, 380):
        width(tab, pixels)
        cells = tab.locator(".strip").first.locator("li")
        rows[pixels] = len({box["y"] for cell in cells.all() if (box := cell.bounding_box())})
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


def test_paper_has_all_code_no_navigation_and_breaks_no_strip(visit: Visit) -> None:
    visit.open(MESSAGE)
    visit.tab.emulate_media(media="print", color_scheme="dark")
    assert visit.style("nav", "display") == "none"
    assert visit.style(".actions", "display") == "none"
    assert visit.style("body", "backgroundColor") == "rgb(255, 255, 255)"
    for selector in (".strip", ".strip li", "tbody tr"):
        assert visit.style(selector, "breakInside") == "avoid"
    assert all(each.is_visible() for each in visit.tab.locator(".tabs pre").all())


def test_without_a_script_all_can_be_read_and_reached(unscripted: Visit) -> None:
    tab = unscripted.open(f"{REFERENCE}/index.html")
    assert tab.locator("main tbody tr:visible").count() >= 12
    assert not tab.locator("#search").is_visible()
    tab = unscripted.open(f"{REFERENCE}/decoder.html")
    assert tab.get_by_text("This page needs JavaScript").is_visible()
    assert not tab.locator("#hex").is_visible()
    for pixels in (380, 1440):
        width(tab, pixels)
        unscripted.open(MESSAGE)
        assert "E8 03" in tab.locator("#example-1 .strip").first.inner_text()
        titles = [each for each in tab.locator(".tabs h3").all() if each.is_visible()]
        assert [title.inner_text().partition("#")[0].strip() for title in titles] == [
            name for name, _ in (CLIENT, CODEC, SHELL)
        ]
        assert all(each.is_visible() for each in tab.locator(".tabs pre").all())
        assert [each for each in tab.locator("button.copy").all() if each.is_visible()] == []
        if pixels == 380:
            tab.get_by_role("button", name="Menu").click()
        tab.locator("#sidebar").get_by_role("link", name="Getting started").click()
        assert tab.url.endswith(GUIDE)


def test_a_page_alone_looks_as_in_its_folder(visit: Visit, tmp_path: Path) -> None:
    """As somebody sees it who was sent one page by mail."""
    alone = Visit(visit.tab.context, tmp_path)
    (tmp_path / "page.html").write_bytes((visit.folder / MESSAGE).read_bytes())
    shots = [
        each.open(path).screenshot() for each, path in ((visit, MESSAGE), (alone, "page.html"))
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


def test_with_colours_of_the_user_one_sees_where_one_is(browser: Browser, folder: Path) -> None:
    with visiting(browser, folder, forced_colors="active") as visit:
        tab = visit.open(MESSAGE)
        width(tab, 1440)
        ground = "(each) => getComputedStyle(each).backgroundColor"
        current = tab.locator("#sidebar [aria-current]")
        other = tab.locator("#sidebar a:not([aria-current])").first
        assert current.evaluate(ground) != other.evaluate(ground)
        # Directions are told by words and arrows.
        assert texts(tab.locator("main .way"))[0].split() == ["host", "→", "to", "controller"]
        assert faults(tab) == []


# By class of code, its contrast to its ground, by the formula of WCAG.
CONTRASTS = """() => {
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


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_the_colours_of_code_can_be_read_in_both_schemes(visit: Visit, scheme: str) -> None:
    visit.tab.emulate_media(color_scheme=scheme)  # type: ignore[arg-type]
    contrasts = visit.open(GUIDE).evaluate(CONTRASTS)
    assert {name: ratio for name, ratio in contrasts.items() if ratio < 4.5} == {}
