"""The search in a real browser: from the box of any page to what was looked for, and back.

tests/unit/site/test_search.py has what is found; this has what is shown of it.
"""

import re
from pathlib import Path
from typing import Any
from urllib.parse import parse_qs, urlsplit

import pytest
from playwright.sync_api import BrowserContext
from playwright.sync_api import Page as Tab

from tests.factories import write_files
from tests.unit.site.browser import Visit, arrives, needs_chromium, texts
from tests.unit.site.test_hostile_pages import hostile

PAGES = [
    "index.html",
    "getting-started.html",
    "reference/busservo/spec.html",
    "reference/lxservo/messages/Move.html",
]

pytestmark = needs_chromium


def box(tab: Tab) -> Any:
    return tab.get_by_role("searchbox")


def focused(tab: Tab) -> str:
    script = "document.activeElement.id || document.activeElement.textContent"
    return str(tab.evaluate(script))


def titles(tab: Tab) -> list[str]:
    return texts(tab.locator("#search-results .found-title a"))


def said(tab: Tab) -> str:
    return tab.locator("#search-count").inner_text().strip()


def asked(tab: Tab) -> dict[str, list[str]]:
    return parse_qs(urlsplit(tab.url).query)


def kept(tab: Tab, query: str) -> None:
    """Wait until the address has the query, which it is given a moment after the last key."""
    tab.wait_for_function("(q) => new URLSearchParams(location.search).get('q') === q", arg=query)


# ---------------------------------------------------------------------------- the box


@pytest.mark.parametrize("path", PAGES)
def test_the_box_of_a_page_hands_over_what_is_typed(visit: Visit, path: str) -> None:
    tab = visit.open(path)
    tab.keyboard.press("/")
    assert focused(tab) == "search-words"
    tab.keyboard.type("voltage & battery/+")
    tab.keyboard.press("Enter")
    tab.wait_for_url(re.compile(r"search\.html\?"))
    assert asked(tab) == {"q": ["voltage & battery/+"]}
    assert box(tab).input_value() == "voltage & battery/+"
    assert set(titles(tab)[:2]) == {"BatteryVoltageRead", "BatteryVoltage"}
    tab.go_back()
    arrives(tab, path)


def test_slash_is_a_letter_where_one_types_and_escape_leaves(visit: Visit) -> None:
    tab = visit.open("getting-started.html")
    tab.keyboard.press("/")
    tab.keyboard.type("8/1")
    assert box(tab).input_value() == "8/1"
    tab.keyboard.press("Escape")
    assert focused(tab) != "search-words"
    assert box(tab).input_value() == "8/1"
    tab.keyboard.press("Control+/")
    assert focused(tab) != "search-words"
    tab.keyboard.press("/")
    assert focused(tab) == "search-words"


def test_an_empty_box_leads_to_the_index(visit: Visit) -> None:
    tab = visit.open("index.html")
    box(tab).press("Enter")
    arrives(tab, "search.html")
    assert tab.locator("#search-letters").is_visible()
    assert said(tab).endswith("places to find.")


# ---------------------------------------------------------------------------- the page


def test_results_come_as_one_types_and_the_address_keeps_them(visit: Visit) -> None:
    tab = visit.open("search.html")
    assert focused(tab) == "search-words"
    seen = []
    for letter in "limp":
        tab.keyboard.type(letter)
        seen.append(titles(tab)[:1])
    assert seen[-1] == ["ServoUnload"]
    assert said(tab) == f"{len(titles(tab))} found for “limp”."
    assert not tab.locator("#search-letters").is_visible()
    assert texts(tab.locator("#search-results mark"))[0] == "limp"
    kept(tab, "limp")
    assert tab.title().startswith("limp")


def test_a_search_is_there_again_on_going_back(visit: Visit) -> None:
    tab = visit.open("search.html")
    box(tab).fill("position")
    before = titles(tab)
    for _ in range(3):
        tab.keyboard.press("ArrowDown")
    third = focused(tab)
    assert third == before[2]
    tab.keyboard.press("Enter")
    tab.wait_for_url(re.compile("reference/"))
    tab.go_back()
    tab.wait_for_url(re.compile(r"search\.html\?q=position$"))
    assert box(tab).input_value() == "position"
    assert titles(tab) == before
    assert focused(tab) == third


def test_enter_goes_to_the_first_and_arrows_to_the_others(visit: Visit) -> None:
    tab = visit.open("search.html?q=ServoMove")
    tab.keyboard.press("ArrowDown")
    assert focused(tab) == "ServoMove"
    tab.keyboard.press("ArrowDown")
    assert focused(tab) == titles(tab)[1]
    tab.keyboard.press("ArrowUp")
    tab.keyboard.press("ArrowUp")
    assert focused(tab) == "search-words"
    tab.keyboard.press("Enter")
    arrives(tab, "reference/busservo/messages/ServoMove.html")


def test_what_is_shown_is_of_the_chosen_kind(visit: Visit) -> None:
    tab = visit.open("search.html?q=percent")
    tab.get_by_role("radio", name=re.compile("^Errata")).check()
    count = int(
        tab.get_by_role("radio", name=re.compile("^Errata")).evaluate(
            "(radio) => radio.parentElement.querySelector('.count').textContent"
        )
    )
    assert said(tab) == f"{count} found for “percent” in errata."
    assert len(titles(tab)) == min(count, 30)
    kept(tab, "percent")
    tab.get_by_role("radio", name="LX-16A servo bus").check()
    assert said(tab) == "Nothing found for “percent” in errata."
    tab.wait_for_function("() => location.search.includes('in=lxservo')")
    tab.reload()
    assert said(tab) == "Nothing found for “percent” in errata."
    tab.get_by_role("button", name="Search all kinds and protocols").click()
    assert titles(tab)
    assert not tab.locator("#search-advice").is_visible()


def test_more_is_shown_on_demand(visit: Visit) -> None:
    tab = visit.open("search.html?q=servo")
    assert len(titles(tab)) == 30
    tab.get_by_role("button", name="Show more").click()
    assert len(titles(tab)) == 60
    assert focused(tab) == titles(tab)[30]


# What is searched for, what is said of it, and the titles that come first.
SAID: list[tuple[str, str, list[str]]] = [
    (
        "batery",
        r"Nothing has “batery”\. [0-9]+ found instead for battery.*",
        ["BatteryVoltageRead"],
    ),
    ("battery xyzzy", r"No page has “xyzzy”\. [0-9]+ found without it\.", ["BatteryVoltageRead"]),
    ("servo xyzzy", r"Nothing found for “servo xyzzy”\. No page has “xyzzy”\.", []),
    ("falls down when torque is off", r"[0-9]+ found for “falls down when torque is off”\.", []),
    ("9600", ".*9600.*", []),
    ("dead beef", "Nothing has “dead beef”.*", []),
    ("01e803", ".*found for 3 bytes.", []),
    ("55550207", ".*", ["ActionGroupStop", "ActionGroupStopped"]),
    ("55 55 05 06 08 01 00", ".*", ["ActionGroupRun", "ActionGroupStarted"]),
    ("55 55 02 0", r".*The last digit, 0, is half a byte\.", []),
    ("55 55 09 03 01 E8 03 01 20 03", r"10 bytes, and no whole frame\.", []),
    ("55 55 0G 02", r"“0G” is no byte in hex\.", []),
    ("11 22 33", r"Nothing found for 3 bytes\.", []),
    ("xyzzy", r"Nothing found for “xyzzy”\.", []),
]


def test_the_page_says_what_was_found_and_how_a_query_was_read(visit: Visit) -> None:
    tab = visit.open("search.html")
    for query, words, first in SAID:
        box(tab).fill(query)
        assert re.fullmatch(words, said(tab)), (query, said(tab))
        assert titles(tab)[: len(first)] == first, query
    for query in ("batery", "servo xyzzy"):
        box(tab).fill(query)
        assert tab.locator("#search-advice").is_visible()
    box(tab).fill("9600")
    assert "Nothing comes back" in titles(tab)
    box(tab).fill("55 55 05 06 08 01 00")
    assert "group 8, times 1" in tab.locator("#search-results > li").first.inner_text()
    box(tab).fill("55 55 09 03 01 E8 03 01 20 03")
    assert "with that they are ServoMove" in tab.locator("#search-results").inner_text()


def test_a_slip_is_corrected(visit: Visit) -> None:
    found = len(titles(visit.open("search.html?q=battery")))
    tab = visit.open("search.html?q=batery")
    assert len(titles(tab)) == found
    tab.get_by_role("button", name="battery").click()
    assert box(tab).input_value() == "battery"
    assert not tab.locator("#search-advice").is_visible()


def test_no_hit_gives_advice(visit: Visit) -> None:
    tab = visit.open("search.html?q=xyzzy")
    assert titles(tab) == []
    advice = tab.locator("#search-advice")
    assert advice.is_visible()
    for name in ("the workbench", "look-alikes", "Troubleshooting", "What people call it"):
        assert advice.get_by_role("link", name=name).first.is_visible()


def test_bytes_of_no_frame_are_taken_to_the_workbench(visit: Visit) -> None:
    tab = visit.open("search.html?q=11 22 33")
    tab.locator("#search-advice").get_by_role("link", name="the workbench").first.click()
    arrives(tab, "reference/busservo/decoder.html?hex=112233")


# ---------------------------------------------------------------------------- bytes


def test_bytes_find_the_frame_and_offer_to_decode_it(visit: Visit) -> None:
    tab = visit.open("index.html")
    tab.keyboard.press("/")
    tab.keyboard.type("55 55 02 0F")
    tab.keyboard.press("Enter")
    tab.wait_for_url(re.compile("search"))
    assert said(tab) == "2 found for 4 bytes."
    first = tab.locator("#search-results > li").first
    assert "BatteryVoltageRead" in first.inner_text()
    assert "host to controller" in first.inner_text()
    first.get_by_role("link", name="Decode it in the workbench").click()
    tab.wait_for_url(re.compile(r"reference/busservo/decoder\.html\?hex=5555020f"))


def test_a_part_of_a_frame_is_marked_where_it_stands(visit: Visit) -> None:
    tab = visit.open("search.html?q=03 01 E8")
    assert titles(tab)[0] == "Servo 1 to position 800 in 1000 ms"
    code = tab.locator("#search-results code").first
    assert code.inner_text() == "55 55 08 03 01 E8 03 01 20 03"
    assert code.locator("mark").inner_text() == "03 01 E8"


# ---------------------------------------------------------------------------- for everybody


def test_without_a_script_the_page_lists_everything(unscripted: Visit) -> None:
    tab = unscripted.open("reference/busservo/messages/ServoMove.html")
    assert not box(tab).is_visible()
    tab.get_by_role("link", name="Search and index").click()
    arrives(tab, "search.html")
    assert not tab.locator("#search-form").is_visible()
    assert tab.get_by_text("Without JavaScript").is_visible()
    assert tab.locator("#search-letters a").count() > 500
    tab.locator("#search-letters").get_by_role("link", name="ServoUnload", exact=True).click()
    arrives(tab, "reference/busservo/messages/ServoUnload.html")


def test_the_keyboard_alone_reaches_every_choice(visit: Visit) -> None:
    tab = visit.open("search.html?q=battery")
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.name") == "search-kinds"
    tab.keyboard.press("ArrowRight")
    assert tab.locator("#search-kinds input:checked").input_value() == "message"
    assert titles(tab) == ["BatteryVoltageRead", "BatteryVoltage"]
    tab.keyboard.press("Tab")
    assert tab.evaluate("document.activeElement.name") == "search-protocols"
    tab.keyboard.press("Tab")
    assert focused(tab) == "BatteryVoltageRead"
    tab.keyboard.press("/")
    assert focused(tab) == "search-words"


def test_nothing_of_a_hostile_spec_runs(context: BrowserContext, tmp_path: Path) -> None:
    site = hostile()
    write_files({path: page.text for path, page in site.site.items()}, tmp_path)
    visit = Visit(context, tmp_path)
    visit.tab.on("dialog", lambda dialog: visit.troubles.append(dialog.message))
    tab = visit.open("search.html")
    for query in [
        *("script", "onmouseover", "evil", "servo", "55 55 08 03 01 E8 03 01 20 03", "<img>"),
    ]:
        box(tab).fill(query)
        assert titles(tab) or query == "<img>"
        assert tab.locator("main img, main script, main style").count() == 0
    visit.end()
