"""A guide as a page: Markdown, with links that lead to pages."""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from markupsafe import Markup

from framegen.site.highlight import code_block
from framegen.site.linked_files import file_address
from framegen.site.markdown import parser, plain_text, slug

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Sequence

    from markdown_it.token import Token


@dataclass(frozen=True, slots=True)
class Heading:
    """A heading below the title, with its anchor."""

    level: int
    id: str
    text: str


@dataclass(frozen=True)
class Guide:
    """One file of Markdown, by its path below the folder of the guides.

    `files` are those of the site, by path below its root: links to others become plain text.
    """

    path: str
    text: str
    files: Collection[str] = ()

    @property
    def page(self) -> str:
        """The page that it becomes, below the root of the site."""
        return page_of(self.path)

    @cached_property
    def _tokens(self) -> list[Token]:
        tokens = parser().parse(self.text)
        for before, token in pairwise(tokens):
            if before.type == "heading_open":
                before.attrSet("id", slug(token.content))
            _lead(token.children or [], self.files)
        return tokens

    @cached_property
    def title(self) -> str:
        """Its first heading, or else its name."""
        return next((text for level, _, text in self._found_headings() if level == 1), self.path)

    @cached_property
    def headings(self) -> list[Heading]:
        """The headings of the second and third level, for a table of contents."""
        return [
            Heading(level, id_, text)
            for level, id_, text in self._found_headings()
            if level in (2, 3)
        ]

    @cached_property
    def body(self) -> Markup:
        """All of it as HTML, the title included; markdown-it has escaped what it says."""
        markdown = parser()
        markdown.add_render_rule("fence", _fence)
        body = str(markdown.renderer.render(self._tokens, markdown.options, {}))
        # Tables scroll in boxes of their own, which the keyboard reaches.
        body = body.replace("<table>", '<div class="scroll" tabindex="0"><table>')
        return Markup(body.replace("</table>", "</table></div>"))  # noqa: S704 - escaped

    def _found_headings(self) -> Iterator[tuple[int, str, str]]:
        for before, token in pairwise(self._tokens):
            if before.type == "heading_open":
                yield int(before.tag[1:]), str(before.attrGet("id")), plain_text(token)


def page_of(path: str) -> str:
    """Return the page that a Markdown file becomes."""
    stem = path.removesuffix(".md")
    return f"{stem.removesuffix('README')}index.html" if stem.endswith("README") else f"{stem}.html"


def _fence(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    token = tokens[index]
    return str(code_block(token.content, token.info.strip()))


def _lead(tokens: Sequence[Token], files: Collection[str]) -> None:
    """Make links lead to pages; those to files that are not published become plain text."""
    plain = False
    for token in tokens:
        if token.type == "link_open":
            address = _address(str(token.attrGet("href")), files)
            plain = address is None
            token.attrs = {} if address is None else {"href": address}
        if plain and token.type in ("link_open", "link_close"):
            token.tag = "span"


def _address(link: str, files: Collection[str]) -> str | None:
    path, mark, anchor = link.partition("#")
    if re.match(r"[a-z]+:", path) or not path:
        return link
    steps = PurePosixPath(path)
    if path.startswith("../"):
        if steps.parts[1] == "spec":
            return f"reference/{steps.stem}/spec.html"
        return file_address(path, files)
    return page_of(steps.as_posix()) + mark + anchor
