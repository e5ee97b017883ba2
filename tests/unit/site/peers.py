"""Noisy lines, and the events of reference and vectors, for comparisons with a page."""

import random
from collections.abc import Iterable
from itertools import groupby
from typing import Any

from framegen.language.values import Direction
from framegen.model.codec import encode
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from hypothesis import settings

# What a line said: the kind of the event, its bytes in hex, and the message or the reason.
Event = list[Any]


def reference_events(model: Model, data: bytes, way: Direction | None) -> list[Event]:
    """Return the reference's events for `data` with silence after it; both ways without `way`."""
    line = ReferenceDecoder(model, model.directions if way is None else [way])
    events = line.decode(data)
    return [[e.kind, e.data.hex(), e.message.name if e.message else e.reason] for e in events]


def joined(events: Iterable[Event]) -> list[Event]:
    """Return the events, with adjacent noise of one reason joined."""
    found: list[Event] = []
    for (kind, said), same in groupby(events, lambda event: (event[0], event[2])):
        pieces = [event[1] for event in same]
        reported = ["".join(pieces)] if kind == "noise" else pieces
        found += [[kind, piece, said] for piece in reported]
    return found


def noisy_lines(model: Model, seed: int, number: int) -> list[bytes]:
    """Return lines with cut and damaged frames, with noise between them that looks like frames.

    `number` is how many there are where Hypothesis tries a hundred examples.
    """
    chance = random.Random(seed)  # noqa: S311 - the same noise in every run
    messages = model.messages.values()
    examples = [(message, each) for message in messages for each in message.message.examples]
    frames = [encode(message, each.values) for message, each in examples]
    headers = [frame.header for frame in model.envelopes.values()]
    ids = [number for message in messages for number in message.ids if number < 0x100]
    near = [*b"".join(headers), *ids, 0, 1, 2, 3, 5, 99, 255]
    many = number * settings().max_examples // 100
    return [_line(chance, frames, chance.choice(headers), near) for _ in range(many)]


def _line(chance: random.Random, frames: list[bytes], header: bytes, near: list[int]) -> bytes:
    line = b""
    for _ in range(chance.randrange(1, 7)):
        frame = chance.choice(frames)
        match chance.randrange(10):
            case 0:
                line += chance.randbytes(chance.randrange(6))
            case 1:
                line += frame[: chance.randrange(len(frame))]
            case 2:
                at = chance.randrange(len(frame))
                line += frame[:at] + bytes([chance.randrange(256)]) + frame[at + 1 :]
            case 3 if header:
                line += header[: chance.randrange(1, len(header) + 1)] * chance.randrange(1, 4)
            case 3 | 4 | 5 | 6:
                line += header + bytes(chance.choices(near, k=chance.randrange(12)))
            case _:
                line += frame
    return line
