"""Rule: what a reply repeats is a field of both messages."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.field_values import values_at
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
            for requested, reported in message.echoed.items():
                yield from _pair((*path, requested), (name, message, requested), (reply, reported))


def _pair(
    path: KeyPath, request: tuple[str, Message, str], answer: tuple[Message, str]
) -> Iterator[Problem]:
    name, message, requested = request
    reply, reported = answer
    ours, theirs = paths_of(message), paths_of(reply)
    if requested not in ours:
        what = f"{name} has no argument `{requested}`"
        yield Problem(path, what, did_you_mean(requested, list(ours)), on_key=True)
    elif reported not in theirs:
        what = f"{message.reply} has no field `{reported}`"
        yield Problem(path, what, did_you_mean(reported, list(theirs)))
    elif ours[requested] != theirs[reported]:
        listed, single = (requested, reported) if ours[requested] else (reported, requested)
        what = f"`{listed}` is in a list and `{single}` is not"
        yield Problem(path, what, "a list can repeat a list, and a number a number")
    else:
        yield from _room(path, (message, requested), (reply, reported))


def _room(
    path: KeyPath, request: tuple[Message, str], answer: tuple[Message, str]
) -> Iterator[Problem]:
    """Find values that can be requested but not reported: such a request never gets a reply."""
    requested, reported = values_at(*request), values_at(*answer)
    if requested is None or reported is None:
        return
    if not reported.holds(requested):
        what = f"`{request[1]}` may be {requested}, and `{answer[1]}` repeats {reported} at most"
        yield Problem(path, what, "give both the same type and range", on_key=True)


RULE = StructureRule(
    id="echoed",
    title="What a reply repeats is a field of both messages",
    why="A client matches a reply to its request by the fields that it repeats: where one does "
    "not exist, no reply ever matches.",
    bad="LampRead: {reply: LampState, echoed: {lamp: lamp_id}}",
    good="LampRead: {reply: LampState, echoed: {lamp_id: lamp_id}}",
    look=_look,
)
