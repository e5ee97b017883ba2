"""The facts of a spec, each with the kind of source it is known from, and those seen on hardware.

A fact is a message, a field, a value with a name, a note, the line or a kind of board. It is seen
on hardware if it is cited from an observation, or if an example that is shows it.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, TypeAlias

from framewire.frame.pluralize import pluralize

from framegen.language.spec import ListField
from framegen.model.codec import values_of

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import AnyField, Message, Note, Spec
    from framegen.language.values import Citation
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

Path: TypeAlias = "tuple[str, ...]"
What: TypeAlias = Literal["message", "field", "named value", "note", "link", "board"]

OBSERVATION = "observation"


@dataclass(frozen=True, slots=True)
class Fact:
    """A fact by its path in the spec, the kind of its source, and whether hardware has shown it."""

    path: Path
    what: What
    kind: str
    seen: bool

    @property
    def place(self) -> str:
        """Its path as people write it: `messages.ServoMove.fields.time_ms`."""
        return ".".join(self.path)

    @property
    def name(self) -> str:
        """Its name within its message: `targets.position`, or `position = absent`."""
        if self.path[0] != "messages" or self.what == "message":
            return self.path[-1]
        # A name follows each key.
        *around, last = self.path[3::2]
        if not around and self.what == "note":
            return "a note"
        if self.what == "named value":
            return f"{'.'.join(around)} = {last}"
        return f"a note on {'.'.join(around)}" if self.what == "note" else ".".join([*around, last])


@dataclass(frozen=True)
class Evidence:
    """What a spec is known from: its facts, and its open questions."""

    name: str
    version: str
    messages: int
    facts: list[Fact]
    questions: int

    @cached_property
    def seen(self) -> int:
        """How many of the facts are known from hardware."""
        return sum(fact.seen for fact in self.facts)

    @cached_property
    def by_kind(self) -> dict[str, int]:
        """How many facts each kind of source has."""
        found: dict[str, int] = {}
        for fact in self.facts:
            found[fact.kind] = found.get(fact.kind, 0) + 1
        return found

    def __str__(self) -> str:
        messages = pluralize(self.messages, "message")
        questions = pluralize(self.questions, "question")
        return (
            f"{self.name} {self.version}: {messages}, {self.seen} of "
            f"{pluralize(len(self.facts), 'fact')} seen on hardware, {questions} open"
        )


def evidence(model: Model) -> Evidence:
    """Count the facts of a spec by what they are known from."""
    spec = model.spec
    return Evidence(
        spec.protocol.name,
        spec.protocol.version,
        len(model.messages),
        [*facts_of(model)],
        len(spec.unknowns),
    )


def facts_of(model: Model) -> Iterator[Fact]:
    """Yield every fact of a spec, in its order."""
    spec = model.spec
    yield from _notes(spec, ("protocol",), spec.protocol.notes)
    for name, end in spec.endpoints.items():
        yield from _notes(spec, ("endpoints", name), end.notes)
    if spec.link.cite is not None:
        yield _fact(spec, ("link",), "link", spec.link.cite)
    for number, board in enumerate(spec.link.usb_hid):
        cite = board.cite or spec.link.cite
        if cite is not None:
            yield _fact(spec, ("link", "usb_hid", str(number)), "board", cite)
    for kind, parts in spec.envelopes.items():
        around = ("frames", kind) if spec.frames else ("frame",)
        for name, part in parts.items():
            yield from _notes(spec, (*around, name), part.notes)
    for name, message in spec.messages.items():
        shown = _observed(spec, model.messages[name])
        path = ("messages", name)
        yield _fact(spec, path, "message", message.cite, seen=path in shown)
        yield from _notes(spec, path, message.notes)
        for key, field in message.fields.items():
            yield from _of_field(spec, message, (*path, "fields", key), field, shown)


def shown_by(message: MessageLayout, values: Mapping[str, Any]) -> set[Path]:
    """Return the paths of the facts that a frame with these values shows."""
    path: Path = ("messages", message.name)
    found = {path}
    for key, field in message.message.fields.items():
        here = (*path, "fields", key)
        # What is no argument follows from the rest of the frame, and is there with it.
        value = values.get(key, 0)
        if value is None or value == []:
            continue
        found.add(here)
        if isinstance(field, ListField):
            for inner, number in field.fields.items():
                found.add((*here, "fields", inner))
                said = {item.get(inner) for item in value} if isinstance(value, list) else set()
                named = number.values.items()
                found |= {
                    (*here, "fields", inner, "values", name)
                    for name, each in named
                    if each.value in said
                }
        else:
            listed = value if isinstance(value, list) else [value]
            if key in values:
                found |= {
                    (*here, "values", name)
                    for name, each in field.values.items()
                    if each.value in listed
                }
    return found


def _observed(spec: Spec, message: MessageLayout) -> set[Path]:
    """Return the paths of facts that examples show which were captured."""
    found: set[Path] = set()
    for example in message.message.examples:
        if example.cite is not None and _kind(spec, example.cite) == OBSERVATION:
            found |= shown_by(message, values_of(message, bytes(example.hex)))
    return found


def _of_field(
    spec: Spec,
    message: Message,
    path: Path,
    field: AnyField,
    shown: set[Path],
    around: Citation | None = None,
) -> Iterator[Fact]:
    cite = field.cite or around or message.cite
    yield _fact(spec, path, "field", cite, seen=path in shown)
    yield from _notes(spec, path, field.notes)
    if isinstance(field, ListField):
        for name, inner in field.fields.items():
            yield from _of_field(spec, message, (*path, "fields", name), inner, shown, cite)
        return
    for name, value in field.values.items():
        here = (*path, "values", name)
        yield _fact(spec, here, "named value", value.cite or cite, seen=here in shown)


def _notes(spec: Spec, path: Path, notes: list[Note]) -> Iterator[Fact]:
    for number, note in enumerate(notes):
        yield _fact(spec, (*path, "notes", str(number)), "note", note.cite)


def _fact(spec: Spec, path: Path, what: What, cite: Citation, *, seen: bool = False) -> Fact:
    kind = _kind(spec, cite)
    return Fact(path, what, kind, seen or kind == OBSERVATION)


def _kind(spec: Spec, cite: Citation) -> str:
    return spec.sources[cite.source].kind
