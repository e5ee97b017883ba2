"""Rule: a refusal is another message that may come instead of the reply."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        here = ("messages", name, "refusal")
        if message.refusal is None:
            continue
        if message.reply is None:
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


RULE = StructureRule(
    id="refusal",
    title="A refusal is another message that may come instead of the reply",
    why="A client that waits for the reply raises it at once instead of waiting until its time is "
    "over.",
    bad="LampRead: {refusal: LampError}  # without a `reply`",
    good="LampRead: {reply: LampState, refusal: LampError}",
    look=_look,
)
