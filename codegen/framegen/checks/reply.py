"""Rule: replies, refusals and reports are messages of the other direction."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Spec
    from framegen.language.values import Direction
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    sent: dict[Direction, list[str]] = {}
    for name, message in spec.messages.items():
        sent.setdefault(message.direction, []).append(name)
    for name, message in spec.messages.items():
        way = message.direction.reversed
        for path, answer in _answers(("messages", name), message):
            other = spec.messages.get(answer)
            if other is not None and other.direction == way:
                continue
            hint = partial(did_you_mean, answer, sent.get(way, []))
            if other is None:
                yield Problem(path, f"there is no message `{answer}`", hint)
            else:
                what = f"{answer} goes {other.direction}, and an answer to {name} goes {way}"
                also = (("messages", answer, "direction"), f"the direction of {answer}")
                yield Problem(path, what, hint, also=also)


def _answers(path: KeyPath, message: Message) -> Iterator[tuple[KeyPath, str]]:
    if message.reply is not None:
        yield (*path, "reply"), message.reply
    if message.refusal is not None:
        yield (*path, "refusal"), message.refusal
    for index, report in enumerate(message.reports):
        yield (*path, "reports", index), report


RULE = StructureRule(
    id="reply",
    title="Replies, refusals and reports are messages of the other direction",
    why="A client waits for them by their names: one that cannot arrive is waited for in vain.",
    bad="LampRead: {direction: host -> lamp, reply: LampRead}",
    good="LampRead: {direction: host -> lamp, reply: LampState}",
    look=_look,
)
