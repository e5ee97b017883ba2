"""Both editions, thing by thing: what the rules look at, so that none of them matches names."""

from __future__ import annotations

from functools import cached_property
from itertools import chain
from typing import TYPE_CHECKING, Any

from framegen.comparison.changes.things import Thing, Things, Twin, joined, listed, named
from framegen.comparison.changes.wording import concern
from framegen.comparison.pair import element_fields, named_bits, named_values
from framegen.comparison.pairing import Pairing, paired
from framegen.language.spec import AddressPart, CounterPart, ListField, NumberField
from framegen.model.slots import Items

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping, Sequence

    from framegen.comparison.pair import Pair
    from framegen.language.spec import (
        AnyField,
        Bits,
        Concern,
        Endpoint,
        Erratum,
        Example,
        Frame,
        FramePart,
        HidBoard,
        Lookalike,
        Message,
        NamedAddress,
        NamedValue,
        Note,
        Release,
        Reserved,
        SourceDocument,
        Spec,
        Unknown,
    )
    from framegen.reading.yamltree import KeyPath


class Both:
    """Both editions. Each kind of thing is one property; a name of the old edition has its new."""

    def __init__(self, pair: Pair) -> None:
        self.pair = pair
        self.old: Spec = pair.old.spec
        self.new: Spec = pair.new.spec

    def part_of(self, *path: str) -> Twin[Any]:
        """Return a mapping that every spec has, such as `link`."""
        old: Any = self.old
        new: Any = self.new
        for key in path:
            old, new = getattr(old, key), getattr(new, key)
        return Twin(path, path, old, new)

    # ------------------------------------------------------------------ what all messages share

    @cached_property
    def sources(self) -> Things[SourceDocument]:
        """The documents: one of another name has the same title."""
        old, new = self.old.sources, self.new.sources
        pairing = paired(
            {name: each.title for name, each in old.items()},
            {name: each.title for name, each in new.items()},
            {},
        )
        return named(pairing, old, new, ("sources",), ("sources",))

    @cached_property
    def ends(self) -> Things[Endpoint]:
        """The ends of the line, each with its part."""
        pairing = Pairing(self.pair.ends, frozenset(), (), ())
        path = ("endpoints",)
        return named(pairing, self.old.endpoints, self.new.endpoints, path, path)

    @cached_property
    def boards(self) -> Things[HidBoard]:
        """The boards with USB HID, by vendor and product."""
        path = ("link", "usb_hid")
        return listed(
            self.old.link.usb_hid, self.new.link.usb_hid, path, path, [lambda each: each.ids]
        )

    @cached_property
    def frames(self) -> Things[Frame]:
        """The kinds of frames. The only one that has no name is below `frame`."""
        found = named(self.pair.frames, self.old.envelopes, self.new.envelopes, (), ())
        old, new = bool(self.old.frames), bool(self.new.frames)
        return Things(
            tuple(
                Twin(_frame(old, each.old_path), _frame(new, each.new_path), each.old, each.new)
                for each in found.twins
            ),
            tuple(Thing(_frame(old, each.path), each.what) for each in found.removed),
            tuple(Thing(_frame(new, each.path), each.what) for each in found.added),
            tuple(Twin(("frames",), ("frames",), each.old, each.new) for each in found.moved),
        )

    @cached_property
    def parts(self) -> Things[FramePart]:
        """The parts of the frames, by name, or else by place."""
        return joined(
            named(_parts(each.old, each.new), each.old, each.new, each.old_path, each.new_path)
            for each in self.frames.twins
        )

    @cached_property
    def addresses(self) -> Things[NamedAddress]:
        """The addresses that have a name."""
        return joined(self._addresses(each) for each in self.parts.twins)

    @staticmethod
    def _addresses(part: Twin[FramePart]) -> Things[NamedAddress]:
        if not isinstance(part.old, AddressPart) or not isinstance(part.new, AddressPart):
            return Things()
        old, new = part.old.values, part.new.values
        pairing = paired(
            {name: each.value for name, each in old.items()},
            {name: each.value for name, each in new.items()},
            {name: each.was for name, each in new.items()},
        )
        return named(pairing, old, new, (*part.old_path, "values"), (*part.new_path, "values"))

    # ------------------------------------------------------------------ messages

    @cached_property
    def messages(self) -> Things[Message]:
        """The messages."""
        path = ("messages",)
        return named(self.pair.messages, self.old.messages, self.new.messages, path, path)

    @cached_property
    def outer_fields(self) -> Things[AnyField]:
        """The fields of the messages, without those of elements."""
        return joined(self._fields(each) for each in self.messages.twins)

    def _fields(self, message: Twin[Message]) -> Things[AnyField]:
        return named(
            self._pairing(str(message.old_path[1])),
            message.old.fields,
            message.new.fields,
            (*message.old_path, "fields"),
            (*message.new_path, "fields"),
        )

    @cached_property
    def inner_fields(self) -> Things[NumberField]:
        """The fields of the elements of lists."""
        return joined(self._inner(each) for each in self.outer_fields.twins)

    def _inner(self, twin: Twin[AnyField]) -> Things[NumberField]:
        if not isinstance(twin.old, ListField) or not isinstance(twin.new, ListField):
            return Things()
        pairing = self._elements(str(twin.old_path[1]), str(twin.old_path[3]))
        return named(
            pairing,
            twin.old.fields,
            twin.new.fields,
            (*twin.old_path, "fields"),
            (*twin.new_path, "fields"),
        )

    @cached_property
    def fields(self) -> Things[AnyField]:
        """All fields, of messages and of elements."""
        return joined([self.outer_fields, self.inner_fields])

    @cached_property
    def numbers(self) -> tuple[Twin[NumberField], ...]:
        """All fields of both editions that are numbers, or lists of bare ones, in both."""
        return tuple(
            Twin(each.old_path, each.new_path, each.old, each.new)
            for each in self.fields.twins
            if isinstance(each.old, NumberField) and isinstance(each.new, NumberField)
        )

    @cached_property
    def values(self) -> Things[NamedValue]:
        """The named values of numbers."""
        return joined(
            named(
                named_values(each.old, each.new),
                each.old.values,
                each.new.values,
                (*each.old_path, "values"),
                (*each.new_path, "values"),
            )
            for each in self.numbers
        )

    @cached_property
    def bits(self) -> Things[Bits]:
        """The named bits of numbers."""
        return joined(
            named(
                named_bits(each.old, each.new),
                each.old.bits,
                each.new.bits,
                (*each.old_path, "bits"),
                (*each.new_path, "bits"),
            )
            for each in self.numbers
        )

    # ------------------------------------------------------------------ what else is said

    @cached_property
    def notes(self) -> Things[Note]:
        """The notes: the same are those of the same words, or from the same place."""
        return joined(
            listed(
                each.old.notes,
                each.new.notes,
                (*each.old_path, "notes"),
                (*each.new_path, "notes"),
                [lambda note: note.text, lambda note: str(note.cite)],
            )
            for each in self._with_notes
        )

    @property
    def _with_notes(self) -> Iterator[Twin[Any]]:
        yield self.part_of("protocol")
        yield from chain.from_iterable(
            each.twins for each in (self.ends, self.parts, self.messages, self.fields)
        )

    @cached_property
    def examples(self) -> Things[Example]:
        """The examples of messages: the same are those of the same bytes, or else of one title."""
        return joined(
            listed(
                each.old.examples,
                each.new.examples,
                (*each.old_path, "examples"),
                (*each.new_path, "examples"),
                [lambda example: example.hex, lambda example: example.title],
            )
            for each in self.messages.twins
        )

    @cached_property
    def reserved(self) -> Things[Reserved]:
        """The ids and names that must not be used."""
        path = ("reserved",)
        keys = [lambda each: (str(each.id), each.name, str(each.direction)), lambda each: each.why]
        return listed(self.old.reserved, self.new.reserved, path, path, keys)

    @cached_property
    def errata(self) -> Things[Erratum]:
        """The mistakes in documents: in other words it is the same, of the same message."""
        path = ("errata",)
        keys = [
            lambda each: each.title,
            lambda each: repr(each.concerns),
            lambda each: each.concerns.message,
        ]
        return listed(self.old.errata, self.new.errata, path, path, keys)

    @cached_property
    def unknowns(self) -> Things[Unknown]:
        """The questions that no source answers: in other words it is the same, as for errata."""
        path = ("unknowns",)
        keys = [
            lambda each: each.what,
            lambda each: repr(each.concerns),
            lambda each: each.concerns.message,
        ]
        return listed(self.old.unknowns, self.new.unknowns, path, path, keys)

    @cached_property
    def lookalikes(self) -> Things[Lookalike]:
        """The protocols easily taken for this one."""
        old, new, path = self.old.lookalikes, self.new.lookalikes, ("lookalikes",)
        pairing = paired(
            {name: each.title for name, each in old.items()},
            {name: each.title for name, each in new.items()},
            {},
        )
        return named(pairing, old, new, path, path)

    @cached_property
    def releases(self) -> Things[Release]:
        """The versions of the history."""
        path = ("history",)
        keys = [lambda each: each.version]
        return listed(self.old.history, self.new.history, path, path, keys)

    def everything(self) -> Iterator[Twin[Any]]:
        """Yield all that both editions have, from the whole to its smallest parts."""
        yield self.part_of("protocol")
        yield self.part_of("link")
        yield from chain.from_iterable(each.twins for each in self.kinds())

    def kinds(self) -> Iterator[Things[Any]]:
        """Yield all kinds of things of which there may be several."""
        yield from (self.sources, self.ends, self.boards, self.frames, self.parts, self.addresses)
        yield from (self.messages, self.fields, self.values, self.bits, self.notes, self.examples)
        yield from (self.reserved, self.errata, self.unknowns, self.lookalikes, self.releases)

    # ------------------------------------------------------------------ names

    def message(self, name: str | None) -> str | None:
        """Return what the new edition calls a message."""
        return None if name is None else self.pair.messages.to_new.get(name, name)

    def certain_message(self, name: str) -> str:
        """Return what the new edition calls a message, or its old name where that is a guess."""
        pairing = self.pair.messages
        return name if name in pairing.guessed else pairing.to_new.get(name, name)

    def source(self, name: str) -> str:
        """Return what the new edition calls a source."""
        found = (each.new_path[1] for each in self.sources.twins if each.old_path[1] == name)
        return str(next(found, name))

    def field(self, message: str, name: str | None) -> str | None:
        """Return what the new edition calls a field of a message, `lamps.level` in an element."""
        if name is None:
            return None
        outer, _, inner = name.partition(".")
        said = self._pairing(message).to_new.get(outer, outer)
        if not inner:
            return said
        return f"{said}.{self._elements(message, outer).to_new.get(inner, inner)}"

    def part(self, name: str | None) -> str | None:
        """Return what the new edition calls a part of a frame."""
        if name is None:
            return None
        found = (each.new_path[-1] for each in self.parts.twins if each.old_path[-1] == name)
        return str(next(found, name))

    def parts_called(self, part: Twin[FramePart], names: Sequence[str]) -> str:
        """Return what the new edition calls other parts of the same frame."""
        called = {
            each.old_path[-1]: each.new_path[-1]
            for each in self.parts.twins
            if each.old_path[:-1] == part.old_path[:-1]
        }
        return ", ".join(str(called.get(name, name)) for name in names)

    def values_called(self, message: str, values: Mapping[str, Any]) -> dict[str, Any]:
        """Return the values of a message under the names of the new edition."""
        said: dict[str, Any] = {}
        for name, value in values.items():
            items = value
            if isinstance(value, list) and all(isinstance(each, dict) for each in value):
                names = self._elements(message, name).to_new
                items = [{names.get(one, one): it for one, it in each.items()} for each in value]
            said[str(self.field(message, name))] = items
        return said

    def concern(self, concerned: Concern) -> str:
        """Return what an erratum is about, under the names of the new edition."""
        message = self.message(concerned.message)
        field = self.field(concerned.message, concerned.field)
        return concern(concerned.model_copy(update={"message": message, "field": field}))

    def _pairing(self, message: str) -> Pairing:
        """Return the pairing of the fields of a message of the old edition."""
        there = self.pair.messages.to_new.get(message)
        if there is None:
            return Pairing({}, frozenset(), (), ())
        old, new = self.pair.old.model.messages[message], self.pair.new.model.messages[there]
        return self.pair.fields(old, new)

    def _elements(self, message: str, field: str) -> Pairing:
        """Return the pairing of the fields of a list's elements in the old edition."""
        there = self.pair.messages.to_new.get(message)
        name = self._pairing(message).to_new.get(field)
        if there is not None and name is not None:
            old, new = (
                next((slot for slot in edition.model.messages[one].body if slot.name == called), 0)
                for edition, one, called in (
                    (self.pair.old, message, field),
                    (self.pair.new, there, name),
                )
            )
            if isinstance(old, Items) and isinstance(new, Items):
                return element_fields(old, new)
        return Pairing({}, frozenset(), (), ())


def _frame(has_names: bool, path: KeyPath) -> KeyPath:
    return ("frames", *path) if has_names else ("frame",)


def _parts(old: Frame, new: Frame) -> Pairing:
    """Pair the parts of two frames; there is at most one address, and one counter."""
    was: dict[str, tuple[str, ...]] = {}
    for kind in (AddressPart, CounterPart):
        one, other = (
            next((name for name, part in frame.items() if isinstance(part, kind)), None)
            for frame in (old, new)
        )
        if one is not None and other is not None:
            was[other] = (one,)
    places = [
        {name: (at, part.is_) for at, (name, part) in enumerate(frame.items())}
        for frame in (old, new)
    ]
    return paired(places[0], places[1], was)
