"""What a site looks like, as its author wrote it: the keys of docs/site.yaml, all optional.

The descriptions are what an editor shows. Whether a colour can be read, and a file is there, is for
those who build the site.
"""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Any, TypeAlias

from framewire.frame.pluralize import pluralize
from pydantic import BaseModel, ConfigDict, ValidationError
from pydantic import Field as Key

from framegen.language.misfit import misfits
from framegen.language.notation import Notation
from framegen.language.web_address import address_fault
from framegen.reading.findings import in_order
from framegen.reading.yamltree import Tree, Unusable, read_values

if TYPE_CHECKING:
    from collections.abc import Iterable

    from framegen.reading.findings import Finding
    from framegen.reading.source import Source

# What stands for the file of a page in the address where it is edited.
PATH = "{path}"
_LONGEST = 500


def _words(text: str) -> str:
    if not text.strip():
        raise ValueError("there are no words here; leave the key out")
    if len(text) > _LONGEST:
        raise ValueError(f"{len(text)} characters are too many: {_LONGEST} at most")
    return " ".join(text.split())


def _colour(text: str) -> str:
    if not re.fullmatch("#[0-9A-Fa-f]{6}", text):
        raise ValueError(f"`{text}` is no colour: write # and six hex digits, like `#1b53d1`")
    return text.lower()


def _address(text: str) -> str:
    fault = address_fault(text)
    if fault:
        raise ValueError(f"`{text}`: {fault}")
    return text


def _pattern(text: str) -> str:
    if text.count(PATH) != 1:
        raise ValueError(
            f"`{PATH}` stands here {pluralize(text.count(PATH), 'time')} instead of once: "
            "it stands for the file of a page, such as docs/README.md"
        )
    _address(text.replace(PATH, "docs/README.md"))
    return text


_Words: TypeAlias = Annotated[str, Notation("a text", "Kiln", _words)]
_File: TypeAlias = Annotated[str, Notation("a file", "images/logo.svg", _words)]
_Colour: TypeAlias = Annotated[str, Notation("a colour", "#1b53d1", _colour)]
_Address: TypeAlias = Annotated[str, Notation("an address", "https://example.org/kiln", _address)]
_Pattern: TypeAlias = Annotated[
    str, Notation("an address", f"https://example.org/kiln/edit/main/{PATH}", _pattern)
]


class SiteSettings(BaseModel):
    """What a site looks like; a key that is left out is ""."""

    model_config = ConfigDict(extra="forbid", frozen=True)

    title: _Words = Key(
        default="", description="The name of the site; without it, the heading of docs/README.md."
    )
    logo: _File = Key(
        default="",
        description="The picture beside the title: its path below docs/. SVG, PNG, JPEG, WebP.",
    )
    icon: _File = Key(
        default="",
        description="The picture in the tab of a browser, likewise; without it, the logo.",
    )
    accent: _Colour = Key(
        default="",
        description="The colour of links and buttons, in quotes: # and six hex digits. The dark "
        "theme takes a lighter shade of it.",
    )
    accent_dark: _Colour = Key(
        default="", description="The same for the dark theme, where the lighter shade is not to be."
    )
    repository: _Address = Key(default="", description="The address of the sources, for a link.")
    edit: _Pattern = Key(
        default="", description=f"The address where a page is edited; {PATH} stands for its file."
    )
    footer: _Words = Key(default="", description="What stands below every page: plain text.")


def load_settings(source: Source) -> tuple[SiteSettings, Tree]:
    """Return what a text says, and where. Raises Unusable with all that is wrong in it."""
    try:
        tree, findings = read_values(source)
    except Unusable as error:
        if error.finding is None:
            raise Unusable(f"{source.name}: {error}", hint=error.hint) from None
        raise refused(source, [error.finding]) from None
    values: Any = tree.data
    if values is None:
        values = {}
    if not isinstance(values, dict):
        known = ", ".join(SiteSettings.model_fields)
        raise Unusable(f"{source.name} is no mapping of keys", hint=f"its keys are {known}")
    try:
        settings = SiteSettings.model_validate(values)
    except ValidationError as error:
        doubtful = {finding.span for finding in findings}
        shape = misfits(source, tree, error.errors(include_url=False), doubtful, SiteSettings)
        raise refused(source, [*findings, *shape]) from None
    if findings:
        raise refused(source, findings)
    return settings, tree


def refused(source: Source, findings: Iterable[Finding]) -> Unusable:
    """Return the error that names what is wrong with a file of settings, each with its place."""
    found = in_order(findings)
    told = "\n\n".join(finding.render(source) for finding in found)
    return Unusable(f"{source.name} has {pluralize(len(found), 'finding')}\n{told}")
