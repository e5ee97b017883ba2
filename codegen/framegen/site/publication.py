"""A site at an address: the address itself, and what search engines read there."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING
from urllib.parse import quote, urlsplit

from markupsafe import escape

from framegen.console import visible
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

    try:
        parts = urlsplit(text)
        host = parts.hostname
        _ = parts.port  # what is no number is found out here
    except ValueError as error:
        raise refuse(str(error)) from None
    if parts.scheme not in ("http", "https"):
        raise refuse("no address, which begins with https:// or http://")
    if not host:
        raise refuse("no host follows the //")
    if "@" in parts.netloc:
        raise refuse("a name or a password would stand on every page")
    if parts.query or parts.fragment or text.endswith(("?", "#")):
        raise refuse("pages are below it, so nothing follows a ? or a #")
    if not re.fullmatch(r"[!-~]+", text) or re.search(r'[<>"\\^`{|}]', text):
        raise refuse("a character that no address has; spell it with %")
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
