"""How much of a spec a recording covers: each message, each field, each example."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from framegen.audit.evidence import shown_by
from framegen.audit.values import Values, each_value, values_of_layout

if TYPE_CHECKING:
    from framegen.audit.evidence import Fact
    from framegen.audit.sighting import Sighting
    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True)
class Shown:
    """A frame that shows facts which no frame before it has shown."""

    data: bytes
    values: dict[str, Any]
    place: str
    facts: tuple[Fact, ...]


@dataclass
class MessageCoverage:
    """What was seen of one message. `unsure` frames may be a message of another direction, too.

    `parameters` are the values of the first bytes behind the head, counted from 1.
    """

    layout: MessageLayout
    values: dict[str, Values]
    seen: int = 0
    unsure: int = 0
    sizes: Counter[int] = field(default_factory=Counter)
    parameters: dict[int, Counter[int]] = field(default_factory=dict)
    shown: list[Shown] = field(default_factory=list)
    examples_seen: set[int] = field(default_factory=set)
    facts: set[tuple[str, ...]] = field(default_factory=set)

    @property
    def name(self) -> str:
        """The name of the message."""
        return self.layout.name

    @property
    def examples(self) -> list[Example]:
        """The examples that the spec has of it."""
        return self.layout.message.examples

    @property
    def unseen_examples(self) -> list[Example]:
        """Those of them that were never seen as they stand."""
        return [
            example
            for number, example in enumerate(self.examples)
            if number not in self.examples_seen
        ]


class Coverage:
    """The coverage of all messages of a model, counted one sighting after the other."""

    def __init__(self, model: Model, facts: list[Fact]) -> None:
        self.messages = {
            name: MessageCoverage(layout, values_of_layout(layout))
            for name, layout in model.messages.items()
        }
        self._examples = {
            name: {bytes(each.hex): number for number, each in enumerate(layout.message.examples)}
            for name, layout in model.messages.items()
        }
        # Frames that may be messages of either end.
        self.unsure = 0
        self._facts: dict[str, list[Fact]] = {}
        for fact in facts:
            if fact.path[0] == "messages":
                self._facts.setdefault(fact.path[1], []).append(fact)
        # The parameters that a question of the spec is about.
        self._parameters: dict[str, set[int]] = {}
        for unknown in model.spec.unknowns:
            if unknown.concerns.parameter is not None:
                of_message = self._parameters.setdefault(unknown.concerns.message, set())
                of_message.add(unknown.concerns.parameter)

    def add(self, sighting: Sighting) -> None:
        """Count a message; one that may be another counts as unsure for each."""
        message = sighting.message
        if message is None or sighting.undocumented:
            return
        if sighting.others:
            self.unsure += 1
            for name in (message.name, *sighting.others):
                self.messages[name].unsure += 1
            return
        covered = self.messages[message.name]
        covered.seen += 1
        covered.sizes[len(sighting.data)] += 1
        for path, value in each_value(message, sighting.values):
            covered.values[path].add(value)
        number = self._examples[message.name].get(sighting.data)
        if number is not None:
            covered.examples_seen.add(number)
        for parameter in self._parameters.get(message.name, ()):
            at = message.frame.body_at + parameter - 1
            if at < len(sighting.data) - message.frame.tail_size:
                covered.parameters.setdefault(parameter, Counter())[sighting.data[at]] += 1
        self._show(covered, sighting)

    def _show(self, covered: MessageCoverage, sighting: Sighting) -> None:
        """Keep the frame if it shows more than those before it, or the same in fewer bytes."""
        facts = self._facts.get(covered.name, [])
        longest = max((len(each.data) for each in covered.shown), default=0)
        if len(covered.facts) == len(facts) and len(sighting.data) >= longest:
            return
        # A spec cannot say in an example what is no number.
        said = (value for _, value in each_value(covered.layout, sighting.values))
        if not all(math.isfinite(value) for value in said if isinstance(value, float)):
            return
        paths = shown_by(covered.layout, sighting.values)
        new = tuple(each for each in facts if each.path in paths and each.path not in covered.facts)
        if new:
            covered.facts.update(each.path for each in new)
            covered.shown.append(Shown(sighting.data, sighting.values, sighting.place, new))
            return
        for at, each in enumerate(covered.shown):
            if len(sighting.data) < len(each.data) and paths.issuperset(
                fact.path for fact in each.facts
            ):
                kept = Shown(sighting.data, sighting.values, sighting.place, each.facts)
                covered.shown[at] = kept
