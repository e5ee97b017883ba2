"""Errata and unknowns: where the documents are wrong, and what they leave open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.protocol import claim_in_words, concern_in_words
from framegen.targets.docs.cite import CiteView, Place, cite_view

if TYPE_CHECKING:
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class ErratumView:
    """A mistake in a document."""

    number: int
    title: str
    cite: CiteView
    message: str
    concern: str
    document: str
    bytes: str
    here: str
    why: str
    place: Place


@dataclass(frozen=True, slots=True)
class UnknownView:
    """A question that no source answers."""

    number: int
    message: str
    concern: str
    what: str


def erratum_views(model: Model) -> list[ErratumView]:
    """Return every erratum, in the order of the spec."""
    return [
        ErratumView(
            number,
            erratum.title,
            cite_view(model.spec, erratum.cite),
            erratum.concerns.message,
            concern_in_words(erratum.concerns),
            claim_in_words(erratum.document),
            claim_in_words(erratum.bytes_),
            erratum.here,
            erratum.why,
            Place(("errata", number - 1)),
        )
        for number, erratum in enumerate(model.spec.errata, 1)
    ]


def unknown_views(model: Model) -> list[UnknownView]:
    """Return every unknown, in the order of the spec."""
    return [
        UnknownView(
            number, unknown.concerns.message, concern_in_words(unknown.concerns), unknown.what
        )
        for number, unknown in enumerate(model.spec.unknowns, 1)
    ]
