"""What is wrong with a page as it stands in a browser, whatever was done with it before."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from playwright.sync_api import Page as Tab

# Widths of a phone at 200 %, a phone, a tablet and a desk.
WIDTHS = (320, 380, 768, 1440)

# What a reader would stumble over: a page wider than the display and what makes it so, an id that
# stands twice, a link within the page to nothing, a picture that does not show, what can be
# reached with the keyboard and has no size, and a scroll box that the keyboard does not reach.
_FAULTS = """() => {
    const wide = document.documentElement.clientWidth, faults = [];
    const named = (each) => each.outerHTML.slice(0, 90).replace(/\\s+/g, " ");
    const shown = (each) => each.checkVisibility({ visibilityProperty: true });
    if (document.documentElement.scrollWidth > wide) {
        const over = [...document.body.querySelectorAll("*")]
            .filter((each) => shown(each) && each.getBoundingClientRect().right > wide + 1);
        faults.push(`${document.documentElement.scrollWidth} wide: ${over.slice(-1).map(named)}`);
    }
    const ids = [...document.querySelectorAll("[id]")].map(({ id }) => id);
    for (const id of new Set(ids.filter((each, i) => ids.indexOf(each) !== i))) {
        faults.push(`the id ${id} stands twice`);
    }
    for (const link of document.querySelectorAll('a[href^="#"]')) {
        const id = decodeURIComponent(link.getAttribute("href").slice(1));
        if (id && !document.getElementById(id)) faults.push(`no #${id}`);
    }
    for (const image of document.images) {
        if (shown(image) && !image.naturalWidth) faults.push(`does not show: ${named(image)}`);
    }
    for (const each of document.querySelectorAll("main *")) {
        if (!shown(each)) continue;
        const style = getComputedStyle(each);
        const scrolls = /auto|scroll/.test(style.overflowX)
            && each.scrollWidth > each.clientWidth + 1;
        const reached = each.tabIndex >= 0 || each.querySelector("a, button, input, [tabindex]");
        if (scrolls && !reached) faults.push(`no key scrolls ${named(each)}`);
    }
    return faults;
}"""


def faults(tab: Tab) -> list[str]:
    """Return what is wrong with the page in its present state and width."""
    found: list[str] = tab.evaluate(_FAULTS)
    return found


def violations(tab: Tab, options: dict[str, Any]) -> list[tuple[str, str]]:
    """Return what axe, which the page must have loaded, finds: the rule, and the first place."""
    found = tab.evaluate(
        "(options) => axe.run(options)", {"resultTypes": ["violations"], **options}
    )
    return [(each["id"], each["nodes"][0]["html"][:120]) for each in found["violations"]]
