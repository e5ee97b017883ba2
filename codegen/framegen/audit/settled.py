"""What a recording settles: the open questions that it speaks of, and facts that hardware shows."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.audit.evidence import OBSERVATION
from framegen.audit.words import described
from framegen.language.values import to_hex
from framegen.reading.yamltext import flow, scalar

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.audit.coverage import Coverage, MessageCoverage, Shown
    from framegen.audit.evidence import Fact
    from framegen.language.spec import Concern, Unknown
    from framegen.model.model import Model

# What stands in the place of a name that only the one who recorded can give.
_NO_NAME = "NAME THE BOARD"
_SOURCE = "hardware"


@dataclass(frozen=True)
class Question:
    """An open question of the spec, and what was seen of what it is about."""

    number: int
    unknown: Unknown
    seen: list[str]

    @property
    def about(self) -> str:
        """What it is about: `ServoMove.targets.position`, or `Stop parameter 2`."""
        return about(self.unknown.concerns)


@dataclass(frozen=True)
class Raised:
    """Facts of one message that hardware shows now, with the frames to write down as examples."""

    message: MessageCoverage
    facts: list[Fact]
    shown: list[Shown]
    source: str
    device: str

    @property
    def yaml(self) -> str:
        """The examples, ready to be put into the spec."""
        return "\n".join(line for each in self.shown for line in self._example(each))

    def _example(self, shown: Shown) -> Iterator[str]:
        title = f"Seen on hardware: {', '.join(each.name for each in shown.facts)}"
        for number, example in enumerate(self.message.examples, 1):
            if example.hex == shown.data:
                yield f"      # Example {number} is confirmed: leave it and its source as they are."
        yield f"      - title: {scalar(title)}"
        yield f"        hex: {to_hex(shown.data)}"
        yield f"        values: {flow(shown.values)}"
        cite = f"{self.source}, report of {self.device or _NO_NAME}"
        yield f"        cite: {scalar(cite)}"


def about(concern: Concern) -> str:
    """Name what a question is about."""
    if concern.example is not None:
        return f"{concern.message} example {concern.example}"
    if concern.field is not None:
        return f"{concern.message}.{concern.field}"
    if concern.parameter is not None:
        return f"{concern.message} parameter {concern.parameter}"
    return f"{concern.message} {concern.fact}" if concern.fact else concern.message


def questions(model: Model, coverage: Coverage, answered: frozenset[str]) -> list[Question]:
    """Return the open questions about what a device sent, and about requests that it answered."""
    found = [
        Question(number, unknown, [*_seen(covered, unknown.concerns)])
        for number, unknown in enumerate(model.spec.unknowns)
        if (covered := coverage.messages.get(unknown.concerns.message)) is not None
        if _shows_the_board(model, covered, answered)
    ]
    return [each for each in found if each.seen]


def _shows_the_board(model: Model, covered: MessageCoverage, answered: frozenset[str]) -> bool:
    """Tell whether it shows anything of a board: that a client sent something does not."""
    return covered.layout.direction.sender != model.roles.client or covered.name in answered


def _seen(covered: MessageCoverage, concern: Concern) -> Iterator[str]:
    if not covered.seen:
        return
    sender = covered.layout.direction.sender
    if concern.example is not None:
        if concern.example - 1 in covered.examples_seen:
            yield f"example {concern.example} was seen as it stands, sent by the {sender}"
        return
    paths = [
        path
        for path in covered.values
        if concern.field is None
        or path.removesuffix("[]") == concern.field
        or path.startswith(f"{concern.field}.")
    ]
    times = f"seen {pluralize(covered.seen, 'time')}, sent by the {sender}"
    if concern.parameter is not None:
        counted = covered.parameters.get(concern.parameter)
        if counted:
            values = ", ".join(f"{each:02X}" for each in sorted(counted)[:16])
            yield f"{times}; parameter {concern.parameter} was {values}"
    elif concern.fact in ("id", "kind", "length"):
        sizes = ", ".join(map(str, sorted(covered.sizes)[:16]))
        yield f"{times}, in frames of {sizes} bytes"
    elif concern.field is not None:
        said = [
            f"{path} {described(covered.values[path])}"
            for path in paths
            if covered.values[path].seen
        ]
        if said:
            yield f"{times}; {'; '.join(said)}"
    else:
        said = [
            f"{path} {described(covered.values[path])}"
            for path in paths
            if covered.values[path].seen
        ]
        yield "; ".join([times, *said])


def raised(model: Model, coverage: Coverage, answered: frozenset[str], device: str) -> list[Raised]:
    """Return the facts that are raised: what a device sent, and requests that it answered.

    `device` is the name of the board, empty where it is not known.
    """
    sources = [name for name, each in model.spec.sources.items() if each.kind == OBSERVATION]
    source = next(iter(sources), _SOURCE)
    found: list[Raised] = []
    for covered in coverage.messages.values():
        if not _shows_the_board(model, covered, answered):
            continue
        shown = [each for each in covered.shown if any(not fact.seen for fact in each.facts)]
        facts = [fact for each in shown for fact in each.facts if not fact.seen]
        if facts:
            found.append(Raised(covered, facts, shown, source, device))
    return found
