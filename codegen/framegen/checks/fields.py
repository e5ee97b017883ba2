"""The numbers of a spec with their paths, for rules about single numbers."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.spec import ListField

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, NumberField, Spec
    from framegen.reading.yamltree import KeyPath


def numbers(spec: Spec) -> Iterator[tuple[KeyPath, NumberField]]:
    """Yield every number of every message, those inside elements included."""
    for name, message in spec.messages.items():
        yield from numbers_of(("messages", name), message)


def numbers_of(path: KeyPath, message: Message) -> Iterator[tuple[KeyPath, NumberField]]:
    """Yield every number of the message at `path`."""
    for name, field in message.fields.items():
        here = (*path, "fields", name)
        if not isinstance(field, ListField):
            yield here, field
            continue
        for inner_name, inner in field.fields.items():
            yield (*here, "fields", inner_name), inner


def owned_numbers(spec: Spec) -> Iterator[tuple[KeyPath, dict[str, NumberField]]]:
    """Yield the numbers of each message and of each element, by name, with their common path."""
    for name, message in spec.messages.items():
        path: KeyPath = ("messages", name, "fields")
        yield (
            path,
            {key: each for key, each in message.fields.items() if not isinstance(each, ListField)},
        )
        for key, field in message.fields.items():
            if isinstance(field, ListField):
                yield (*path, key, "fields"), field.fields
