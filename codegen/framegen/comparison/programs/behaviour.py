"""The behaviour of a library: whether values are still taken, and still mean the same."""

from __future__ import annotations

import re
from itertools import islice
from typing import TYPE_CHECKING, Any

from framegen.comparison.edges import values_to_try
from framegen.comparison.effect import Effect
from framegen.comparison.meaning import always_of, differences
from framegen.comparison.pair import element_fields
from framegen.comparison.programs.origins import frame_path
from framegen.model.codec import Unencodable, encode, values_of
from framegen.model.slots import Items
from framegen.model.verdict import weigh_whole

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.comparison.pair import Pair
    from framegen.comparison.pairing import Pairing
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field
    from framegen.reading.yamltree import KeyPath

_INDEX = re.compile(r"\[\d+\]")
# So many frames of a message are decoded without saying which way they went.
_FEW = 100
# What is shown of a value, at most.
_LONG = 60
_SHORT = 3


def value_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each field whose values are refused, or mean another thing."""
    for name, other in pair.messages.to_new.items():
        old, new = pair.old.model.messages[name], pair.new.model.messages[other]
        if (old.slots, old.counts) != (new.slots, new.counts):
            yield from _Values(pair, name, other).effects()


def preference_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each message that is preferred, or not, where no direction is given."""
    models = pair.old.model, pair.new.model
    lines = [[(name, each.slots, each.ids) for name, each in m.messages.items()] for m in models]
    if lines[0] == lines[1] and models[0].directions == models[1].directions:
        return
    for name, other in pair.messages.to_new.items():
        old, new = models[0].messages[name], models[1].messages[other]
        for one, another in _preferred(pair, old, new):
            # That a message is gone is told by itself.
            if pair.messages.to_new.get(one, another) != another:
                text = f"reads frames of {other} as {another} now, and read them as {one} before"
                paths = ("messages", name), ("messages", other)
                yield Effect("programs", "order", *paths, f"`decode(frame, None)` {text}")
                break


def _preferred(pair: Pair, old: MessageLayout, new: MessageLayout) -> Iterator[tuple[str, str]]:
    """Yield what frames of a message are taken for in the old library, and in the new."""
    fields = pair.fields(old, new)
    usual = _usual(fields, old, new)
    for values in islice(values_to_try(old, new, dict(fields.to_new), pairs=False), _FEW):
        frame = _written(old, values)
        again = _written(new, _whole(fields, old, new, values, usual))
        if frame is not None and again is not None:
            one = _taken_for(pair.old.model, frame)
            another = _taken_for(pair.new.model, again)
            if one and another:
                yield one, another


def _taken_for(model: Model, frame: bytes) -> str:
    """Return the message that a frame is taken for where no direction is given; "" for none."""
    message = weigh_whole(model, model.directions, frame).message
    return "" if message is None else message.name


def _written(message: MessageLayout, values: Mapping[str, Any]) -> bytes | None:
    """Return a frame, None if the message cannot be written at all: its spec is against itself."""
    try:
        return encode(message, values)
    except (Unencodable, OverflowError, IndexError):
        return None


def _usual(fields: Pairing, old: MessageLayout, new: MessageLayout) -> dict[str, Any]:
    return next(values_to_try(new, old, dict(fields.to_old), pairs=False))


class _Values:
    """One message of the old library, and what the new one makes of its values."""

    def __init__(self, pair: Pair, name: str, other: str) -> None:
        self.pair = pair
        self.old = pair.old.model.messages[name]
        self.new = pair.new.model.messages[other]
        self.fields = pair.fields(self.old, self.new)
        # What every frame of the new edition may have; the longest, so that nothing is absent.
        self.usual = _usual(self.fields, self.old, self.new)
        self.told: set[tuple[str, str]] = set()

    def effects(self) -> Iterator[Effect]:
        """Yield what becomes of the values at the edges, and of counts."""
        yield from self._counts()
        for values in values_to_try(self.old, self.new, dict(self.fields.to_new), pairs=False):
            said = _whole(self.fields, self.old, self.new, values, self.usual)
            try:
                frame = encode(self.new, said)
            except Unencodable as error:
                yield from self._refused(values, said, error)
                continue
            except (OverflowError, IndexError):
                # The spec is against itself.
                continue
            yield from self._read(values, values_of(self.new, frame))

    def _counts(self) -> Iterator[Effect]:
        """Yield an effect for each count that counts something else, such as bytes."""
        old, new = _counters(self.old), _counters(self.new)
        for name, counted in old.items():
            other = self.fields.to_new.get(name)
            if other not in new:
                continue
            said = {(self.fields.to_new.get(each, ""), step) for each, step in counted}
            if said != new[other]:
                text = f"{name} counts {_counting(counted)}; now it is {_counting(new[other])}"
                yield from self._told("meaning", name, text)

    def _refused(
        self, values: Mapping[str, Any], said: Mapping[str, Any], error: Unencodable
    ) -> Iterator[Effect]:
        """Yield an effect for each argument that is refused by itself, or else for all of them."""
        found = False
        for slot in self.old.arguments:
            name = self.fields.to_new.get(slot.name)
            if name is None or said.get(name) is None or name not in self.usual:
                continue
            try:
                encode(self.new, {**self.usual, name: said[name]})
            except (OverflowError, IndexError):
                continue
            except Unencodable as problem:
                found = True
                path = _path(slot.name, str(problem), slot)
                value = _shown(values[slot.name])
                call = f"`{self.new.name}({name}={value})`"
                text = f"{call} is refused: {problem}"
                yield from self._told("refused", path, text)
        # That something may not be absent any more is said of its default; else sizes do not fit.
        given = any(
            said[slot.name] is None for slot in self.new.arguments if slot not in self.new.optional
        )
        if not (found or given or self._needs_more):
            yield from self._told("refused", "", f"`{self.new.name}` refuses values: {error}")

    @property
    def _needs_more(self) -> bool:
        """Whether it has arguments that the old library knows nothing of."""
        known = self.fields.to_old
        return any(slot.name not in known for slot in self.new.arguments)

    def _read(self, values: Mapping[str, Any], read: Mapping[str, Any]) -> Iterator[Effect]:
        for each in differences(self.fields, self.old, self.new, values, read):
            if each.outcome == "misread":
                yield from self._told("meaning", _INDEX.sub("", each.path), _meant(each.text))

    def _told(self, outcome: str, path: str, text: str) -> Iterator[Effect]:
        if (outcome, path) in self.told:
            return
        self.told.add((outcome, path))
        old, new = _paths(self.pair, self.old, self.new, path)
        text = text if outcome == "refused" else f"`{self.new.name}`: {text}"
        yield Effect("programs", outcome, old, new, text)


def _meant(text: str) -> str:
    """Return what is wrong with a value as programs have it, which read no frames."""
    return text.replace(" is read as ", " means ")


def _counters(message: MessageLayout) -> dict[str, set[tuple[str, int]]]:
    """Return the lists that each count tells of, and how much it grows with an element of each."""
    found: dict[str, set[tuple[str, int]]] = {}
    for items in message.arguments:
        if isinstance(items, Items):
            steps = (items.field.counted_by, 1), (items.field.sized_by, items.size)
            for name, step in steps:
                if name is not None:
                    found.setdefault(name, set()).add((items.name, step))
    return found


def _counting(counted: set[tuple[str, int]]) -> str:
    return ", ".join(f"{step} for each of {name}" for name, step in sorted(counted, key=str))


def _whole(
    fields: Pairing,
    old: MessageLayout,
    new: MessageLayout,
    values: Mapping[str, Any],
    usual: Mapping[str, Any],
) -> dict[str, Any]:
    """Return values under their new names, with usual ones for what the old edition has not."""
    said = dict(usual)
    theirs = {slot.name: slot for slot in new.arguments}
    said |= {slot.name: None for slot in new.optional}
    for name, value in always_of(old.body):
        other_name = fields.to_new.get(name)
        if other_name in theirs:
            said[other_name] = value
    for slot in old.arguments:
        other = theirs.get(fields.to_new.get(slot.name, ""))
        if other is not None and other.name in usual:
            said[other.name] = _element_values(slot, other, values[slot.name], usual[other.name])
    return said


def _element_values(old: Field, new: Field, value: Any, usual: Any) -> Any:
    if not isinstance(old, Items) or not isinstance(new, Items) or not isinstance(value, list):
        return value
    if old.element is None or new.element is None:
        return value
    names = element_fields(old, new).to_new
    whole = dict(usual[0]) if usual else {}
    return [
        {**whole, **{names[name]: each for name, each in item.items() if name in names}}
        for item in value
    ]


def _path(name: str, problem: str, slot: Field) -> str:
    """Return the field that a problem is about: `targets.position` where an element is refused."""
    inner = problem.partition(":")[0].rpartition(".")[2]
    inside = (
        isinstance(slot, Items) and slot.element and any(each.name == inner for each in slot.fields)
    )
    return f"{name}.{inner}" if inside else name


def _paths(
    pair: Pair, old: MessageLayout, new: MessageLayout, path: str
) -> tuple[KeyPath, KeyPath]:
    """Return the paths in both editions of a field, `targets.position`, or of the message."""
    ours: KeyPath = ("messages", old.name)
    theirs: KeyPath = ("messages", new.name)
    name, _, inner = path.partition(".")
    if not name:
        return ours, theirs
    fields = pair.fields(old, new)
    other = fields.to_new[name]
    if any(slot.name == name for slot in old.frame.given):
        parts = (
            frame_path(pair.old.model, old.frame.name),
            frame_path(pair.new.model, new.frame.name),
        )
        return (*parts[0], name), (*parts[1], other)
    ours, theirs = (*ours, "fields", name), (*theirs, "fields", other)
    # Counts are no arguments.
    one = next((slot for slot in old.arguments if slot.name == name), None)
    another = next((slot for slot in new.arguments if slot.name == other), None)
    if isinstance(one, Items) and isinstance(another, Items):
        moved = element_fields(one, another).to_new.get(inner)
        if moved is not None:
            return (*ours, "fields", inner), (*theirs, "fields", moved)
    return ours, theirs


def _shown(value: Any) -> str:
    if isinstance(value, list) and len(value) > _SHORT:
        return f"[{len(value)} of them]"
    if isinstance(value, list):
        value = [tuple(each.values()) if isinstance(each, dict) else each for each in value]
    shown = repr(value)
    return shown if len(shown) <= _LONG else f"{shown[:_LONG]}.."
