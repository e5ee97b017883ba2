"""Remark: a frame begins with another by chance, and only its checksum says so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import ModelRule, Problem
from framegen.model.apart import begun, shares_checksums
from framegen.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    longer: dict[str, list[MessageLayout]] = {}
    for short, long in begun(model):
        longer.setdefault(short.name, []).append(long)
    for name, others in longer.items():
        yield _problem(model.messages[name], others)


def _problem(short: MessageLayout, longer: list[MessageLayout]) -> Problem:
    long, *others = sorted(longer, key=lambda each: _one_in(short, each))
    odds = _one_in(short, long)
    of_how_many = f"1 in {odds:,} frames".replace(",", " ") if odds > 1 else "every frame"
    what = f"{of_how_many} of {long.name}, {long.direction}, begins with one of {short.name}"
    if others:
        what += f", and so may those of {pluralize(len(others), 'other message')}"
    return Problem(
        ("messages", short.name),
        what,
        f"a decoder takes the longest, so it holds {short.name} until the next byte, or 50 ms of "
        "silence, rules that out: if a length, an id or an `always` tells them apart, say so",
        on_key=True,
        also=(("messages", long.name), "the longer one is here"),
    )


def _one_in(short: MessageLayout, long: MessageLayout) -> int:
    """Return of how many frames of the longer message one begins with the shorter."""
    if shares_checksums(short, long):
        return 1
    return 1 << 8 * sum(part.size for part in short.frame.checksums)


RULE = ModelRule(
    id="chance-prefix",
    title="No frame begins with another by chance",
    why="Where nothing but a checksum tells a frame from the beginning of a longer one, it is held "
    "until it is known that no longer one comes, which takes time; and a longer one that pauses "
    "there is taken for the shorter. Some protocols are like that, so this is a remark.",
    bad="{Fault: {frame: answer, length: 3}, Pressure: {frame: answer, length: 4}}  # and no id",
    good="{Fault: {frame: answer, id: 1, length: 4}, Pressure: {frame: answer, id: 2, length: 5}}",
    look=_look,
)
