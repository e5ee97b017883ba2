"""Every page of the site, looked at after use: one table of uses, and one of what is looked at."""

import re
from pathlib import Path
from typing import Any

import pytest
from busservo_simulator import VirtualController
from playwright.sync_api import Browser
from playwright.sync_api import Page as Tab

from tests.unit.site import looks
from tests.unit.site.browser import MILLISECONDS, Visit, needs_chromium, project_on_disk
from tests.unit.site.reference import NODE_MODULES
from tests.unit.site.serial_host import LiveTab, SerialHost, VirtualEnd
from tests.unit.site.uses import GUIDE, SERVO_MOVE, USES, WORKBENCH
from tests.world.conftest import visiting

AXE = NODE_MODULES / "axe-core" / "axe.min.js"
KINDS = ["index.html", "search.html", GUIDE, WORKBENCH, SERVO_MOVE]
# Of older editions, messages have the templates that they have in the newest.
PARTS = [f"reference/{name}" for name in ("busservo", "lxservo")]
GROUPS = ["", "project", *(f"{part}{end}" for part in PARTS for end in ("", "/messages", "/1.0.0"))]

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the site of this project, as it is published."""
    folder = tmp_path_factory.mktemp("stick") / "the site"
    return project_on_disk(folder, "--base", "https://docs.example/")


def opened(visit: Visit, use: str) -> Tab:
    """Return the tab after this use."""
    page, act = USES[use]
    tab = visit.open(page)
    act(tab)
    return tab


def judged(tab: Tab) -> list[tuple[str, str]]:
    """Return what axe finds in both schemes of colours, targets that are too small included."""
    tab.evaluate(f"if (!window.axe) {{ {AXE.read_text('utf-8')} }}; 0")
    tab.emulate_media(color_scheme="light")
    found = looks.violations(tab, {"rules": {"target-size": {"enabled": True}}})
    # Of the dark page, nothing but the colours differs.
    tab.emulate_media(color_scheme="dark")
    found += looks.violations(tab, {"runOnly": ["color-contrast"]})
    tab.emulate_media(color_scheme="light")
    return found


@pytest.mark.parametrize("group", GROUPS)
def test_every_page_is_whole_at_every_width_and_on_paper(visit: Visit, group: str) -> None:
    found = {}
    pages = sorted((visit.folder / group).glob("*.html"))
    assert pages
    for page in pages:
        tab = visit.open(page.relative_to(visit.folder).as_posix())
        faults = looks.faults_at_widths(tab)
        faults += looks.faults_on_paper(tab)
        faults += looks.faults_from_right_to_left(tab)
        if faults:
            found[page.name] = faults
    assert found == {}


# By how much code is cut, and how many lines it takes.
_CUT_AND_LINES = """(box) => {
    const { paddingTop, paddingBottom, lineHeight } = getComputedStyle(box);
    const high = box.clientHeight - parseFloat(paddingTop) - parseFloat(paddingBottom);
    return [box.scrollWidth - box.clientWidth, Math.round(high / parseFloat(lineHeight))];
}"""


def test_the_code_of_the_landing_page_is_cut_at_no_width(visit: Visit) -> None:
    tab = visit.open("index.html")
    for width in (320, 375, 768, 1024, 1440):
        tab.set_viewport_size({"width": width, "height": 900})
        boxes = tab.locator(".hero-code pre")
        assert boxes.count() == 2
        # The lines of code stand as they were written: none is cut, none is broken.
        lines = [text.rstrip().count("\n") + 1 for text in boxes.all_text_contents()]
        assert [box.evaluate(_CUT_AND_LINES) for box in boxes.all()] == [
            [0, each] for each in lines
        ], width


@pytest.mark.parametrize("use", USES)
def test_a_page_is_whole_after_use(visit: Visit, use: str) -> None:
    tab = opened(visit, use)
    found = looks.faults_at_widths(tab)
    found += looks.faults_in_forced_colours(tab)
    found += looks.faults_in_motion(tab)
    found += looks.faults_from_right_to_left(tab)
    tab.set_viewport_size({"width": 380, "height": 900})
    found += looks.faults_from_right_to_left(tab)
    found += looks.faults_on_paper(tab)
    assert found == []


@pytest.mark.skipif(not AXE.exists(), reason="axe-core is not installed; see `make docs-tools`")
@pytest.mark.parametrize("use", USES)
def test_axe_finds_nothing_after_use(visit: Visit, use: str) -> None:
    visit.tab.set_viewport_size({"width": 1440, "height": 900})
    tab = opened(visit, use)
    assert judged(tab) == []


@pytest.mark.parametrize(
    "page", [page.replace("search.html", "search.html?q=servo") for page in KINDS]
)
def test_every_control_is_reached_once_by_tab_and_seen_to_be(visit: Visit, page: str) -> None:
    tab = visit.open(page)
    tab.set_viewport_size({"width": 1440, "height": 900})
    assert looks.faults_of_keyboard(tab) == []


@pytest.mark.parametrize("width", [380, 1440])
def test_live_traffic_leaves_the_page_whole(browser: Browser, folder: Path, width: int) -> None:
    context = browser.new_context(viewport={"width": width, "height": 900})
    with VirtualController() as board:
        host = SerialHost(context, VirtualEnd(board))
        visit = Visit(context, folder)
        live = LiveTab(visit.open(WORKBENCH))
        live.connect()
        live.send("ServoPositionsRead", servo_ids=",".join(map(str, range(1, 21))))
        live.reply("ServoPositions ")
        board.send_bytes(bytes(range(80)) * 25)
        live.count("noise", 2000)
        host.unplug(live.tab)
        live.status("The line was lost")
        found = looks.faults_at_widths(live.tab)
        found += looks.faults_in_forced_colours(live.tab)
        found += looks.faults_on_paper(live.tab)
        assert found == []
        if AXE.exists():
            assert judged(live.tab) == []
        visit.end()
    context.close()


@pytest.mark.parametrize("page", [*KINDS, "404.html", "reference/busservo/changelog.html"])
def test_without_a_script_nothing_is_dead(unscripted: Visit, page: str) -> None:
    tab = unscripted.open(page)
    assert looks.faults_at_widths(tab) + looks.dead_controls(tab) == []


@pytest.mark.parametrize("page", KINDS)
def test_enlarged_twice_the_page_is_whole_and_its_header_small(
    browser: Browser, folder: Path, page: str
) -> None:
    """A display of 1280 by 800, at 200 %."""
    screen: Any = {"width": 640, "height": 400}
    with visiting(browser, folder, viewport=screen, device_scale_factor=2) as visit:
        tab = visit.open(page)
        assert looks.faults(tab) == []
        header = tab.locator("body > header").bounding_box()
        assert header is not None
        assert header["height"] <= 400 / 4


# Pages of A4 that nothing on the paper should exceed.
SHEETS = {
    "index.html": 4,
    GUIDE: 12,
    WORKBENCH: 2,
    SERVO_MOVE: 6,
    "reference/busservo/cheatsheet.html": 1,
    "reference/busservo/index.html": 3,
}


@pytest.mark.parametrize("page", SHEETS)
def test_on_paper_a_page_is_as_long_as_what_it_says(visit: Visit, page: str) -> None:
    tab = visit.open(page)
    tab.set_default_timeout(MILLISECONDS)
    pdf = tab.pdf(prefer_css_page_size=True)
    assert 1 <= len(re.findall(rb"/Type\s*/Page\b", pdf)) <= SHEETS[page]
    boxes = re.findall(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", pdf)
    assert {(round(float(width)), round(float(height))) for width, height in boxes} == {(595, 842)}
