"""Compare the pages of a spec with those of a harmless one: they may differ in words only."""

import re
from collections.abc import Iterator

from framegen.reading.source import Source

from tests.factories import Data, yaml_of
from tests.unit.site.reference import Page, Reference, reference_of

_LINK = re.compile(r"(?<!\\)\]\(([^)]*)\)")


def pages_of(data: Data) -> Reference:
    """Return the reference of a spec, as Markdown and as HTML."""
    return reference_of(Source("spec/made_up.yaml", yaml_of(data)))


def not_inert(pages: Reference, harmless: Reference) -> Iterator[str]:
    """Yield what the pages have that those of harmless words have not: elements, links, code."""
    for path, page in pages.pages.items():
        other = harmless.pages[path]
        for what in _elements(page) - _elements(other):
            yield f"{path}: {what}"
        for link in {each.partition("#")[0] for each in [*page.links, *page.loads]} - {
            each.partition("#")[0] for each in [*other.links, *other.loads]
        }:
            yield f"{path}: a link to {link}"
        if _code(page) != _code(other):
            yield f"{path}: a script or a style"
    for path, text in pages.files.items():
        body, other_body = text.partition("-->")[2], harmless.files[path].partition("-->")[2]
        for sign in ("<", "```", "\n#", "https://", "{{", "{%"):
            if body.count(sign) != other_body.count(sign):
                yield f"{path}: {sign!r}"
        if _LINK.findall(body) != _LINK.findall(other_body):
            yield f"{path}: a link"


def _elements(page: Page) -> set[str]:
    return {f"<{tag} {' '.join(sorted(given))}>" for tag, given in page.tags}


def _code(page: Page) -> tuple[list[str], list[str]]:
    return page.styles, [text for given, text in page.scripts if not given]
