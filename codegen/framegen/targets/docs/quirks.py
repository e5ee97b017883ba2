"""Errata, unknowns and look-alikes: what no other page of a protocol tells."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from framegen.language.formula import Formula
from framegen.language.values import to_hex
from framegen.model.lookalikes import recognise
from framegen.model.slots import Constant
from framegen.model.verdict import weigh_whole
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.escape import paragraphs
from framegen.targets.docs.strip import Cell, given_strip, parts_strip

if TYPE_CHECKING:
    from framegen.language.spec import Concern, Lookalike
    from framegen.language.values import Direction
    from framegen.model.model import Model
    from framegen.model.slots import Number


@dataclass(frozen=True, slots=True)
class ErratumView:
    """One slip of a document."""

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
    """Something that nobody has written down."""

    message: str
    concern: str
    what: str


@dataclass(frozen=True, slots=True)
class ForeignFrame:
    """A frame of a look-alike, and what this protocol makes of it, one line a direction."""

    title: str
    hex: str
    query: str
    cells: list[Cell]
    verdicts: list[str]


@dataclass(frozen=True, slots=True)
class ForeignCode:
    """A code that means one thing there and another here, or nothing; `here` names messages."""

    code: int
    pattern: str
    there: str
    here: list[str]


@dataclass(frozen=True, slots=True)
class LookalikeView:
    """Another protocol, and how to tell it from this one."""

    key: str
    title: str
    about: list[str]
    cite: CiteView
    envelope: list[Cell]
    frames: list[ForeignFrame]
    codes: list[ForeignCode]


def erratum_views(model: Model) -> list[ErratumView]:
    """Every erratum, in the order of the spec."""
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
    """Every unknown, in the order of the spec."""
    return [
        UnknownView(unknown.concerns.message, _concern(unknown.concerns), unknown.what)
        for unknown in model.spec.unknowns
    ]


def _concern(concern: Concern) -> str:
    """Say which fact of the message is meant."""
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


def lookalike_views(model: Model) -> list[LookalikeView]:
    """Every look-alike, in the order of the spec."""
    return [
        LookalikeView(
            key,
            other.title,
            paragraphs(other.about),
            cite_view(model.spec, other.cite),
            parts_strip(model.lookalikes[key]) if other.frame else [],
            [_foreign(model, each.title, each.hex) for each in other.examples],
            _codes(model, other),
        )
        for key, other in model.spec.lookalikes.items()
    ]


def _foreign(model: Model, title: str, data: bytes) -> ForeignFrame:
    recognised = recognise(model, data)
    cells = [] if recognised is None else given_strip(recognised.parts, data)
    query = f"hex={data.hex()}&direction={model.directions[0].key}"
    verdicts = [_verdict(model, way, data) for way in model.directions]
    return ForeignFrame(title, to_hex(data), query, cells, verdicts)


def _verdict(model: Model, way: Direction, data: bytes) -> str:
    verdict = weigh_whole(model, [way], data)
    refused = f"no frame, {verdict.refusal}"
    said = refused if verdict.message is None else verdict.message.name
    return f"{way.sender} to {way.receiver}: {said}"


def _codes(model: Model, other: Lookalike) -> list[ForeignCode]:
    frame = model.frame
    found: list[ForeignCode] = []
    for code, there in other.commands.items():
        known = [message.name for message in model.messages.values() if message.id == code]
        pattern = ""
        if other.frame is None and code <= frame.id.high:
            pattern = " ".join(_headed(slot, code) for slot in frame.head)
        found.append(ForeignCode(code, pattern, there, known))
    return found


def _headed(slot: Constant | Number, code: int) -> str:
    """The bytes of a slot in front of the fields, as far as they are known of a code."""
    if isinstance(slot, Constant):
        return to_hex(slot.data)
    return to_hex(slot.write(code)) if slot.role == "id" else " ".join(["··"] * slot.size)
