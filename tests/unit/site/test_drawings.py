"""The pictures of the guides: drawings that are small, described and inert, and screenshots."""

import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest

from tests.documents import ROOT
from tests.in_turn import in_turn
from tests.screenshots import IMAGES, LARGEST, SCREENSHOTS, Screenshot

DRAWINGS = sorted((ROOT / "docs" / "images").glob("wiring-*.svg"))
# Drawn by the commands of guides, which tests/world/test_guides.py runs.
PLOTS = {"plot-arm.svg"}
GUIDES = "\n".join(file.read_text("utf-8") for file in (ROOT / "docs").glob("*.md"))
SVG = "{http://www.w3.org/2000/svg}"
# What draws, and nothing that loads, runs or leads anywhere.
ELEMENTS = {"svg", "title", "desc", "style", "g", "rect", "circle", "path", "text"}

drawings = pytest.mark.parametrize("drawing", DRAWINGS, ids=lambda file: file.stem)


@drawings
def test_a_drawing_is_described_fits_a_phone_and_only_draws(drawing: Path) -> None:
    root = ET.parse(drawing).getroot()  # noqa: S314 - our own file
    ids = [root[0].get("id"), root[1].get("id")]
    assert (root[0].tag, root[1].tag, root.get("role")) == (f"{SVG}title", f"{SVG}desc", "img")
    assert root.get("aria-labelledby") == " ".join(map(str, ids))
    assert all((each.text or "").strip() for each in root[:2])
    assert {each.tag.removeprefix(SVG) for each in root.iter()} <= ELEMENTS
    names = {name for each in root.iter() for name in each.attrib}
    assert not {name for name in names if name.startswith("on") or "href" in name}
    assert not re.search(r"url\(|@import", drawing.read_text("utf-8"))
    width, height = root.get("width"), root.get("height")
    assert root.get("viewBox") == f"0 0 {width} {height}"
    # Its letters, of 13 px, are still read at 380 px.
    assert int(width or 0) <= 480
    assert drawing.stat().st_size < 5_000


@drawings
def test_a_guide_shows_the_drawing_and_says_in_words_what_is_on_it(drawing: Path) -> None:
    alternatives = re.findall(rf"!\[([^]]+)\]\(images/{drawing.name}\)", GUIDES)
    assert alternatives
    assert all(len(words) > 40 for words in alternatives)


@in_turn("each", lambda: SCREENSHOTS)
def test_the_readme_shows_a_screenshot_that_is_small(each: Screenshot) -> None:
    readme = (ROOT / "README.md").read_text("utf-8")
    assert f"docs/images/{each.name}" in readme
    assert (IMAGES / each.name).stat().st_size <= LARGEST


def test_there_are_drawings_of_all_ways_to_wire_a_board_and_no_other_pictures() -> None:
    ways = ["adapter", "header", "hid", "servos"]
    assert [drawing.stem for drawing in DRAWINGS] == [f"wiring-{way}" for way in ways]
    names = {drawing.name for drawing in DRAWINGS} | {each.name for each in SCREENSHOTS}
    assert {file.name for file in IMAGES.iterdir()} == names | PLOTS | {"preview.png"}
