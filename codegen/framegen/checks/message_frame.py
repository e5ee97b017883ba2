"""Rule: a message has one of the frames that there are."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem, StructureRule
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Message, Spec


def _look(spec: Spec) -> Iterator[Problem]:
    for name, message in spec.messages.items():
        here = ("messages", name, "frame")
        if message.frame is None:
            if len(spec.frames) > 1:
                what = f"{name} does not say which of `frames` it has"
                yield Problem(("messages", name), what, f"add {_choice(spec, message)}", True)
        elif not spec.frames:
            what = "there is one kind of frame, and every message has it"
            yield Problem(here, what, "leave out `frame`, or describe several under `frames`")
        elif message.frame not in spec.frames:
            hint = did_you_mean(message.frame, spec.frames)
            yield Problem(here, f"there is no frame `{message.frame}`", hint)


def _choice(spec: Spec, message: Message) -> str:
    """Return what to add: the frame of the other messages of its direction, or the choices."""
    others = {each.frame for each in spec.messages.values() if each.direction == message.direction}
    known = [name for name in spec.frames if name in others] or list(spec.frames)
    return " or ".join(f"`frame: {name}`" for name in known)


RULE = StructureRule(
    id="message-frame",
    title="A message has one of the frames that there are",
    why="Where there are several kinds of frame, only the message can say which one is around its "
    "fields.",
    bad="frames: {command: ..., answer: ...}  # and a message without `frame`",
    good="LampSet: {frame: command, ...}",
    look=_look,
)
