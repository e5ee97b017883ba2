"""The reference of two protocols, with its pages parsed once for all tests."""

import json
import posixpath
import re
import shutil
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import cache, cached_property
from html.parser import HTMLParser
from pathlib import Path
from typing import Any

from framegen.compile import Compiled, compile_spec
from framegen.language.load import read_source
from framegen.model.model import Model
from framegen.reading.source import Source
from framegen.render import render_target, snippets
from framegen.site.project import Project
from framegen.site.rendering import render_page
from framegen.site.site import Site, rendered
from framegen.targets import docs

ROOT = Path(__file__).parents[3]
SPECS = {
    "busservo": ROOT / "spec" / "busservo.yaml",
    "greenhouse": ROOT / "tests" / "specs" / "demo.yaml",
}
# The smallest, for tests that need no spec in particular.
LAMP = ROOT / "tests" / "specs" / "lamp.yaml"
NODE = shutil.which("node")
# Where `make docs-tools` puts what tests/unit/site/package.json names.
NODE_MODULES = ROOT / ".tools" / "node" / "node_modules"

# Elements without an end.
VOID = frozenset(["br", "img", "input", "link", "meta"])


@dataclass
class Page(HTMLParser):
    """One page: the text of its elements, in order."""

    path: str
    text: str
    ids: list[str] = field(default_factory=list)
    links: list[str] = field(default_factory=list)
    loads: list[str] = field(default_factory=list)
    scripts: list[tuple[dict[str, str], str]] = field(default_factory=list)
    styles: list[str] = field(default_factory=list)
    headings: list[int] = field(default_factory=list)
    tags: list[tuple[str, dict[str, str]]] = field(default_factory=list)
    words: str = ""

    def __post_init__(self) -> None:
        super().__init__(convert_charrefs=True)
        self._inside: list[str] = []
        self.feed(self.text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        given = {name: value or "" for name, value in attrs}
        self.tags.append((tag, given))
        self.ids += [given["id"]] if "id" in given else []
        self.links += [given["href"]] if tag == "a" else []
        loading = [given[name] for name in ("src", "srcset", "data", "poster") if name in given]
        self.loads += loading + ([given.get("href", "")] if tag in ("link", "use", "image") else [])
        self.headings += [int(tag[1])] if re.fullmatch("h[1-6]", tag) else []
        if tag == "script":
            self.scripts.append((given, ""))
        if tag == "style":
            self.styles.append("")
        if tag not in VOID:
            self._inside.append(tag)

    def handle_startendtag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.handle_starttag(tag, attrs)
        if tag not in VOID:
            self.handle_endtag(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self._inside.pop() == tag, f"{self.path}: </{tag}> closes something else"
        self.words += " " if tag in ("td", "th", "li", "dt", "dd", "p") else ""

    def handle_data(self, data: str) -> None:
        inside = self._inside[-1] if self._inside else ""
        if inside == "script":
            attributes, text = self.scripts[-1]
            self.scripts[-1] = attributes, text + data
        elif inside == "style":
            self.styles[-1] += data
        else:
            self.words += data

    @property
    def prose(self) -> str:
        """Its words, on one line."""
        return " ".join(self.words.split())

    def lacks(self, texts: Iterable[str]) -> list[str]:
        """Return those texts that its words do not have."""
        prose = self.prose
        return [each for each in texts if each not in prose]

    def having(self, name: str, value: str = "") -> list[dict[str, str]]:
        """Return all attributes of the elements that have this one, if it has a certain value."""
        return [given for _, given in self.tags if name in given and value in ("", given[name])]

    @property
    def data(self) -> str:
        """What stands in its script that is no code."""
        (text,) = [text for given, text in self.scripts if given.get("type") == "application/json"]
        return text

    @property
    def reached(self) -> set[str]:
        """The paths that its links lead to."""
        return {self.leads_to(link)[0] for link in self.links}

    def leads_to(self, link: str) -> tuple[str, str]:
        """Return the page and the anchor that a link of this page leads to."""
        path, _, anchor = link.partition("#")
        path = path.partition("?")[0]
        if not path:
            return self.path, anchor
        return posixpath.normpath(posixpath.join(posixpath.dirname(self.path), path)), anchor


@dataclass(frozen=True)
class Reference:
    """One reference by path below its root: the files of Markdown that are kept, and the pages."""

    compiled: Compiled

    @property
    def source(self) -> Source:
        return self.compiled.source

    @property
    def model(self) -> Model:
        return self.compiled.model

    @cached_property
    def files(self) -> dict[str, str]:
        """The text of each file that is kept."""
        files = render_target(docs.TARGET, self.compiled)
        return {path.removeprefix(f"docs/{self.folder}"): text for path, text in files.items()}

    @cached_property
    def pages(self) -> dict[str, Page]:
        """Each page, by path below the root of the reference."""
        found = {path.partition(self.folder): page for path, page in self.site.items()}
        return {path: page for (_, here, path), page in found.items() if here}

    @property
    def folder(self) -> str:
        """Where its pages are in the site."""
        return f"reference/{self.compiled.spec.protocol.name}/"

    @cached_property
    def site(self) -> dict[str, Page]:
        """Each page of the site that has this reference alone, by path below its root."""
        return pages_of(self.rendered)

    def page(self, path: str) -> Page:
        """Return a page by its path below the root of the reference, rendered alone."""
        return page_of(self._site, f"{self.folder}{path}")

    @cached_property
    def rendered(self) -> dict[str, str]:
        """Each file of that site, by path below its root."""
        return rendered(self._site)

    @cached_property
    def _site(self) -> Site:
        return Site(Project([self.compiled]), snippets())


def page_of(site: Site, path: str) -> Page:
    """Return a page of a site, rendered alone."""
    (page,) = (page for page in site.pages if page.path == path)
    return Page(path, render_page(site, page))


def pages_of(rendered: Mapping[str, str]) -> dict[str, Page]:
    """Return the pages among the files of a site, by path below its root."""
    return {path: Page(path, text) for path, text in rendered.items() if path.endswith(".html")}


def broken_links(
    pages: Mapping[str, Page], files: Collection[str], of: Iterable[Page] | None = None
) -> list[tuple[str, str]]:
    """Return the links of pages, or of all, that lead to no page, file or anchor of a site."""
    found: list[tuple[str, str]] = []
    for page in pages.values() if of is None else of:
        for link in page.links:
            where, anchor = page.leads_to(link)
            is_there = where in pages or (where in files and not anchor)
            known = pages[where].ids if anchor and where in pages else [anchor]
            if "://" not in link and not (is_there and anchor in known):
                found.append((page.path, link))
    return found


def reference_of(source: Source) -> Reference:
    """Return the reference of a spec that has no findings."""
    return Reference(compile_spec(source))


def respelled(data: dict[str, Any]) -> Source:
    """Return a spec of other values, as text: JSON is YAML too."""
    return Source("spec/other.yaml", json.dumps(data, indent=1, ensure_ascii=False) + "\n")


@cache
def reference(name: str) -> Reference:
    return reference_of(read_source(SPECS[name]))
