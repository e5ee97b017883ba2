"""A second opinion: what an author knows of a changed spec, whose things keep their identity.

Each message, field, named value and bit carries a mark that stays with it, whatever it is called
and wherever it is put. What carries the same mark in two editions is the same thing: that is what
the author knows, and the spec says only where a name stayed or `was` tells of it.
"""

import json
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from itertools import count
from typing import Any

from framegen.checks import MODEL_RULES, STRUCTURE_RULES
from framegen.checks.rule import Problem
from framegen.comparison.edition import Edition
from framegen.compile import Compiled
from framegen.language.spec import Spec
from framegen.model.model import derive
from framegen.reading.source import Source
from framegen.reading.yamltree import KeyPath, Tree
from pydantic import ValidationError

from tests.factories import Data
from tests.random_specs import with_examples

MARK = "#"
# What a spec says of its documents: a change would have to be written down there as well.
_EVIDENCE = ("lookalikes", "errata", "unknowns", "reserved", "pose", "history")
# What an author corrects when something else has changed: it is dropped where it is wrong.
_DEPENDENT = {
    *("method", "lasts", "acknowledged", "echoed", "failure", "asks_for"),
    *("reply", "refusal", "reports"),
    *("limits", "absent", "signed_as"),
}
_fresh = count(1)


def marked(data: Data) -> Data:
    """Return a copy of a spec in which everything with a name carries a mark of its own."""
    spec: Data = json.loads(json.dumps(data))
    for key in _EVIDENCE:
        spec.pop(key, None)
    spec["endpoints"] = {
        name: {**(end if isinstance(end, dict) else {"about": end}), MARK: next(_fresh)}
        for name, end in spec["endpoints"].items()
    }
    for message in spec["messages"].values():
        message["examples"] = []
        message.setdefault("fields", {})
        message[MARK] = next(_fresh)
    for field in _all_fields(spec):
        field[MARK] = next(_fresh)
        for name, each in field.get("bits", {}).items():
            field["bits"][name] = each if isinstance(each, dict) else {"at": each}
        for each in (*field.get("values", {}).values(), *field.get("bits", {}).values()):
            each[MARK] = next(_fresh)
    for parts in kinds_of(spec).values():
        for part in parts.values():
            part[MARK] = next(_fresh)
            for each in part.get("values", {}).values():
                each[MARK] = next(_fresh)
    return spec


def unmarked(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: unmarked(each) for key, each in value.items() if key != MARK}
    return [unmarked(each) for each in value] if isinstance(value, list) else value


def kinds_of(spec: Data) -> dict[str, Data]:
    return spec.get("frames") or {"frame": spec["frame"]}


def parts_of(spec: Data, message: Data) -> Data:
    kinds = kinds_of(spec)
    return kinds[message.get("frame") or next(iter(kinds))]


def _all_fields(spec: Data) -> Iterator[Data]:
    outer = [each for message in spec["messages"].values() for each in message["fields"].values()]
    yield from outer
    yield from (each for field in outer for each in field.get("fields", {}).values())


def edition_of(spec: Data, label: str) -> Edition | None:
    """Return the edition that a marked spec is, None for one that no author could publish.

    Lengths follow from the fields; what has come to point at something that is gone is dropped.
    """
    for _ in range(12):
        values = unmarked(spec)
        try:
            read = Spec.model_validate(values)
        except ValidationError:
            return None
        problems = (each for rule in STRUCTURE_RULES for each in rule.look(read))
        found = _put_right(spec, problems)
        if found == "right":
            model = derive(read)
            problems = (each for rule in MODEL_RULES for each in rule.look(model))
            found = "changed" if _lengthened(spec, model) else _put_right(spec, problems)
            if found == "right":
                return _published(label, values)
        if found == "wrong":
            return None
    return None


def _published(label: str, values: Data) -> Edition:
    """Return the edition of a spec that keeps the rules, with frames of each message."""
    shown = with_examples(values)
    read = Spec.model_validate(shown)
    model = derive(read)
    compiled = Compiled(Source("made_up.yaml", ""), Tree(shown), [], read, model)
    return Edition(label, compiled, read, model)


def _lengthened(spec: Data, model: Any) -> bool:
    """Write down the lengths that follow from the fields; tell whether any is another."""
    changed = False
    for name, layout in model.messages.items():
        rule = layout.formula
        length = [*rule.sizes] if layout.optional else str(rule)
        if layout.message.length != rule:
            spec["messages"][name]["length"] = length
            changed = True
    return changed


def _put_right(spec: Data, problems: Iterable[Problem]) -> str:
    """Drop what points at nothing: `right`, `changed`, or `wrong` where something else is."""
    dropped = [_drop(spec, problem.path) for problem in problems]
    return "right" if not dropped else "changed" if all(dropped) else "wrong"


def _drop(spec: Data, path: KeyPath) -> bool:
    """Drop the dependent key at a path, or around it."""
    at = next((number for number, step in enumerate(path) if step in _DEPENDENT), None)
    if at is None:
        return False
    around: Any = spec
    for step in path[:at]:
        around = around[step]
    around.pop(path[at], None)
    return True


@dataclass(frozen=True)
class Names:
    """The author's map of names: what is called what in the other edition.

    `unsaid` are the old names of what has another name, which neither edition says with `was`.
    """

    to_new: Mapping[str, str]
    unsaid: frozenset[str]
    removed: tuple[str, ...]
    added: tuple[str, ...]

    @cached_property
    def to_old(self) -> dict[str, str]:
        return {new: old for old, new in self.to_new.items()}

    @property
    def turned(self) -> "Names":
        unsaid = frozenset(self.to_new[name] for name in self.unsaid)
        return Names(self.to_old, unsaid, self.added, self.removed)


def names_of(old: Data, new: Data) -> Names:
    """Return what became of the names of marked things."""
    by_mark = {each.get(MARK): name for name, each in new.items()}
    to_new = {name: by_mark[each[MARK]] for name, each in old.items() if each.get(MARK) in by_mark}
    unsaid = {
        name
        for name, other in to_new.items()
        if name != other
        and name not in _listed(new[other].get("was", ()))
        and other not in _listed(old[name].get("was", ()))
    }
    return Names(
        to_new,
        frozenset(unsaid),
        tuple(name for name in old if name not in to_new),
        tuple(name for name in new if name not in to_new.values()),
    )


def _listed(names: Any) -> tuple[str, ...]:
    return (names,) if isinstance(names, str) else tuple(names)


@dataclass(frozen=True, eq=False)
class Author:
    """Who made the new edition from the old one, and knows what became of everything."""

    old: Data
    new: Data

    @property
    def turned(self) -> "Author":
        return Author(self.new, self.old)

    @cached_property
    def ends(self) -> Names:
        return names_of(self.old["endpoints"], self.new["endpoints"])

    @cached_property
    def messages(self) -> Names:
        return names_of(self.old["messages"], self.new["messages"])

    def fields(self, old: str, new: str) -> Names:
        """Return the names of the fields of a message; of an address and a counter, too."""
        return names_of(self._given(self.old, old), self._given(self.new, new))

    @staticmethod
    def _given(spec: Data, name: str) -> Data:
        message = spec["messages"][name]
        parts = parts_of(spec, message)
        envelope = {key: each for key, each in parts.items() if each["is"] in _GIVEN}
        return {**envelope, **message["fields"]}


_GIVEN = ("address", "counter")
