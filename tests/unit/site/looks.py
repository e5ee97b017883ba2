"""What is wrong with a page as it stands in a browser, whatever was done with it before."""

from pathlib import Path
from typing import Any

from playwright.sync_api import Page as Tab

# Widths of a phone at 200 %, a phone, a tablet and a desk.
WIDTHS = (320, 380, 768, 1440)
# What an A4 page has between its margins, in the pixels of a style sheet.
PAPER = 700

_LOOKS = Path(__file__).with_suffix(".js").read_text("utf-8")
# A page hears that it was made wider or narrower when its next frame is drawn. One whose scripts
# are switched off hears nothing, and would never call back.
_DRAWN = """if (matchMedia("(scripting: enabled)").matches) {
    await new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)));
}"""


def faults(tab: Tab) -> list[str]:
    """Return what is wrong with the page in its present state and width.

    A page that is wider than the display, and what makes it so; an id that stands twice; a link
    within the page to nothing; a picture that does not show; a scroll box that the keyboard does
    not reach; text that is cut off, that leaves its cell or button, or lies over other text; and
    a control that is smaller than 24 pixels.
    """
    return _found(tab, "screenFaults")


def faults_at_widths(tab: Tab) -> list[str]:
    """Return what is wrong with the page at each of the widths."""
    found = []
    for width in WIDTHS:
        tab.set_viewport_size({"width": width, "height": 900})
        found += [f"{width}: {each}" for each in faults(tab)]
    return found


def faults_on_paper(tab: Tab) -> list[str]:
    """Return what of the page would be printed in vain, or cut off at the edge of the paper."""
    tab.set_viewport_size({"width": PAPER, "height": 900})
    tab.emulate_media(media="print")
    tab.evaluate("dispatchEvent(new Event('beforeprint'))")
    found = _found(tab, "paperFaults")
    tab.evaluate("dispatchEvent(new Event('afterprint'))")
    tab.emulate_media(media="screen")
    return found


def faults_in_forced_colours(tab: Tab) -> list[str]:
    """Return the controls that cannot be told from text in colours of the user's own."""
    tab.emulate_media(forced_colors="active")
    found = _found(tab, "edgeFaults")
    tab.emulate_media(forced_colors="none")
    return found


def faults_in_motion(tab: Tab) -> list[str]:
    """Return what moves though the user wants no motion."""
    tab.emulate_media(reduced_motion="reduce")
    found = _found(tab, "motionFaults")
    tab.emulate_media(reduced_motion="no-preference")
    return found


def faults_from_right_to_left(tab: Tab) -> list[str]:
    """Return what blows the page up when it is read from right to left."""
    tab.evaluate("document.documentElement.dir = 'rtl'")
    found = _found(tab, "wideFaults")
    tab.evaluate("document.documentElement.dir = 'ltr'")
    return found


def dead_controls(tab: Tab) -> list[str]:
    """Return the controls of a page without scripts that would do nothing."""
    return _found(tab, "deadFaults")


def faults_of_keyboard(tab: Tab) -> list[str]:
    """Return what Tab does not reach, reaches twice, or reaches without showing that it did."""
    many = tab.evaluate(f"() => {{ {_LOOKS}; return startKeys(); }}")
    # Boxes that scroll are stops on the way, too.
    for _ in range(2 * many + 20):
        tab.keyboard.press("Tab")
        if tab.evaluate("hasComeRound()"):
            break
    found: list[str] = tab.evaluate("endKeys()")
    return found


def violations(tab: Tab, options: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what axe, which the page must have loaded, finds: the rule, and the first place."""
    found = tab.evaluate(
        "(options) => axe.run(options)", {"resultTypes": ["violations"], **options}
    )
    return [(each["id"], each["nodes"][0]["html"][:120]) for each in found["violations"]]


def _found(tab: Tab, kind: str) -> list[str]:
    found: list[str] = tab.evaluate(
        f"async () => {{ {_LOOKS}; {_DRAWN}; return first({kind}()); }}"
    )
    return found
