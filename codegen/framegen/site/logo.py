"""The logo of a site: a signal on a line, beside its name and as the icon of its pages."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from urllib.parse import quote

from markupsafe import Markup

_FILE = Path(__file__).parent / "static" / "logo.svg"


@cache
def logo() -> Markup:
    """Return the logo as part of a page; the words beside it say all that it says."""
    svg = _FILE.read_text(encoding="utf-8").strip()
    return Markup(svg.replace("<svg ", '<svg aria-hidden="true" focusable="false" ', 1))  # noqa: S704 - ours


@cache
def icon() -> str:
    """Return the logo as an address that holds all of it."""
    return f"data:image/svg+xml,{quote(_FILE.read_text(encoding='utf-8').strip(), safe=' =:/')}"
