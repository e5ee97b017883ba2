"""Rule: every id fits the part of the frame that carries it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import IdPart

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.notation import Ids
    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for frame_name, path, ids in _given(spec):
        frame = spec.envelopes.get(frame_name, {})
        parts = {name: part for name, part in frame.items() if isinstance(part, IdPart)}
        for step, part_name, code in ids_by_part(ids, parts):
            part = parts.get(part_name)
            type_ = None if part is None else NUMBER_TYPES.get(part.type)
            if type_ is not None and code > type_.high:
                yield Problem(
                    (*path, *step),
                    f"{code} does not fit `{part_name}`, a {type_.name}: it ends at {type_.high}",
                )


def ids_by_part(ids: Ids, parts: Iterable[str]) -> Iterator[tuple[KeyPath, str, int]]:
    """Yield each id with the rest of its path and the part that holds it."""
    if ids.one is not None:
        for name in parts:
            yield (), name, ids.one
    for name, number in ids.by_part:
        yield (name,), name, number


def _given(spec: Spec) -> Iterator[tuple[str, KeyPath, Ids]]:
    for name, message in spec.messages.items():
        if message.id is not None:
            yield spec.frame_of(message), ("messages", name, "id"), message.id
    for index, reserved in enumerate(spec.reserved):
        if reserved.id is not None:
            yield next(iter(spec.envelopes)), ("reserved", index, "id"), reserved.id


RULE = StructureRule(
    id="id-range",
    title="Every id fits the part of the frame that carries it",
    why="An id that is too large would be cut, and the frame taken for another message.",
    bad="id: 300  # where `command` is a u8",
    good="id: 30",
    look=_look,
)
