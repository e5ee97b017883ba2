"""The drawings of the guides in a real browser: shown from the disk, and readable."""

from pathlib import Path

import pytest
from playwright.sync_api import Browser

from tests.unit.site.browser import Visit, needs_chromium
from tests.unit.site.test_drawings import DRAWINGS, drawings

pytestmark = needs_chromium

# Of each text, what lies outside of the paper.
OUTSIDE = """() => [...document.querySelectorAll("text")].filter((text) => {
    const box = text.getBBox(), paper = document.querySelector(".paper").getBBox();
    return box.x < paper.x || box.x + box.width > paper.x + paper.width - 4 ||
        box.y < paper.y || box.y + box.height > paper.y + paper.height;
}).map((text) => text.textContent)"""
# Of each picture, its name, whether it was loaded, and whether it fits.
PICTURES = """() => [...document.images].map((image) => [
    image.src.split("/").pop(),
    image.naturalWidth > 0 && image.getBoundingClientRect().right <= innerWidth,
])"""


@drawings
def test_no_words_leave_the_paper(browser: Browser, drawing: Path) -> None:
    tab = browser.new_page()
    tab.goto(drawing.as_uri())
    assert tab.evaluate(OUTSIDE) == []
    tab.close()


@pytest.mark.parametrize("width", [380, 1440])
def test_the_policy_of_a_page_lets_its_drawings_show(visit: Visit, width: int) -> None:
    visit.tab.set_viewport_size({"width": width, "height": 900})
    shown = visit.open("getting-started.html").evaluate(PICTURES)
    order = ["adapter", "header", "hid", "servos"]
    assert shown == [[f"wiring-{each}.svg", True] for each in order]
    assert order == sorted(drawing.stem.removeprefix("wiring-") for drawing in DRAWINGS)
