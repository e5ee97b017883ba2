"""Guesses by recordings that are cut, noisy, spoilt or short: what is decided is right still."""

from collections.abc import Callable
from itertools import product
from random import Random

import pytest
from framegen.compile import compile_spec
from framegen.guess.capture import Capture
from framegen.guess.guess import guess
from framegen.guess.spec_text import spec_text
from framegen.reading.source import Source

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.unit.guess.test_guess import IN_PART
from tests.unit.guess.traffic import traffic
from tests.unit.guess.truth import wrong

SPECS = {**FILES, "busservo": BUSSERVO}


def whole(frames: list[bytes], _chance: Random) -> bytes:
    return b"".join(frames)


def cut(frames: list[bytes], chance: Random) -> bytes:
    return b"".join(frames)[chance.randint(1, 9) : -chance.randint(1, 9)]


def noisy(frames: list[bytes], chance: Random) -> bytes:
    noise = (chance.randbytes(chance.choice([0] * 9 + [6])) for _ in frames)
    return b"".join(map(bytes.__add__, frames, noise))


def spoilt(frames: list[bytes], chance: Random) -> bytes:
    def spoil(frame: bytes) -> bytes:
        changed = bytearray(frame)
        changed[chance.randrange(len(frame))] ^= 1 << chance.randrange(8)
        return bytes(changed)

    return b"".join(spoil(frame) if chance.random() < 0.05 else frame for frame in frames)


def few(frames: list[bytes], _chance: Random) -> bytes:
    return b"".join(frames[:30])


@pytest.mark.parametrize("protocol", SPECS)
@in_turn("damage, seed", lambda: product([whole, cut, noisy, spoilt, few], range(3)))
def test_what_is_decided_is_right(
    protocol: str, damage: Callable[[list[bytes], Random], bytes], seed: int
) -> None:
    model, chance = compiled_file(SPECS[protocol]).model, Random(seed)  # noqa: S311
    data = damage(traffic(model, chance), chance)
    found = guess(Capture(data, (data,)))
    if found is None and protocol in IN_PART:
        return  # nothing is said, and so nothing wrong
    assert found is not None
    assert wrong(found, model) == []
    assert compile_spec(Source("guess.yaml", spec_text(found, "line.bin"))).findings == []
