"""The logo of a site: a signal on a line, beside its name and as the icon of its pages."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from urllib.parse import quote

from markupsafe import Markup

from framegen.site.shades import default_accent

_FILE = Path(__file__).parent / "static" / "logo.svg"


@cache
def logo(accent: str = "") -> Markup:
    """Return the logo as part of a page; the words beside it say all that it says.

    `accent` is the colour of the site, where it has one of its own.
    """
    svg = _drawn(accent)
    return Markup(svg.replace("<svg ", '<svg aria-hidden="true" focusable="false" ', 1))  # noqa: S704 - ours


@cache
def icon(accent: str = "") -> str:
    """Return the logo as an address that holds all of it."""
    return f"data:image/svg+xml,{quote(_drawn(accent), safe=' =:/')}"


def _drawn(accent: str) -> str:
    svg = _FILE.read_text(encoding="utf-8").strip()
    return svg.replace(default_accent(), accent) if accent else svg
