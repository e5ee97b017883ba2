"""Remark: a frame begins with another by chance, and only its checksum says so."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.checks.rule import ModelRule, Problem
from framegen.language.values import to_hex
from framegen.model.apart import begun, shares_checksums
from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


# So many examples of each message are tried.
_EXAMPLES = 4


def _look(model: Model) -> Iterator[Problem]:
    longer: dict[str, list[MessageLayout]] = {}
    for short, long in begun(model):
        longer.setdefault(short.name, []).append(long)
    for name, others in longer.items():
        yield _problem(model, model.messages[name], others)


def _problem(model: Model, short: MessageLayout, longer: list[MessageLayout]) -> Problem:
    long, *others = sorted(longer, key=lambda each: _one_in(short, each))
    odds = _one_in(short, long)
    of_how_many = f"1 in {odds:,} frames".replace(",", " ") if odds > 1 else "every frame"
    what = f"{of_how_many} of {long.name}, {long.direction}, begins with one of {short.name}"
    if others:
        what += f", and so may those of {pluralize(len(others), 'other message')}"
    if joined := _joined(model, short, longer):
        frame, behind, whole = joined
        what += f"; {to_hex(frame)} becomes {whole.name} where {to_hex(behind)} follows at once"
    return Problem(
        ("messages", short.name),
        what,
        f"a decoder takes the longest, so it holds {short.name} until the next byte, or 50 ms of "
        "silence, rules that out: if a length, an id or an `always` tells them apart, say so",
        on_key=True,
        also=(("messages", long.name), "the longer one is here"),
    )


def _joined(
    model: Model, short: MessageLayout, longer: list[MessageLayout]
) -> tuple[bytes, bytes, MessageLayout] | None:
    """Return a frame that is a longer one with other frames behind it, or with zeros.

    A checksum that is right may well be right again behind another one.
    """
    way = [short.direction]
    sent = [each.hex for message in model.sent(short.direction) for each in _examples(message)]
    zeros = (bytes(long.least - short.least) for long in longer)
    for frame in (each.hex for each in _examples(short)):
        for behind in (*sent, *zeros):
            verdict = weigh(model, way, frame + behind)
            if verdict.message in longer and verdict.offset > len(frame):
                return frame, behind[: verdict.offset - len(frame)], verdict.message
    return None


def _examples(message: MessageLayout) -> Sequence[Example]:
    return message.message.examples[:_EXAMPLES]


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
