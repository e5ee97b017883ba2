"""Why bytes are no frame: the reason is the first byte that no legal frame can have."""

import pytest
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode, encode
from framegen.model.model import Model, derive
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, compiled_file, data_of
from tests.in_turn import in_turn
from tests.mutations.places import having

SERVO = compiled_file(BUSSERVO).model
HOUSE = compiled_file(DEMO).model
HOST = Direction("host", "controller")
CONTROLLER = Direction("controller", "host")
GATEWAY = Direction("gateway", "station")

# A model, a direction (None for both), bytes, the reason, and the byte at which it shows.
REFUSED: list[tuple[Model, Direction | None, str, str, int]] = [
    # In the order of the bytes: the header, ...
    (SERVO, HOST, "54 55", "bad header", 0),
    (SERVO, HOST, "55 54 02 07", "bad header", 1),
    # ... the length, which is refused alone where no frame of this direction has it, ...
    (SERVO, HOST, "55 55 01", "length mismatch", 2),
    (SERVO, HOST, "55 55 01 63", "length mismatch", 2),
    (SERVO, HOST, "55 55 00 07", "length mismatch", 2),
    # ... the command, ...
    (SERVO, HOST, "55 55 FF 63", "unknown command", 3),
    (SERVO, HOST, "55 55 02 08", "unknown command", 3),
    (SERVO, CONTROLLER, "55 55 02 03", "unknown command", 3),
    # ... the length that this command cannot have, ...
    (SERVO, HOST, "55 55 03 07", "length mismatch", 2),
    (SERVO, HOST, "55 55 05 03 01 E8 03", "length mismatch", 2),
    # ... and the count, however much of the frame is still to come, or comes behind it.
    (SERVO, HOST, "55 55 08 03 02", "count mismatch", 4),
    (SERVO, HOST, "55 55 08 03 02 E8 03 01 20 03 00 00", "count mismatch", 4),
    # What ends too early is too short, and nothing else is wrong with it.
    (SERVO, HOST, "", "too short", 0),
    (SERVO, HOST, "55", "too short", 1),
    (SERVO, HOST, "55 55", "too short", 2),
    (SERVO, HOST, "55 55 08", "too short", 3),
    (SERVO, HOST, "55 55 08 03 01 E8 03 01 20", "too short", 9),
    # Here the id comes first, and the length is one of two bytes.
    (HOUSE, GATEWAY, "C3 5A A5 77", "unknown command", 3),
    (HOUSE, GATEWAY, "C3 5A A5 77 FF FF", "unknown command", 3),
    (HOUSE, GATEWAY, "C3 5A A5 10 FF", "too short", 5),
    (HOUSE, GATEWAY, "C3 5A A5 10 FF FF", "length mismatch", 4),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 04", "length mismatch", 4),
    # A count and a range: whichever stands first.
    (HOUSE, GATEWAY, "C3 5A A5 10 00 06 00 00 02 01 FC 7B", "count mismatch", 8),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 06 00 00 01 01 FC 7B", "out of range", 10),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 06 00 00 01 01 03 85", "out of range", 10),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 06 00 00 01 01 80 00", "out of range", 10),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 09 00 00 02 01 FC 7B 01", "out of range", 10),
    (HOUSE, GATEWAY, "C3 5A A5 10 00 09 00 00 02 01 FC", "too short", 11),
    # Of both directions, the one in which it goes furthest.
    (SERVO, None, "55 55 08 15 06", "count mismatch", 4),
    (SERVO, None, "55 55 09 15 06 01 02", "too short", 7),
    (SERVO, None, "55 55 09 15 02 01 02", "too short", 7),
    (SERVO, None, "55 55 09 63 06", "unknown command", 3),
]


@in_turn("model, way, text, reason, offset", lambda: REFUSED)
def test_the_first_byte_that_no_frame_can_have_is_the_reason(
    model: Model, way: Direction | None, text: str, reason: str, offset: int
) -> None:
    data = bytes.fromhex(text)
    verdict = weigh(model, model.directions if way is None else [way], data)
    assert (verdict.message, verdict.reason, verdict.offset) == (None, reason, offset)
    with pytest.raises(NotAFrame) as refused:
        decode(model, way, data)
    assert (refused.value.reason, refused.value.offset) == (reason, offset)
    assert str(refused.value) == f"{reason} at byte {offset}: {refused.value.expected}"


@in_turn(
    "text, due",
    lambda: [
        ("C3 5A A5 10 00 06 00 00 01 01 FC 7B", "vents[0].angle is -901, outside -900..900"),
        ("54", "a frame begins 55 55"),
        ("55 55 02", "the shortest frame has 4 bytes"),
        ("55 55 01", "the length of a frame is 2..255, not 1"),
        ("55 55 01 07", "ActionGroupStop has a length of 2, not 1"),
        ("55 55 02 63", "no message host -> controller has the command 99"),
        ("55 55 03 07", "ActionGroupStop has a length of 2, not 3"),
        ("55 55 08 03 02", "a length of 8 makes servo_count 1, not 2"),
        ("55 55 08 03", "a length of 8 makes 10 bytes"),
        ("55 55 02 07 00", "a length of 2 makes 4 bytes"),
    ],
)
def test_a_refusal_says_what_was_due(text: str, due: str) -> None:
    model, way = (HOUSE, GATEWAY) if text.startswith("C3") else (SERVO, HOST)
    with pytest.raises(NotAFrame) as refused:
        decode(model, way, bytes.fromhex(text))
    assert refused.value.expected == due


def test_trailing_bytes_are_an_error_for_a_single_frame_only() -> None:
    for text, name, end in (
        ("55 55 02 07 00", "ActionGroupStop", 4),
        ("55 55 08 03 01 E8 03 01 20 03 00", "ServoMove", 10),
    ):
        verdict = weigh(SERVO, [HOST], bytes.fromhex(text))
        assert (verdict.message, verdict.offset) == (SERVO.messages[name], end)
        with pytest.raises(NotAFrame, match=rf"^trailing bytes at byte {end}: "):
            decode(SERVO, HOST, bytes.fromhex(text))


@pytest.mark.parametrize(
    ("largest", "reason"), [(None, "too short"), (64, "too short"), (63, "length mismatch")]
)
def test_a_frame_larger_than_there_is_room_for_is_refused_by_its_length(
    largest: int | None, reason: str
) -> None:
    verdict = weigh(SERVO, [HOST], bytes.fromhex("55 55 3E 03"), largest)
    assert (verdict.reason, verdict.offset) == (reason, 4 if reason == "too short" else 2)


@in_turn(
    "model, way, text, largest, claim",
    lambda: [
        (SERVO, HOST, "55 55 04 63", None, 6),
        (SERVO, HOST, "55 55 3E 63 55 55", 64, 64),
        # A length that no frame has, a message, and one with a wrong length: nothing is unknown.
        (SERVO, HOST, "55 55 3F 63", 64, 0),
        (SERVO, HOST, "55 55 02 07", None, 0),
        (SERVO, HOST, "55 55 04 07", None, 0),
        # The id comes first: as long as the length is cut short, it is no less than of any frame.
        (HOUSE, GATEWAY, "C3 5A A5 77", None, 6),
        (HOUSE, GATEWAY, "C3 5A A5 77 FF", None, 6),
        (HOUSE, GATEWAY, "C3 5A A5 77 00 1B", None, 33),
        (HOUSE, GATEWAY, "C3 5A A5 77 00 1C", None, 0),
        (HOUSE, GATEWAY, "C3 5A A5 77 00 1A", 32, 32),
        (HOUSE, GATEWAY, "C3 5A A5 77 00 1B", 32, 0),
    ],
)
def test_a_frame_of_unknown_id_claims_what_its_length_says(
    model: Model, way: Direction, text: str, largest: int | None, claim: int
) -> None:
    assert weigh(model, [way], bytes.fromhex(text), largest).claim == claim


@given(st.sampled_from([(SERVO, HOST), (SERVO, CONTROLLER), (HOUSE, GATEWAY)]), st.data())
def test_a_verdict_stands_whatever_comes(
    where: tuple[Model, Direction], data: st.DataObject
) -> None:
    model, way = where
    messages = [each.message for each in model.messages.values()]
    examples = [each.hex for message in messages for each in message.examples]
    frame = bytearray(data.draw(st.sampled_from(examples)))
    at = data.draw(st.integers(0, len(frame) - 1))
    frame[at] = data.draw(st.integers(0, 255))
    whole = weigh(model, [way], bytes(frame))
    for size in range(len(frame)):
        begun = weigh(model, [way], bytes(frame[:size]))
        if begun.undecided:
            assert begun.offset == size
        else:
            for name in ("message", "reason", "offset"):
                assert getattr(begun, name) == getattr(whole, name)


def test_a_part_behind_the_fields_is_a_slot_like_any_other() -> None:
    data = having(data_of(BUSSERVO), {"frame.end": {"is": "constant", "bytes": "0D 0A"}})
    model = derive(Spec.model_validate(data))
    move = model.messages["ServoMove"]
    frame = bytes.fromhex("55 55 08 03 01 E8 03 01 20 03 0D 0A")
    values = {"time_ms": 1000, "targets": [{"servo_id": 1, "position": 800}]}
    assert encode(move, values) == frame
    assert decode(model, HOST, frame).values == values
    wrong = weigh(model, [HOST], frame[:-1] + b"\x0b")
    assert (wrong.reason, wrong.offset) == ("bad trailer", 11)
    assert weigh(model, [HOST], frame[:-1]).undecided
    events = ReferenceDecoder(model, [HOST]).decode(b"\x55" + frame + frame[:-1])
    assert [event.kind for event in events] == ["noise", "message", "noise"]
