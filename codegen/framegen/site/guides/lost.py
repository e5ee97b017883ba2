"""What of the guides gets lost on the way to pages: pictures, and links that lead nowhere."""

from __future__ import annotations

import html
import posixpath
import re
from functools import cache
from typing import TYPE_CHECKING
from urllib.parse import unquote

from framegen.reading.findings import Finding, did_you_mean
from framegen.reading.source import Source, Span
from framegen.site.guides.links import FOLDER, is_elsewhere, links_of, name_of
from framegen.site.guides.plan import README

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping

    from framegen.site.guides.guide import Guide
    from framegen.site.guides.links import Link
    from framegen.site.guides.plan import Plan

_ID = re.compile(r'\sid="([^"]*)"')
_ANCHOR = "an anchor is a heading in small letters, with a hyphen for each space"
_PATH = "correct the path, or write it as code"
_PLAN = (
    "a list of guides becomes the navigation, with the words above it and those behind each link; "
    "put the rest into a section without such a list, or into a guide"
)
# What to write instead of an element of HTML.
_INSTEAD = {
    "img": "write `![words](path)`",
    "a": "write `[words](path)`; headings have anchors by themselves",
}


def lost_in(guide: Guide, files: Mapping[str, str], folder: str) -> Iterator[str]:
    """Yield what gets lost of a guide in a site of these files: where, what, and the way out.

    `folder` is that of the guides.
    """
    found = (each for link in links_of(guide.text) for each in _lost(guide, link, files))
    yield from _rendered(guide, found, folder)


def lost_in_plan(
    guide: Guide, plan: Plan, listable: Collection[str], files: Mapping[str, str], folder: str
) -> Iterator[str]:
    """Yield the same of the README of the guides, which is the plan of the site's navigation."""
    yield from _rendered(guide, _lost_in_plan(guide, plan, listable, files), folder)


def _rendered(guide: Guide, found: Iterator[Finding], folder: str) -> Iterator[str]:
    source = Source(posixpath.normpath(posixpath.join(folder, guide.path)), guide.text)
    ordered = sorted(dict.fromkeys(found), key=lambda finding: (finding.span, finding.rule))
    return (finding.render(source) for finding in ordered)


def _lost_in_plan(
    guide: Guide, plan: Plan, listable: Collection[str], files: Mapping[str, str]
) -> Iterator[Finding]:
    first, *sections = plan.parts
    # What stands above all sections is on the front page as it is written.
    lists = [part for part in sections if part.is_listing]
    entries = {entry.span: entry.link for part in (first, *lists) for entry in part.entries}
    # Of two entries for the same page, the first counts.
    kept = {link: span for span, link in reversed(entries.items()) if link in listable}
    for part in lists:
        for line in part.left:
            yield _finding("guide-plan", Span(line, 1), "this is on no page", _PLAN)
    for link in links_of(guide.text):
        found = [*_lost(guide, link, files)]
        in_list = any(part.start < link.span.line <= part.end for part in lists)
        if in_list and not found and link.span not in kept.values():
            why = "it does not begin an item"
            if link.span in entries:
                why = "it is no guide and no reference, or is listed above"
            what = f"`{link.target}` is not linked to: {why}"
            found = [_finding("guide-plan", link.span, what, _PLAN)]
        yield from found


def _lost(guide: Guide, link: Link, files: Mapping[str, str]) -> Iterator[Finding]:
    """Yield what is wrong with a link, a picture or an element of HTML, if anything is."""
    if link.kind == "html":
        element = re.sub(r"\W.*", "", link.target[1:]).lower()
        hint = _INSTEAD.get(element, "link to it, by `[words](path)`")
        yield _finding("guide-html", link.span, f"`{link.target}` is shown as text", hint)
    elif not is_elsewhere(link.target):
        yield from _lost_within(guide, link, files)
    elif link.kind == "picture" and not link.target.startswith("data:"):
        what = f"`{link.target}` becomes a link, since pages load nothing from elsewhere"
        yield _finding("guide-picture", link.span, what, "put the picture into the project")


def _lost_within(guide: Guide, link: Link, files: Mapping[str, str]) -> Iterator[Finding]:
    """Yield what is wrong with a link to the site itself."""
    found = guide.leads_to(link.target)
    if found is None:
        yield _dead(guide, link)
        return
    page, anchor = found[0], unquote(found[1])
    if link.kind == "picture" and page in files:
        what = f"`{link.target}` is a page, and no picture"
        yield _finding("guide-picture", link.span, what, "link to it, by `[words](path)`")
        return
    ids = _ids(files.get(page, ""))
    if anchor and page in files and anchor not in ids:
        what = f"`{link.target}` leads to no heading: {page} has no `{anchor}`"
        hint = did_you_mean(anchor, sorted(ids), otherwise=_ANCHOR)
        yield _finding("guide-anchor", link.span, what, hint)


def _dead(guide: Guide, link: Link) -> Finding:
    path, folder = unquote(link.target.partition("#")[0]), posixpath.dirname(guide.path)
    known = {name.partition("#")[0] for name in guide.published}
    near = sorted(posixpath.relpath(f"/{FOLDER}/{name}", f"/{FOLDER}/{folder}") for name in known)
    hint = did_you_mean(path, near, otherwise=_PATH)
    if link.kind == "picture":
        return _finding("guide-picture", link.span, f"`{path}` is no picture of the project", hint)
    if path.endswith(".md") and name_of(path, guide.path).startswith("../"):
        hint = f"list it in {FOLDER}/{README}, so that it becomes a page, or write it as code"
    what = f"`{path}` is no page of the site, and no file that can be part of it"
    return _finding("guide-link", link.span, what, hint)


@cache
def _ids(page: str) -> frozenset[str]:
    """Return the anchors of a page."""
    return frozenset(map(html.unescape, _ID.findall(page)))


def _finding(rule: str, span: Span, what: str, hint: str) -> Finding:
    return Finding(rule, span, "", what, hint)
