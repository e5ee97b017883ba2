"""What readers do with the pages of the site: a table of pages, and of uses."""

import random
import re
from collections.abc import Callable

from playwright.sync_api import Page as Tab

from tests.unit.site.reference import ROOT

CAPTURE = (ROOT / "tests" / "captures" / "cut_off.hex").read_text("utf-8")
MOVE = "55 55 08 03 01 E8 03 01 20 03"

WORKBENCH = "reference/busservo/decoder.html"
SERVO_MOVE = "reference/busservo/messages/ServoMove.html"
GUIDE = "getting-started.html"


def nothing(tab: Tab) -> None:
    """Read."""
    assert tab.locator("h1").is_visible()


# ---------------------------------------------------------------------------- searching


def searched(query: str) -> Callable[[Tab], None]:
    """Return the use of one who types a query in the search."""

    def search(tab: Tab) -> None:
        tab.locator("#search-words").fill(query)
        assert tab.locator("#search-count").inner_text()

    return search


# ---------------------------------------------------------------------------- the workbench


def noise(many: int) -> str:
    """Return bytes in hex, of which no run of some length is a frame."""
    values = random.Random(13).choices([0x00, 0x7F, 0xA5, 0xC3, 0xFF], k=many)  # noqa: S311
    return bytes(values).hex(" ")


def decoded(text: str) -> Callable[[Tab], None]:
    """Return the use of one who pastes a capture, and looks at each kind of what is in it."""

    def decode(tab: Tab) -> None:
        tab.get_by_label("A capture").fill(text)
        rows = tab.locator("#events [role=option]")
        rows.last.wait_for()
        tab.wait_for_function("() => document.getElementById('progress').hidden")
        rows.nth(rows.count() // 2).click()
        assert tab.locator("#event").is_visible()
        for button in tab.locator("#event .dump button").all():
            button.click()

    return decode


def unreadable(tab: Tab) -> None:
    """Paste what are no bytes, and much of it, in one word."""
    tab.get_by_label("A capture").fill("Unreadable" * 400)
    tab.locator("#problem").wait_for()
    tab.get_by_role("button", name="Show the place").click()


def encoded_wrong(tab: Tab) -> None:
    """Type what the encoder does not understand."""
    tab.get_by_label("Message").select_option("ServoMove")
    tab.locator("#words").fill(f"time_ms={'9' * 200} targets=1:2:3,{'x' * 200}:1")
    assert tab.locator("#encoder-problem").inner_text()


def encoded_long(tab: Tab) -> None:
    """Encode as many items as a frame has room for."""
    tab.get_by_label("Message").select_option("ServoMove")
    items = ",".join(f"{number}:{number}" for number in range(1, 84))
    tab.locator("#words").fill(f"time_ms=1000 targets={items}")
    assert tab.locator("#encoded").inner_text().startswith("55 55 FE 03 53")
    tab.get_by_role("button", name="Decode it").click()


# ---------------------------------------------------------------------------- a message's page


def tabs_opened(tab: Tab) -> None:
    """Open each tab, from the first to the last."""
    tabs = tab.get_by_role("tab")
    assert tabs.count() > 1
    for each in tabs.all():
        each.click()


def fields_wrong(tab: Tab) -> None:
    """Type into each field what no frame can carry."""
    for each in tab.locator("#live-fields input").all():
        each.fill("9" * 60 + " and a word")
    assert tab.locator("#live-fields [aria-invalid=true]").count() >= 1


def fields_many(tab: Tab) -> None:
    """Add items until no frame has room for more."""
    add = tab.get_by_role("button", name="Add an item")
    tab.evaluate(
        "(button) => { for (let i = 0; i < 90 && !button.disabled; i += 1) button.click(); }",
        add.element_handle(),
    )
    assert tab.locator("#live-fields li").count() >= 80


def bytes_wrong(tab: Tab) -> None:
    """Type bytes that are another frame, and many."""
    tab.locator("#live-hex").fill("55 55 09 03 01 E8 " + "03 01 20 03 " * 60)
    assert tab.locator("#live-status").inner_text().startswith("Not ")


# ---------------------------------------------------------------------------- any page


def menu_opened(tab: Tab) -> None:
    """Open the menu of a phone, and all that folds in it."""
    tab.set_viewport_size({"width": 380, "height": 900})
    tab.get_by_role("button", name="Menu").click()
    assert tab.locator("#sidebar").is_visible()
    details_opened(tab)


def details_opened(tab: Tab) -> None:
    """Unfold all that folds."""
    tab.evaluate("document.querySelectorAll('details').forEach((each) => { each.open = true; })")


def copied(tab: Tab) -> None:
    """Press a button that copies."""
    tab.get_by_role("button", name=re.compile("^Copy")).first.click()
    tab.wait_for_function("() => document.getElementById('announcement').textContent")


# The name of a use, its page, and what is done there.
USES: dict[str, tuple[str, Callable[[Tab], None]]] = {
    "the front page": ("index.html", details_opened),
    "search a word": ("search.html", searched("servo")),
    "search nothing": ("search.html", nothing),
    "search bytes": ("search.html", searched(MOVE)),
    "search in vain": ("search.html", searched("w" * 300)),
    "search with a slip": ("search.html", searched("batery")),
    "search bytes of both ways": ("search.html", searched("55 55 05 06 08 01 00")),
    "search many words": ("search.html", searched("a b " * 999)),
    "search many bytes": ("search.html", searched("55" * 400)),
    "noise of 200 bytes": (WORKBENCH, decoded(noise(200))),
    "noise of 2000 bytes": (WORKBENCH, decoded(f"{MOVE} {noise(2000)} {MOVE}")),
    "300 kB pasted": (WORKBENCH, decoded(f"{MOVE}\n" * 10_000)),
    "a good capture": (WORKBENCH, decoded(CAPTURE)),
    "a good capture of servos": (
        "reference/lxservo/decoder.html",
        decoded("55 55 01 07 01 F4 01 E8 03 16"),
    ),
    "unreadable text": (WORKBENCH, unreadable),
    "encoder wrong": (WORKBENCH, encoded_wrong),
    "encoder with 83 items": (WORKBENCH, encoded_long),
    "workbench unfolded": (WORKBENCH, details_opened),
    "tabs": (SERVO_MOVE, tabs_opened),
    "fields wrong": (SERVO_MOVE, fields_wrong),
    "fields with many items": (SERVO_MOVE, fields_many),
    "bytes wrong": (SERVO_MOVE, bytes_wrong),
    "menu of a message": (SERVO_MOVE, menu_opened),
    "menu of a guide": (GUIDE, menu_opened),
    "copy in a guide": (GUIDE, copied),
    "copy on a message": (SERVO_MOVE, copied),
    "versions": ("reference/busservo/changelog.html", details_opened),
    "an older edition": ("reference/lxservo/1.0.0/index.html", details_opened),
    "a message of an older edition": (
        "reference/busservo/1.0.0/messages/ServoMove.html",
        tabs_opened,
    ),
    "nothing there": ("404.html", nothing),
    "a page of the project": ("project/contributing.html", copied),
    "the spec": ("reference/busservo/spec.html", nothing),
    "downloads": ("reference/busservo/downloads.html", details_opened),
    "cheat sheet": ("reference/busservo/cheatsheet.html", nothing),
}
