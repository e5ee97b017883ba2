"""Escaping of text from a spec for HTML, and for JSON in a script."""

from __future__ import annotations

import json
import re
from typing import TYPE_CHECKING, Any

from markupsafe import Markup, escape

if TYPE_CHECKING:
    from collections.abc import Mapping


def linked(text: str, addresses: Mapping[str, str], root: str) -> Markup:
    """Return `text` as HTML, in which every message name is a link to its page."""
    result = Markup()
    for word in re.split(r"(\w+)", text):
        address = addresses.get(word)
        if address is None:
            result += escape(word)
        else:
            result += Markup('<a href="{}{}">{}</a>').format(root, address, word)
    return result


def said(text: str, addresses: Mapping[str, str], root: str) -> Markup:
    """Return a sentence of a report as HTML: what stands between two backticks is code."""
    parts = text.replace(" -> ", " → ").split("`")
    if not len(parts) % 2:
        return linked(text, addresses, root)
    result = Markup()
    for at, part in enumerate(parts):
        inner = linked(part, addresses, root)
        result += Markup("<code>{}</code>").format(inner) if at % 2 else inner
    return result


def anchor(text: str) -> str:
    """Return `text` as part of an anchor: what is no letter, digit or dot becomes a dash."""
    return re.sub(r"[^\w.]+", "-", text)


def script_json(value: Any) -> Markup:
    """Return `value` as JSON inside a script element, which nothing in it can close."""
    text = json.dumps(value, ensure_ascii=True, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 - nothing is left in it that HTML would read
