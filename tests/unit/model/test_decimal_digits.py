"""Decimal digits, two in a byte, are packed numbers: what documents call BCD."""

import pytest
from framegen.language.spec import Spec
from framegen.model.codec import decode, encode
from framegen.model.model import Model, derive
from framegen.model.verdict import weigh
from framewire.explain.refusals import OUT_OF_RANGE

from tests.factories import small_spec


def clock(count: int) -> Model:
    """Return a model whose one message is a time in digits."""
    digits = {"type": "u4", "count": count, "range": "0..9", "byte_order": "big", "about": "It."}
    message = {"id": 7, "direction": "host -> device", "summary": "Set the time.", "cite": "manual"}
    message |= {"length": count // 2, "fields": {"time": digits}}
    frame = {
        "kind": {"is": "id", "type": "u8"},
        "size": {"is": "length", "type": "u8", "counts": ["body"]},
        "body": {"is": "body"},
    }
    return derive(Spec.model_validate(small_spec("clock", frame, {"TimeSet": message})))


@pytest.mark.parametrize(
    ("digits", "body"), [([1, 2, 3, 4], "12 34"), ([0, 0, 0, 9], "00 09"), ([9, 9, 9, 9], "99 99")]
)
def test_digits_are_written_and_read_in_the_order_in_which_they_are_said(
    digits: list[int], body: str
) -> None:
    model = clock(4)
    [message] = model.messages.values()
    frame = encode(message, {"time": digits})
    assert frame.endswith(bytes.fromhex(body))
    assert decode(model, message.direction, frame).values == {"time": digits}


@pytest.mark.parametrize("byte", [0x1A, 0xA1, 0xFF])
def test_what_is_no_digit_is_refused(byte: int) -> None:
    model = clock(2)
    [message] = model.messages.values()
    frame = encode(message, {"time": [1, 2]})
    wrong = frame[:-1] + bytes([byte])
    assert weigh(model, [message.direction], wrong).reason == OUT_OF_RANGE
