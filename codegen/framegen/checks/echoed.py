"""Rule: what a reply repeats is a field of both messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.model.exchanges import paths_of
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        path: KeyPath = ("messages", name, "echoed")
        if message.echoed and message.reply is None:
            what = f"{name} has no reply that could repeat anything"
            yield Problem(path, what, "declare its `reply`, or leave out `echoed`", on_key=True)
            continue
        reply = None if message.reply is None else spec.messages.get(message.reply)
        if reply is not None:
            for asked, told in message.echoed.items():
                yield from _pair((*path, asked), (name, message, asked), (reply, told))


def _pair(
    path: KeyPath, request: tuple[str, Message, str], answer: tuple[Message, str]
) -> Iterator[Problem]:
    name, message, asked = request
    reply, told = answer
    ours, theirs = paths_of(message), paths_of(reply)
    if asked not in ours:
        what = f"{name} is not given `{asked}`"
        yield Problem(path, what, did_you_mean(asked, list(ours)), on_key=True)
    elif told not in theirs:
        what = f"{message.reply} does not tell `{told}`"
        yield Problem(path, what, did_you_mean(told, list(theirs)))
    elif ours[asked] != theirs[told]:
        listed, single = (asked, told) if ours[asked] else (told, asked)
        what = f"`{listed}` is in a list and `{single}` is not"
        yield Problem(path, what, "a list can repeat a list, and a number a number")


RULE = StructureRule(
    id="echoed",
    title="What a reply repeats is a field of both messages",
    why="A client tells the reply to its request from others by the fields that it repeats: by one "
    "that is not there, no reply is ever the right one.",
    bad="LampRead: {reply: LampState, echoed: {lamp: lamp_id}}",
    good="LampRead: {reply: LampState, echoed: {lamp_id: lamp_id}}",
    look=_look,
)
