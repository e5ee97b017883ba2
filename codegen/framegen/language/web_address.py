"""Addresses of the web, as an author writes them, without what a page could trip on."""

from __future__ import annotations

import re
from urllib.parse import urlsplit


def address_fault(text: str) -> str:
    """Return why a text is no address of the web that a page can lead to; "" if it is one."""
    try:
        parts = urlsplit(text)
        host = parts.hostname
        _ = parts.port  # what is no number is found out here
    except ValueError as error:
        return str(error)
    if parts.scheme not in ("http", "https"):
        return "no address, which begins with https:// or http://"
    if not host:
        return "no host follows the //"
    if "@" in parts.netloc:
        return "a name or a password would stand on every page"
    if not re.fullmatch(r"[!-~]+", text) or re.search(r'[<>"\\^`{|}]', text):
        return "a character that no address has; spell it with %"
    return ""
