"""Builds the guides of this folder as pages, in the folder that is published.

    framegen docs --out build/site/reference
    python docs/site.py build/site

The guides look like the reference beside them, and need as little: no network, no script.
"""
# ruff: noqa: INP001 - a script, in no package

from __future__ import annotations

import re
import shutil
import sys
from itertools import pairwise
from pathlib import Path, PurePosixPath
from typing import TYPE_CHECKING

from framegen.output import Output
from framegen.targets import docs as reference
from framegen.writing import write
from jinja2 import Environment, StrictUndefined
from markdown_it import MarkdownIt
from markupsafe import Markup

if TYPE_CHECKING:
    from collections.abc import Sequence

    from markdown_it.token import Token

HERE = Path(__file__).parent
STYLE = Path(reference.__file__).parent / "static" / "style.css"

PAGE = """\
<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>{{ title }}</title>
<style>{{ style }}</style>
</head>
<body>
<a class="skip" href="#content">Skip to the content</a>
<header>
<nav aria-label="Documentation">
<ul>
<li><a href="index.html">Documentation</a></li>
<li><a href="reference/index.html">Reference</a></li>
</ul>
</nav>
</header>
<main id="content">
{{ body }}
</main>
</body>
</html>
"""


def build(out: Path) -> None:
    """Write every guide, and the pictures in them, below `out`."""
    pages = {_page(guide.name): _html(guide) for guide in sorted(HERE.glob("*.md"))}
    write(out, [Output("guides.manifest", "", pages)])
    if (HERE / "images").is_dir():
        shutil.copytree(HERE / "images", out / "images", dirs_exist_ok=True)


def _page(name: str) -> str:
    """Return the page that a Markdown file becomes."""
    stem = name.removesuffix(".md")
    return "index.html" if stem == "README" else f"{stem}.html"


def _html(guide: Path) -> str:
    parser = MarkdownIt("commonmark", {"html": False}).enable("table")
    tokens = parser.parse(guide.read_text(encoding="utf-8"))
    title = guide.stem
    for before, token in pairwise(tokens):
        if before.type == "heading_open":
            before.attrSet("id", _slug(token.content))
            title = token.content if before.tag == "h1" else title
        if token.type == "fence":
            token.info = ""
        _lead(token.children or [])
    body = parser.renderer.render(tokens, parser.options, {})
    # Tables and code scroll in boxes of their own, which the keyboard reaches.
    body = body.replace("<table>", '<div class="scroll"><table>')
    body = body.replace("</table>", "</table></div>").replace("<pre>", '<pre tabindex="0">')
    environment = Environment(
        autoescape=True, undefined=StrictUndefined, keep_trailing_newline=True
    )
    return environment.from_string(PAGE).render(
        title=title,
        style=Markup(STYLE.read_text(encoding="utf-8")),  # noqa: S704 - our own
        body=Markup(body),  # noqa: S704 - markdown-it has escaped it
    )


def _slug(heading: str) -> str:
    """Return the anchor of a heading, as forges make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-")


def _lead(tokens: Sequence[Token]) -> None:
    """Make links lead to pages; those to files that are not published become plain text."""
    plain = False
    for token in tokens:
        if token.type == "link_open":
            address = _address(str(token.attrGet("href")))
            plain = address is None
            token.attrs = {} if address is None else {"href": address}
        if plain and token.type in ("link_open", "link_close"):
            token.tag = "span"


def _address(link: str) -> str | None:
    path, mark, anchor = link.partition("#")
    if "://" in path or not path:
        return link
    steps = PurePosixPath(path)
    if path.startswith("../"):
        return f"reference/{steps.stem}/spec.html" if steps.parts[1] == "spec" else None
    return (steps.parent / _page(steps.name)).as_posix() + mark + anchor


if __name__ == "__main__":
    build(Path(sys.argv[1]))
