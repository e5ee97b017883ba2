"""Further random questions, repeatable by seed, beyond those that are published."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.conformance.dice import Dice, random_values
from framegen.conformance.language import Decode, Encode, Stream
from framegen.model.codec import encode
from framegen.model.slots import Number

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.conformance.language import Question
    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model

# As many pieces are on a line at the most.
_PIECES = 7
# What many a buffer holds.
_SMALL = 64


def further(model: Model, seed: int) -> Iterator[tuple[str, Question]]:
    """Yield questions without end, each with a title; the same for the same seed everywhere."""
    dice = Dice(seed)
    number = 0
    while True:
        number += 1
        kind = dice.pick(("decode", "encode", "stream", "stream"))
        way = dice.pick(model.directions)
        if kind == "encode":
            message = dice.pick(list(model.sent(way)))
            question: Question = Encode(
                message, random_values(dice, message, wild=dice.below(3) == 0)
            )
        elif kind == "decode":
            question = Decode(way, _piece(model, dice, way))
        else:
            question = _stream(model, dice, way)
        yield f"seed {seed}, question {number}", question


def _stream(model: Model, dice: Dice, way: Direction) -> Stream:
    largest = model.largest([way])
    line = b"".join(_piece(model, dice, way) for _ in range(1 + dice.below(_PIECES)))
    parts: list[bytes | None] = []
    while line:
        size = 1 + dice.below(dice.pick((1, 3, 16, len(line))))
        parts.append(line[:size])
        line = line[size:]
        if dice.below(8) == 0:
            parts.append(None)
    least = min(each.frame.least for each in model.candidates([way]))
    small = max(least, min(_SMALL, largest))
    most = dice.pick((largest, largest, small, least + dice.below(_SMALL)))
    # What is certain is reported without waiting for quiet.
    last = () if dice.below(6) == 0 else (None,)
    return Stream(way, most, (*parts, *last))


def _piece(model: Model, dice: Dice, way: Direction) -> bytes:
    """Make a frame, one with something wrong, or noise that resembles the beginning of one."""
    message = dice.pick(list(model.sent(way)))
    envelope = message.frame
    frame = encode(message, random_values(dice, message))
    at = dice.below(len(frame))
    # In front of the fields is where most goes wrong.
    early = dice.below(envelope.body_at)
    step = dice.pick((1, -1, 3))
    begun = b"".join(_part(dice, slot) for slot in envelope.head)
    changed = frame[:at] + dice.bytes(1) + frame[at + 1 :]
    wrong = [changed, changed]
    if envelope.proven:
        unknown = _of_other_ids(dice, envelope, frame)
        wrong += [unknown, _stepped(unknown, early, step)]
    pieces = (
        frame,
        frame,
        frame[:at],
        frame[:at] + frame[at + 1 :],
        frame[:at] + dice.bytes(1) + frame[at:],
        changed,
        _stepped(frame, early, step),
        envelope.header[: 1 + at] + frame,
        begun + dice.bytes(dice.below(6)),
        dice.bytes(1 + dice.below(3)),
        # With a right checksum, a change is only found by what is looked at besides.
        *map(message.sealed, wrong if envelope.proven else ()),
    )
    piece: bytes = dice.pick(pieces)
    return piece


def _stepped(frame: bytes, at: int, step: int) -> bytes:
    """Return a frame with one byte that is a little higher or lower."""
    return frame[:at] + bytes([(frame[at] + step) & 0xFF]) + frame[at + 1 :]


def _of_other_ids(dice: Dice, envelope: Envelope, frame: bytes) -> bytes:
    """Return a frame with any ids."""
    for part in envelope.sent_ids:
        frame = frame[: part.at] + dice.bytes(part.size) + frame[part.at + part.size :]
    return frame


def _part(dice: Dice, slot: Any) -> bytes:
    if not isinstance(slot, Number):
        return bytes(slot.data)
    return slot.write(slot.low + dice.below(min(16, slot.high - slot.low + 1)))
