"""The rendering of a page: its template, with the site around it."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.output import banner
from framegen.site.downloads import size_in_words
from framegen.site.escape import anchor, linked, said
from framegen.site.guides.headings import headings, with_permalinks
from framegen.site.guides.highlight import code_block
from framegen.site.policy import assets
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

    from framegen.site.page import Page
    from framegen.site.site import Site

_HERE = Path(__file__).parent
# The script of every page, before its own.
COMMON = ("page", "clipboard", "tabs", "search_box")


def render_page(site: Site, page: Page) -> str:
    """Render one of the pages of a site."""
    with site.collection.blaming(page):
        return _filled(site, page)


def _filled(site: Site, page: Page) -> str:
    before, after = site.navigation.neighbours(page)
    reference = page.context.get("reference")
    return (
        _environment()
        .get_template(f"{page.template}.html.jinja")
        .render(
            {
                "site": site,
                "page": page,
                "reference": None,
                "edition": None,
                "before": before,
                "after": after,
                "banner": banner("" if reference is None else reference.spec),
                "assets": assets(page.template, [COMMON, *page.scripts], site.project.look.style),
                **page.context,
            }
        )
    )


@cache
def _environment() -> Environment:
    made = environment(_HERE / "templates", "html", autoescape=True)
    made.filters |= {
        "anchor": anchor,
        "bytes": size_in_words,
        "code": code_block,
        "headings": headings,
        "linked": linked,
        "said": said,
        "with_permalinks": with_permalinks,
    }
    return made
