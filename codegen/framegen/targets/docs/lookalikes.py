"""Look-alikes: protocols that are easily taken for this one, and how to tell them apart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.explain.lookalikes import recognise
from framewire.explain.words import listed

from framegen.language.values import to_hex
from framegen.model.checksums import CHECKSUMS
from framegen.model.slots import Constant
from framegen.model.verdict import weigh_whole
from framegen.targets.docs.checksum_steps import as_formula, worked_out
from framegen.targets.docs.cite import CiteView, cite_view
from framegen.targets.docs.escape import paragraphs
from framegen.targets.docs.strip import Cell, given_strip, parts_strip
from framegen.targets.docs.way import in_prose

if TYPE_CHECKING:
    from framegen.language.spec import Lookalike
    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model
    from framegen.model.slots import Number


@dataclass(frozen=True, slots=True)
class LookalikeFrame:
    """A frame of a look-alike, and the verdict of this protocol in each direction."""

    title: str
    hex: str
    query: str
    cells: list[Cell]
    proofs: list[str]
    verdicts: list[str]


@dataclass(frozen=True, slots=True)
class ChecksumView:
    """A checksum of a look-alike, which tells its frames for certain: in words and as a formula."""

    name: str
    text: str
    formula: str


@dataclass(frozen=True, slots=True)
class LookalikeCommand:
    """An id of a look-alike, its meaning there, and the messages with that id here."""

    id: int
    pattern: str
    there: str
    here: list[str]


@dataclass(frozen=True, slots=True)
class LookalikeEntry:
    """Another protocol, and how to tell it from this one."""

    key: str
    title: str
    about: list[str]
    cite: CiteView
    envelope: list[Cell]
    checksums: list[ChecksumView]
    frames: list[LookalikeFrame]
    commands: list[LookalikeCommand]


def lookalike_views(model: Model) -> list[LookalikeEntry]:
    """Return every look-alike, in the order of the spec."""
    return [
        LookalikeEntry(
            key,
            other.title,
            paragraphs(other.about),
            cite_view(model.spec, other.cite),
            [] if facts.envelope is None else parts_strip(facts.envelope),
            _checksums(model.lookalikes[key]) if other.frame else [],
            [_frame(model, model.lookalikes[key], each.title, each.hex) for each in other.examples],
            _commands(model, other),
        )
        for key, other in model.spec.lookalikes.items()
        for facts in (model.protocol.lookalikes[key],)
    ]


def _checksums(frame: Envelope) -> list[ChecksumView]:
    return [
        ChecksumView(
            slot.name,
            f"the {slot.method} of {listed(slot.of)}: {CHECKSUMS[slot.method].about}",
            as_formula(slot.method, slot.size, slot.of),
        )
        for slot in frame.checksums
    ]


def _proofs(frame: Envelope, data: bytes) -> list[str]:
    """Work out the checksums of a frame."""
    return [
        f"{slot.name}: {worked_out(slot.method, slot.size, frame.covered(slot, {}).of(data))}"
        for slot in frame.checksums
    ]


def _frame(model: Model, frame: Envelope, title: str, data: bytes) -> LookalikeFrame:
    recognised = recognise(model.protocol, data)
    cells = [] if recognised is None else given_strip(recognised.parts, data)
    query = f"hex={data.hex()}&direction={model.directions[0].key}"
    verdicts = [_verdict(model, way, data) for way in model.directions]
    return LookalikeFrame(
        title, to_hex(data), query, cells, _proofs(frame, data) if cells else [], verdicts
    )


def _verdict(model: Model, way: Direction, data: bytes) -> str:
    verdict = weigh_whole(model, [way], data)
    refused = f"no frame, {verdict.refusal}"
    said = refused if verdict.message is None else verdict.message.name
    return in_prose(f"{way}: {said}", model)


def _commands(model: Model, other: Lookalike) -> list[LookalikeCommand]:
    frame = model.frame
    found: list[LookalikeCommand] = []
    for id_, there in other.commands.items():
        known = [name for name, each in model.messages.items() if each.ids == (id_,)]
        pattern = ""
        if other.frame is None and frame.id_part is not None and id_ <= frame.id.high:
            pattern = " ".join(_head(slot, id_) for slot in frame.head)
        found.append(LookalikeCommand(id_, pattern, there, known))
    return found


def _head(slot: Constant | Number, id_: int) -> str:
    """Return the bytes of a slot in front of the fields, as far as the id determines them."""
    if isinstance(slot, Constant):
        return to_hex(slot.data)
    return to_hex(slot.write(id_)) if slot.role == "id" else " ".join(["··"] * slot.size)
