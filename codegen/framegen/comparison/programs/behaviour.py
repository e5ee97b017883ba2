"""The behaviour of a library: whether values are still taken, and still mean the same."""

from __future__ import annotations

import re
from itertools import islice
from typing import TYPE_CHECKING, Any

from framegen.comparison.edges import values_to_try
from framegen.comparison.effect import Effect
from framegen.comparison.meaning import differences
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
    from framegen.model.slots import Field
    from framegen.reading.yamltree import KeyPath

_INDEX = re.compile(r"\[\d+\]")
# So many frames of a message are decoded without saying which way they went.
_FEW = 24
_LONG = 60


def value_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each field whose values are refused, or mean another thing."""
    for name, other in pair.messages.to_new.items():
        yield from _Values(pair, name, other).effects()


def preference_effects(pair: Pair) -> Iterator[Effect]:
    """Yield an effect for each message that is preferred, or not, where no direction is given."""
    models = pair.old.model, pair.new.model
    if all(len(model.directions) == 1 for model in models):
        return
    for name, other in pair.messages.to_new.items():
        messages = models[0].messages[name], models[1].messages[other]
        fields = pair.fields(*messages)
        for values in islice(values_to_try(*messages, dict(fields.to_new), pairs=False), _FEW):
            said = _whole(fields, *messages, values)
            try:
                frames = encode(messages[0], values), encode(messages[1], said)
            except Unencodable:
                continue
            one, another = (
                weigh_whole(model, model.directions, frame).message
                for model, frame in zip(models, frames, strict=True)
            )
            if one is None or another is None:
                continue
            if pair.messages.to_new.get(one.name, one.name) != another.name:
                text = (
                    f"`decode(frame, None)` makes {another.name} of {other}; it made {one.name} "
                    f"of {name}"
                )
                yield Effect("programs", "order", ("messages", name), ("messages", other), text)
                break


class _Values:
    """One message of the old library, and what the new one makes of its values."""

    def __init__(self, pair: Pair, name: str, other: str) -> None:
        self.pair = pair
        self.old = pair.old.model.messages[name]
        self.new = pair.new.model.messages[other]
        self.fields = pair.fields(self.old, self.new)
        # What every frame of the new edition may have; the longest, so that nothing is absent.
        usual = values_to_try(self.new, self.old, dict(self.fields.to_old), pairs=False)
        self.usual = next(iter(usual))
        self.told: set[tuple[str, str]] = set()

    def effects(self) -> Iterator[Effect]:
        """Yield what becomes of the values at the edges."""
        for values in values_to_try(self.old, self.new, dict(self.fields.to_new), pairs=False):
            said = _whole(self.fields, self.old, self.new, values, self.usual)
            try:
                frame = encode(self.new, said)
            except Unencodable as error:
                yield from self._refused(values, said, error)
                continue
            yield from self._read(values, values_of(self.new, frame))

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
            except Unencodable as problem:
                found = True
                path = _path(self.old, slot.name, str(problem), slot)
                value = _shown(values[slot.name])
                text = f"`{self.new.name}({name}={value})` is refused: {problem}"
                yield from self._told("refused", path, text)
        # What may be absent may not be so any more, which its default says; or else sizes do not fit.
        given = any(said[slot.name] is None for slot in self.new.arguments if not slot.optional)
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
                yield from self._told("meaning", _INDEX.sub("", each.path), each.text)

    def _told(self, outcome: str, path: str, text: str) -> Iterator[Effect]:
        if (outcome, path) in self.told:
            return
        self.told.add((outcome, path))
        old, new = _paths(self.pair, self.old, self.new, path)
        text = text if outcome == "refused" else f"`{self.new.name}`: {text}"
        yield Effect("programs", outcome, old, new, text)


def _whole(
    fields: Pairing,
    old: MessageLayout,
    new: MessageLayout,
    values: Mapping[str, Any],
    usual: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """Return values under their new names, with usual ones for what the old edition has not."""
    if usual is None:
        usual = next(iter(values_to_try(new, old, dict(fields.to_old), pairs=False)))
    said = dict(usual)
    theirs = {slot.name: slot for slot in new.arguments}
    said |= {slot.name: None for slot in new.optional}
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


def _path(layout: MessageLayout, name: str, problem: str, slot: Field) -> str:
    """Return the field that a problem is about: `targets.position` where an element is refused."""
    inner = problem.partition(":")[0].rpartition(".")[2]
    inside = isinstance(slot, Items) and any(each.name == inner for each in slot.fields)
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
        parts = frame_path(pair.old.model, old.frame.name), frame_path(
            pair.new.model, new.frame.name
        )
        return (*parts[0], name), (*parts[1], other)
    ours, theirs = (*ours, "fields", name), (*theirs, "fields", other)
    one = next(slot for slot in old.arguments if slot.name == name)
    another = next((slot for slot in new.arguments if slot.name == other), None)
    if isinstance(one, Items) and isinstance(another, Items):
        moved = element_fields(one, another).to_new.get(inner)
        if moved is not None:
            return (*ours, "fields", inner), (*theirs, "fields", moved)
    return ours, theirs


def _shown(value: object) -> str:
    if isinstance(value, list) and len(value) > 3:  # noqa: PLR2004 - what fits a line
        return f"[{len(value)} of them]"
    shown = repr([tuple(each.values()) for each in value] if _is_elements(value) else value)
    return shown if len(shown) <= _LONG else f"{shown[:_LONG]}.."


def _is_elements(value: object) -> Any:
    return isinstance(value, list) and bool(value) and isinstance(value[0], dict)
