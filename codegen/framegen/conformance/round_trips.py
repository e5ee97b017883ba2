"""Round trips: frames of random values, which must read as the messages that they were made of."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.conformance.dice import Dice, random_values
from framegen.conformance.language import Decode, Encode, Stream
from framegen.model.codec import encode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.conformance.language import Question
    from framegen.model.model import Model

# Any: the questions are to be the same in every run.
_SEED = 1
# So many frames of each message, or of each direction if it has many messages.
_EACH, _MOST = 3, 60
# Larger ones show nothing else.
_LARGEST = 0x1000


def round_trips(model: Model) -> Iterator[tuple[str, Question]]:
    """Yield questions on random values of each message, the same in every run, with titles.

    Each is encoded, decoded, and read from a line in pieces; all of a direction follow each other.
    """
    for way in model.directions:
        dice, frames = Dice(_SEED), list[bytes]()
        sent = model.sent(way)
        for message in sent:
            for number in range(1, 1 + max(1, min(_EACH, _MOST // len(sent)))):
                title = f"{message.name}: random values, {number}"
                values = random_values(dice, message)
                frame = encode(message, values)
                if len(frame) > _LARGEST:
                    continue
                yield title, Encode(message, values)
                yield title, Decode(way, frame)
                at = 1 + dice.below(len(frame))
                parts = (frame[:at], frame[at:], None)
                yield f"{title}, in two pieces", Stream(way, model.largest([way]), parts)
                frames.append(frame)
        line = Stream(way, model.largest([way]), (*frames, None))
        yield f"{way}: frames of random values behind each other", line
