"""Rule: a refusal is another message that may come instead of the reply."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.language.values import Direction


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        if message.refusal is None:
            continue
        here = ("messages", name, "refusal")
        other = spec.messages.get(message.refusal)
        way = message.direction.reversed
        meant = partial(_meant, spec, way, message.refusal)
        if other is None:
            yield Problem(here, f"there is no message `{message.refusal}`", meant)
        elif other.direction != way:
            what = f"{message.refusal} goes {other.direction}, and an answer to {name} goes {way}"
            also = (("messages", message.refusal, "direction"), "its direction is here")
            yield Problem(here, what, meant, also=also)
        elif message.reply is None:
            what = f"{name} has no reply that {message.refusal} could come instead of"
            hint = (
                "add `reply`, the message that comes if all is well; where nothing comes then, "
                f"write `reports: [{message.refusal}]` instead"
            )
            yield Problem(here, what, hint, on_key=True)
        elif message.refusal == message.reply:
            what = f"{message.reply} is the reply to {name}, and cannot be its refusal as well"
            hint = f"if a field of it tells, add `failure: FIELD` to {message.reply}"
            yield Problem(here, what, f"{hint} and leave out `refusal`", on_key=True)


def _meant(spec: Spec, way: Direction, name: str) -> str:
    return did_you_mean(name, [each for each, it in spec.messages.items() if it.direction == way])


RULE = StructureRule(
    id="refusal",
    title="A refusal is another message that may come instead of the reply",
    why="A client that waits for the reply raises it at once instead of waiting until its time is "
    "over.",
    bad="LampRead: {refusal: LampError}  # without a `reply`",
    good="LampRead: {reply: LampState, refusal: LampError}",
    look=_look,
)
