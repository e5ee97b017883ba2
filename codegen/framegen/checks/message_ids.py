"""Rule: a message gives one id for each id part of its frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.frames import frame_of
from framegen.checks.rule import Problem, StructureRule
from framegen.language.spec import IdPart
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.notation import Ids
    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        frame = frame_of(spec, message)
        if frame is None:
            continue
        parts = [part for part, each in frame.items() if isinstance(each, IdPart)]
        if message.id is not None:
            yield from _given(("messages", name, "id"), name, message.id, parts)
        elif parts:
            what = f"{name} has no id, and its frame has {_listed(parts)}"
            yield Problem(("messages", name), what, f"add `id: {_example(parts)}`", on_key=True)


def _given(path: KeyPath, name: str, ids: Ids, parts: list[str]) -> Iterator[Problem]:
    if not parts:
        what = f"{name} has an id, and its frame has no part for it"
        hint = (
            "say which part of the frame holds it, such as `command: {is: id, type: u8}`, "
            "or leave it out"
        )
        yield Problem(path, what, hint, on_key=True)
        return
    if ids.one is not None:
        if len(parts) > 1:
            what = f"{name} has one id, and its frame has {_listed(parts)}"
            yield Problem(path, what, f"write `id: {_example(parts, ids.one)}`")
        return
    given = dict(ids.by_part)
    for part in given:
        if part not in parts:
            what = f"the frame of {name} has no id part `{part}`"
            yield Problem((*path, part), what, did_you_mean(part, parts), on_key=True)
    missing = [part for part in parts if part not in given]
    if missing and given.keys() <= set(parts):
        known = ", ".join(f"{part}: {given.get(part, 0)}" for part in parts)
        what = f"{name} gives no id for {_listed(missing)}"
        yield Problem(path, what, f"write `id: {{{known}}}`, with its number")


def _listed(parts: list[str]) -> str:
    return " and ".join(f"`{part}`" for part in parts)


def _example(parts: list[str], first: int = 1) -> str:
    if len(parts) == 1:
        return "1"
    numbers = [first, *[0] * (len(parts) - 1)]
    known = zip(parts, numbers, strict=True)
    return "{" + ", ".join(f"{part}: {number}" for part, number in known) + "}"


RULE = StructureRule(
    id="message-ids",
    title="A message gives one id for each id part of its frame",
    why="The ids together say which message a frame is; one that is missing could be anything.",
    bad="id: 5  # where the frame has the id parts `class` and `message`",
    good="id: {class: 5, message: 1}",
    look=_look,
)
