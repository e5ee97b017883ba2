"""A site at an address: the address itself, and what search engines read there."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from urllib.parse import quote

from framewire.command.console import visible
from markupsafe import escape

from framegen.language.web_address import address_fault
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterable

NOT_FOUND = "404.html"
_HINT = "write it like https://example.org/docs/"


def base_address(text: str) -> str:
    """Return the address of a site with a slash at its end; "" for none.

    Raises Unusable for what is no address, and for one that pages cannot be below.
    """
    if not text:
        return ""

    def refuse(why: str) -> Unusable:
        return Unusable(f"--base {visible(text)}: {why}", hint=_HINT)

    fault = address_fault(text)
    if fault:
        raise refuse(fault)
    if re.search("[?#]", text):
        raise refuse("pages are below it, so nothing follows a ? or a #")
    return text if text.endswith("/") else f"{text}/"


def sitemap(base: str, paths: Iterable[str]) -> str:
    """Return the list of all pages, for search engines."""
    lines = [f"<url><loc>{escape(base + quote(path))}</loc></url>" for path in paths]
    return "\n".join(
        [
            '<?xml version="1.0" encoding="UTF-8"?>',
            '<urlset xmlns="http://www.sitemaps.org/schemas/sitemap/0.9">',
            *lines,
            "</urlset>\n",
        ]
    )


def robots(base: str) -> str:
    """Return what is asked of search engines: to read all, by the sitemap."""
    return f"User-agent: *\nAllow: /\nSitemap: {base}sitemap.xml\n"
