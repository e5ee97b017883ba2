"""What can have another name in each edition, for rules about former names."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.checks.frames import envelopes
from framegen.language.spec import AddressPart, ListField

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def families(spec: Spec) -> Iterator[tuple[KeyPath, Mapping[str, Any]]]:
    """Yield what has names beside each other, by name, with their common path.

    Not all of them can say what they were called: of the parts of a frame, only some.
    """
    yield ("messages",), spec.messages
    for path, frame in envelopes(spec):
        yield path, frame
        for name, part in frame.items():
            if isinstance(part, AddressPart):
                yield (*path, name, "values"), part.values
    for name, message in spec.messages.items():
        here = ("messages", name, "fields")
        yield here, message.fields
        for key, field in message.fields.items():
            if isinstance(field, ListField):
                yield (*here, key, "fields"), field.fields
                for inner_name, inner in field.fields.items():
                    yield from _of_number((*here, key, "fields", inner_name), inner)
            else:
                yield from _of_number((*here, key), field)


def former_names(path: KeyPath, thing: object) -> Iterator[tuple[KeyPath, str]]:
    """Yield each name that something at `path` had, with the place where that is said."""
    for index, name in enumerate(getattr(thing, "was", ())):
        # One name alone is no list: its place is then that of the key.
        yield (*path, "was", index), name


def _of_number(path: KeyPath, field: NumberField) -> Iterator[tuple[KeyPath, Mapping[str, Any]]]:
    yield (*path, "values"), field.values
    yield (*path, "bits"), field.bits


def classes(spec: Spec) -> Iterator[tuple[KeyPath, str, bool]]:
    """Yield each message and each class of elements: its place, its name, and if that is a key."""
    for name in spec.messages:
        yield ("messages", name), name, True
    for name, message in spec.messages.items():
        for field_name, field in message.fields.items():
            if isinstance(field, ListField):
                path = ("messages", name, "fields", field_name, "element")
                yield path, field.element, False
