"""Code blocks: coloured while the site is built, by classes, and with a button to copy."""

from __future__ import annotations

from markupsafe import Markup


def code_block(code: str, language: str) -> Markup:
    """Return a block of code of a language, or of none, as HTML."""
    return Markup(
        '<pre class="code" tabindex="0"><code data-language="{}">{}</code></pre>\n'
    ).format(language, code)
