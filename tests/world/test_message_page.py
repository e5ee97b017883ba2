"""The page of a message in a real browser: its tabs, its links, and how it looks after use."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.unit.site.browser import needs_chromium, site_on_disk

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

    from playwright.sync_api import Browser
    from playwright.sync_api import Page as Tab

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return site_on_disk(tmp_path_factory.mktemp("site"))


@pytest.fixture
def tab(browser: Browser) -> Iterator[Tab]:
    """Yield a tab whose pages have thrown nothing in the end."""
    context = browser.new_context()
    thrown: list[str] = []
    context.on("weberror", lambda error: thrown.append(str(error.error)))
    yield context.new_page()
    context.close()
    assert thrown == []


def opened(tab: Tab, folder: Path, message: str) -> None:
    tab.goto((folder / "messages" / f"{message}.html").as_uri())


def chosen(tab: Tab) -> tuple[str, str]:
    """Return the tab that is selected, and the first line of what it shows."""
    name = tab.get_by_role("tab", selected=True).inner_text()
    (code,) = [each for each in tab.locator(".tabs pre").all() if each.is_visible()]
    return name, code.inner_text().split("\n")[0]


CLIENT = ("Client", "from busservo import open_controller")
CODEC = ("Codec", "from busservo import ServoMove")
SHELL = ("Shell", "busservo send --port COM5 ServoMove time_ms=1000 targets=1:800")


def test_tabs_are_chosen_by_keyboard(tab: Tab, folder: Path) -> None:
    opened(tab, folder, "ServoMove")
    assert chosen(tab) == CLIENT
    tab.get_by_role("tab", name="Client").focus()
    for key, expected in [
        ("ArrowRight", CODEC),
        ("ArrowRight", SHELL),
        ("ArrowRight", CLIENT),
        ("ArrowLeft", SHELL),
        ("Home", CLIENT),
        ("End", SHELL),
    ]:
        tab.keyboard.press(key)
        assert chosen(tab) == expected
        assert tab.evaluate("document.activeElement.textContent") == expected[0]


def test_the_choice_is_kept_from_page_to_page(tab: Tab, folder: Path) -> None:
    opened(tab, folder, "ServoMove")
    tab.get_by_role("tab", name="Shell").click()
    opened(tab, folder, "BatteryVoltage")
    assert chosen(tab) == ("Shell", "busservo send --port COM5 BatteryVoltageRead")
    tab.get_by_role("tab", name="Codec").click()
    opened(tab, folder, "ServoMove")
    assert chosen(tab) == CODEC


def test_tabs_work_where_nothing_can_be_kept(tab: Tab, folder: Path) -> None:
    refused = "Object.defineProperty(window, 'localStorage', {get() { throw new Error('no'); }})"
    tab.add_init_script(refused)
    opened(tab, folder, "ServoMove")
    assert chosen(tab) == CLIENT
    tab.get_by_role("tab", name="Shell").click()
    assert chosen(tab) == SHELL


def test_all_code_is_shown_without_a_script_and_on_paper(browser: Browser, folder: Path) -> None:
    context = browser.new_context(java_script_enabled=False)
    page = context.new_page()
    opened(page, folder, "ServoMove")
    titles = [each for each in page.locator(".tabs h3").all() if each.is_visible()]
    assert [title.inner_text().partition("#")[0].strip() for title in titles] == [
        "Client",
        "Codec",
        "Shell",
    ]
    assert all(each.is_visible() for each in page.locator(".tabs pre").all())
    context.close()
    context = browser.new_context()
    page = context.new_page()
    opened(page, folder, "ServoMove")
    page.emulate_media(media="print")
    assert all(each.is_visible() for each in page.locator(".tabs pre").all())
    context.close()


def test_an_erratum_and_its_message_lead_to_each_other(tab: Tab, folder: Path) -> None:
    opened(tab, folder, "ServoUnload")
    tab.locator(".erratum").get_by_role("link", name="Erratum 5").click()
    tab.wait_for_url("**/errata.html#erratum-5")
    tab.locator("section", has=tab.locator("#erratum-5")).get_by_role(
        "link", name="ServoUnload", exact=True
    ).first.click()
    tab.wait_for_url("**/messages/ServoUnload.html#erratum-5")
    assert tab.locator("#erratum-5").is_visible()
