"""Rule: every device that can be asked can answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.model import Model
    from framegen.model.slots import Number


def _look(model: Model) -> Iterator[Problem]:
    looked_at: set[tuple[str, str]] = set()
    for exchange in model.exchanges:
        asked, question = exchange.address, exchange.request
        for answer in exchange.answers:
            ours, kinds = answer.frame.address, (question.frame.name, answer.frame.name)
            if asked is None or ours is None or kinds in looked_at:
                continue
            looked_at.add(kinds)
            value = _without_answer(asked, ours)
            if value is not None:
                yield Problem(
                    ("frames", answer.frame.name, ours.name),
                    f"{question.name} may ask the {asked.name} {value}, which can never answer: "
                    f"the {ours.name} of {answer.name} is {_allowed(ours)}",
                    f"allow {value} here, or not in the question; if nobody answers there, name it "
                    f"in the question: `values: {{all: {{value: {value}, silent: true}}}}`",
                    on_key=True,
                    also=(("frames", question.frame.name, asked.name), "the question has it here"),
                )


def _without_answer(asked: Number, ours: Number) -> int | None:
    """Return the lowest address that can be asked and that no answer can have."""
    # What is in front of the lowest one has an answer, needs none, or cannot be asked.
    behind = {each + 1 for each in (ours.high, *ours.named, *asked.silent)}
    found = (
        each
        for each in sorted({asked.low, *asked.named, *behind})
        if asked.holds(each) and each not in asked.silent and not ours.holds(each)
    )
    return next(found, None)


def _allowed(part: Number) -> str:
    bounds = str(part.low) if part.low == part.high else f"{part.low}..{part.high}"
    named = (str(each) for each in sorted(part.named) if not part.low <= each <= part.high)
    return " or ".join([bounds, *named])


RULE = ModelRule(
    id="answered-address",
    title="Every device that can be asked can answer",
    why="A client takes only the device that it asked for the sender of an answer: if no answer "
    "can have that address, it waits in vain.",
    bad="frames: {ask: {unit: {is: address, type: u8}}, "
    "answer: {unit: {is: address, type: u8, range: 0..9}}}",
    good="frames: {ask: {unit: {is: address, type: u8, range: 0..9}}, "
    "answer: {unit: {is: address, type: u8, range: 0..9}}}",
    look=_look,
)
