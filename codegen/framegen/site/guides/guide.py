"""A guide as a page: Markdown, with links that lead to pages."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property
from itertools import pairwise
from pathlib import PurePosixPath
from typing import TYPE_CHECKING
from urllib.parse import quote

from markupsafe import Markup, escape

from framegen.site.guides.highlight import code_block
from framegen.site.guides.links import is_elsewhere, name_of
from framegen.site.guides.markdown import parser, plain_text, slugs

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from markdown_it.token import Token

# Files outside of the folder of the guides become pages in here.
_OUTSIDE = "project"
# Words of code that are longer may be broken, on a small display.
_WHOLE = 24


@dataclass(frozen=True)
class Guide:
    """One file of Markdown, by its path below the folder of the guides.

    `published` are the files that its links may lead to, with their pages, and `FILE#SECTION`
    where a section has a page of its own; a link to any other becomes its text.
    """

    path: str
    text: str
    published: Mapping[str, str] = field(default_factory=dict)

    @property
    def page(self) -> str:
        """The page that it becomes, below the root of the site."""
        return page_of(self.path)

    @cached_property
    def tokens(self) -> list[Token]:
        """All of it, with anchors on the headings, and links that lead to pages."""
        tokens = parser().parse(self.text)
        headings = [pair for pair in pairwise(tokens) if pair[0].type == "heading_open"]
        anchors = slugs(inside.content for _, inside in headings)
        for (heading, _), anchor in zip(headings, anchors, strict=True):
            heading.attrSet("id", anchor)
        for token in tokens:
            self._lead(token.children or [])
            _align(token)
        return tokens

    @cached_property
    def title(self) -> str:
        """Its first heading, or else its name."""
        return next((text for tag, text in self._blocks() if tag == "h1"), self.path)

    @cached_property
    def about(self) -> str:
        """Its first paragraph."""
        return next((text for tag, text in self._blocks() if tag == "p"), "")

    @cached_property
    def body(self) -> Markup:
        """All of it as HTML, the title included."""
        return rendered(self.tokens)

    def _blocks(self) -> Iterator[tuple[str, str]]:
        for before, token in pairwise(self.tokens):
            if before.type in ("heading_open", "paragraph_open"):
                yield before.tag, plain_text(token)

    def _lead(self, tokens: Sequence[Token]) -> None:
        plain = in_link = False
        for token in tokens:
            if token.type == "image":
                self._show(token, in_link=in_link)
            if token.type == "link_open":
                address = self._address(str(token.attrGet("href")))
                plain = address is None
                token.attrs = {} if address is None else {"href": address}
            if token.type in ("link_open", "link_close"):
                in_link = token.type == "link_open"
            if plain and token.type in ("link_open", "link_close"):
                token.tag = "span"

    def _show(self, image: Token, *, in_link: bool) -> None:
        """Show a picture of the site. One from elsewhere becomes a link: pages load nothing."""
        source = str(image.attrGet("src"))
        address = self._address(source)
        loads = is_elsewhere(source) and not source.startswith("data:")
        if address is not None and not loads:
            image.attrSet("src", address)
            return
        image.type = "html_inline"
        words = Markup("{}") if in_link or not loads else Markup('<a href="{1}">{0}</a>')
        image.content = str(words.format(plain_text(image) or source, source))

    def _address(self, link: str) -> str | None:
        if link.startswith("#") or is_elsewhere(link):
            return link
        found = self.leads_to(link)
        if found is None:
            return None
        page, anchor = found
        return f"{'../' * self.page.count('/')}{quote(page)}{anchor and f'#{anchor}'}"

    def leads_to(self, link: str) -> tuple[str, str] | None:
        """Return the page or file of the site that a link leads to, and the anchor there."""
        path, _, anchor = link.partition("#")
        if not path:
            return self.page, anchor
        name = name_of(path, self.path)
        # A section may have become a page of its own.
        section = self.published.get(f"{name}#{anchor}")
        if section is not None:
            return section, ""
        # The README of a folder stands for it.
        page = self.published.get(name) or self.published.get(f"{name}/README.md")
        return None if page is None else (page, anchor)


def _align(token: Token) -> None:
    """Align a cell by a class: the policy of the pages allows no other style."""
    style = str(token.attrs.pop("style", ""))
    if style:
        token.attrSet("class", style.removeprefix("text-align:"))


def page_of(path: str) -> str:
    """Return the page that a Markdown file becomes, by its path below the guides."""
    steps = PurePosixPath(path)
    if steps.parts[0] == "..":
        stem = steps.parent.name if steps.name == "README.md" else steps.stem
        return f"{_OUTSIDE}/{stem.lower() if stem != '..' else 'readme'}.html"
    stem = path.removesuffix(".md")
    return f"{stem.removesuffix('README')}index.html" if stem.endswith("README") else f"{stem}.html"


def rendered(tokens: Sequence[Token]) -> Markup:
    """Return Markdown as HTML; markdown-it has escaped what it says."""
    markdown = parser()
    for rule in (_fence, _code_block, _code_inline):
        markdown.add_render_rule(rule.__name__.removeprefix("_"), rule)
    body = str(markdown.renderer.render(tokens, markdown.options, {}))
    # Tables scroll in boxes of their own, which the keyboard reaches.
    body = body.replace("<table>", '<div class="scroll" tabindex="0"><table>')
    return Markup(body.replace("</table>", "</table></div>"))  # noqa: S704 - escaped


def _fence(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    # What follows the language is for others, such as those who run it.
    language = tokens[index].info.strip().partition(" ")[0]
    return str(code_block(tokens[index].content, language))


def _code_block(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    return str(code_block(tokens[index].content))


def _code_inline(_renderer: object, tokens: Sequence[Token], index: int, *_: object) -> str:
    """Keep words with a hyphen, such as `--all`, from being broken there."""
    words = [
        Markup('<span class="word">{}</span>').format(word)
        if "-" in word and len(word) <= _WHOLE
        else escape(word)
        for word in tokens[index].content.split(" ")
    ]
    return f"<code>{' '.join(words)}</code>"
