"""Errata and unknowns: where the documents are wrong, and what they leave open."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.language.formula import Formula
from framegen.targets.docs.cite import CiteView, Place, cite_view

if TYPE_CHECKING:
    from framegen.language.spec import Concern
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
            _concern(erratum.concerns),
            _shown(erratum.document),
            _shown(erratum.bytes_),
            erratum.here,
            erratum.why,
            Place(("errata", number - 1)),
        )
        for number, erratum in enumerate(model.spec.errata, 1)
    ]


def unknown_views(model: Model) -> list[UnknownView]:
    """Return every unknown, in the order of the spec."""
    return [
        UnknownView(unknown.concerns.message, _concern(unknown.concerns), unknown.what)
        for unknown in model.spec.unknowns
    ]


def _concern(concern: Concern) -> str:
    """Name the fact of the message that is meant."""
    words = [] if concern.fact is None else [f"its {concern.fact}"]
    if concern.parameter is not None:
        words.append(f"parameter {concern.parameter}")
    if concern.field is not None:
        words.append(concern.field)
    if concern.example is not None:
        words.append(f"in example {concern.example}" if words else f"example {concern.example}")
    return " ".join(words)


def _shown(value: Any) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, list):
        return ", ".join(_shown(item) for item in value)
    return str(value) if not isinstance(value, Formula) else f"length {value}"
