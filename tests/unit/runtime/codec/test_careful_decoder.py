"""A frame whose last bytes may begin another is doubtful, and no other."""

from __future__ import annotations

from importlib import import_module

import busservo
from busservo import ActionGroupStopped, BatteryVoltage, Direction, Message, Noise, ServoPositions
from busservo._library import CODEC
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import compiled_of, data_in, library, library_files
from tests.in_turn import in_turn
from tests.mutations.places import having
from tests.strategies import bytes_of, joined, messages_in

RECEIVED = Direction.CONTROLLER_TO_HOST
REPORT = busservo.ActionGroupCompleted(8, 1)
MESSAGES = [
    BatteryVoltage(7500),
    BatteryVoltage(0x5555),
    BatteryVoltage(0x5504),
    ServoPositions([(1, 500), (2, 0x5555)]),
    ServoPositions([(85, 85), (85, 0x0155)]),
    busservo.ActionGroupStarted(8, 1),
    ActionGroupStopped(),
    busservo.ActionGroupCompleted(85, 0x5555),
    REPORT,
]


def careful(*pieces: bytes, flushed: bool = False) -> list[Message | Noise]:
    decoder = CODEC.careful_decoder(RECEIVED)
    events: list[Message | Noise] = [event for piece in pieces for event in decoder.feed(piece)]
    while flushed and decoder.pending:
        events += decoder.flush()
    return events


def test_all_holes_in_all_replies_lose_that_reply_alone() -> None:
    """Whatever is lost at the end of a frame: what follows is found, and nothing is invented."""
    for torn in MESSAGES[:4]:
        for follows in MESSAGES[4:]:
            frame = torn.encode()
            for lost in range(1, min(len(frame) - 4, len(follows.encode()) - 2) + 1):
                line = frame[:-lost] + follows.encode()
                assert messages_in(careful(line, flushed=True)) == [follows], (torn, follows, lost)


@in_turn("follows", lambda: [[ActionGroupStopped()], [REPORT], [ActionGroupStopped(), REPORT]])
@in_turn("part", lambda: range(8))
def test_frames_that_fill_a_hole_to_the_byte_are_found(follows: list[Message], part: int) -> None:
    filling = b"".join(each.encode() for each in follows) + REPORT.encode()[:part]
    torn = ServoPositions([(servo, 500) for servo in range(1, 7)]).encode()
    line = torn[: -len(filling)] + filling + REPORT.encode()[part:]
    assert messages_in(careful(line, flushed=True)) == [*follows, REPORT]


def test_a_doubtful_message_is_reported_as_soon_as_possible() -> None:
    decoder = CODEC.careful_decoder(RECEIVED)
    doubtful = BatteryVoltage(0x5555)
    assert decoder.feed(doubtful.encode()) == []
    assert decoder.pending == 6
    assert decoder.feed(b"\x55") == []  # 55 55 55 may begin a frame of length 85
    assert decoder.feed(b"\x55") == []  # though none of command 85: a byte later it still may
    assert decoder.feed(b"\x02") == [doubtful]  # but none of command 2
    assert decoder.feed(b"\x07") == [ActionGroupStopped()]


def test_a_message_that_stays_doubtful_is_noise() -> None:
    """A second hole: whether the reply was whole cannot be known any more."""
    decoder = CODEC.careful_decoder(RECEIVED)
    assert decoder.feed(bytes.fromhex("55 55 04 0F 55 55 05 08")) == []
    events = decoder.flush()
    assert messages_in(events) == []
    assert bytes_of(events) == bytes.fromhex("55 55 04 0F 55 55 05 08")
    assert decoder.pending == 0


pieces = st.lists(
    st.one_of(
        st.sampled_from(MESSAGES).map(Message.encode),
        st.tuples(st.sampled_from(MESSAGES), st.integers(0, 8)).map(
            lambda drawn: drawn[0].encode()[: drawn[1]]
        ),
        st.binary(max_size=4),
        st.sampled_from([b"\x55", b"\x55\x55", b"\x55\x55\x04\x0f"]),
    ),
    max_size=8,
)


@given(pieces)
def test_no_byte_is_lost(line: list[bytes]) -> None:
    assert bytes_of(careful(*line, flushed=True)) == b"".join(line)


@given(pieces, st.data())
def test_how_the_line_is_cut_makes_no_difference(line: list[bytes], data: st.DataObject) -> None:
    whole = b"".join(line)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(whole)), max_size=6)))
    cut = [whole[a:b] for a, b in zip([0, *cuts], [*cuts, len(whole)], strict=True)]
    assert joined(careful(*cut, flushed=True)) == joined(careful(whole, flushed=True))


# Of its two kinds of frames, one is a single byte, and the other has a checksum.
ACKNOWLEDGED = """
framegen: 2
protocol: {name: meter, title: Meter, version: 1.0.0, authority: m, summary: A meter.}
sources: {m: {title: Manual, kind: document}}
endpoints: {host: Asks., meter: Answers.}
link: {baud: 9600}
byte_order: big
frames:
  normal:
    start: {is: constant, bytes: AA}
    code: {is: id, type: u8}
    body: {is: body}
    check: {is: checksum, type: u8, method: sum, covers: [code, body]}
  acknowledgement:
    byte: {is: constant, bytes: "06"}
    body: {is: body}
messages:
  Done: {frame: acknowledgement, direction: meter -> host, summary: It is done., cite: m, length: 1,
    examples: [{title: Done, hex: "06", values: {}, cite: m}]}
  Value: {frame: normal, id: 2, direction: meter -> host, summary: A value., cite: m, length: 4,
    fields: {value: {type: u8, about: The value.}},
    examples: [{title: Four, hex: AA 02 04 06, values: {value: 4}, cite: m}]}
"""


# What a checksum proves, and what ends as a single byte begins.
@in_turn(
    "end",
    lambda: [
        {"is": "checksum", "type": "u8", "method": "sum", "covers": ["code", "body"]},
        {"is": "constant", "bytes": "06"},
    ],
)
def test_an_acknowledgement_makes_no_other_frame_doubtful(end: dict[str, object]) -> None:
    compiled = compiled_of(having(data_in(ACKNOWLEDGED), {"frames.normal.check": end}))
    assert compiled.findings == []
    with library(library_files(compiled)) as made:
        codec = import_module(f"{made.__name__}._library").CODEC
        for value in range(256):
            decoder = codec.careful_decoder(made.Direction.METER_TO_HOST)
            message, done = made.messages.Value(value), made.messages.Done()
            assert decoder.feed(message.encode()) == [message]
            assert decoder.feed(done.encode() + message.encode()) == [done, message]
