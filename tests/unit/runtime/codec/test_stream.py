"""StreamDecoder: its six invariants, each a property, and its other promises."""

import gc
import re
import sys
from collections.abc import Callable
from copy import copy
from types import FrameType
from typing import Any

import pytest
from busservo import (
    ActionGroupRun,
    ActionGroupStop,
    ActionGroupStopped,
    BatteryVoltage,
    Direction,
    Message,
    Noise,
    Reason,
    ServoMove,
    StreamDecoder,
    UnknownFrame,
    decode,
    strategies,
)
from hypothesis import given
from hypothesis import strategies as st

from tests import oracle
from tests.cases import CONTROLLER, EITHER, HOST, Case, each_case
from tests.in_turn import in_turn
from tests.strategies import (
    DIRECTIONS,
    HEADS,
    bytes_of,
    directions,
    joined,
    lines,
    messages_in,
    noise,
    oracles,
    pieces,
    read,
    scanned,
    single_bytes,
    unknown_frames,
    unknown_in,
)

LARGEST = 257
STOP = bytes.fromhex("55 55 02 07")
HEADER, SHORT, UNKNOWN = Reason.BAD_HEADER, Reason.TOO_SHORT, Reason.UNKNOWN_COMMAND
LENGTH, COUNT = Reason.LENGTH_MISMATCH, Reason.COUNT_MISMATCH

each_direction = pytest.mark.parametrize("direction", DIRECTIONS, ids=str)


def unknown(hex_data: str) -> UnknownFrame:
    return UnknownFrame(bytes.fromhex(hex_data), UNKNOWN)


# --- The table of truth --------------------------------------------------------------------------
@each_case
def test_a_frame_is_read_with_leading_noise(case: Case) -> None:
    for digits in ("00", "55", "13 55 AA", "55 55 01", "55 55 63", "00 55 55"):
        leading = bytes.fromhex(digits)
        for chunks in ([leading, case.frame], [leading + case.frame]):
            *before, message = read(case.direction, chunks, quiet=False)
            assert message == case.message, digits
            assert bytes_of(before) == leading
            assert not messages_in(before)


@in_turn("data", lambda: ["55", 0x55, None, [0x55], object()])
def test_what_is_no_bytes_is_refused_and_changes_nothing(data: Any) -> None:
    decoder = StreamDecoder(HOST)
    decoder.feed(STOP[:3])
    with pytest.raises(TypeError, match="bytes, bytearray or memoryview expected"):
        decoder.feed(data)
    assert decoder.counters.fed == 3
    assert decoder.feed(STOP[3:]) == [ActionGroupStop()]


@in_turn(
    "given, error, said",
    lambda: [
        (("host",), TypeError, "a Direction expected"),
        ((HOST, 6.5), TypeError, "interpreted as an integer"),
        *(
            ((HOST, size), ValueError, f"max_frame is {size}, and the smallest frame has 4 bytes")
            for size in (3, 0, -1)
        ),
    ],
)
def test_a_decoder_is_made_of_a_direction_and_a_size_that_a_frame_can_have(
    given: tuple[Any, ...], error: type[Exception], said: str
) -> None:
    with pytest.raises(error, match=re.escape(said)):
        StreamDecoder(*given)


@in_turn(
    "max_frame, line, events",
    lambda: [
        (4, "55 55 02 07", [ActionGroupStop()]),
        (6, "55 55 05 06 08 01 00", [noise("55 55 05 06 08 01 00", LENGTH)]),
        (7, "55 55 05 06 08 01 00", [ActionGroupRun(group=8, times=1)]),
        # Whether its command is known makes no difference.
        (6, "55 55 05 63 08 01 00", [noise("55 55 05 63 08 01 00", LENGTH)]),
        (1000, "55 55 02 07", [ActionGroupStop()]),
    ],
)
def test_a_frame_larger_than_the_largest_is_refused_by_its_length(
    max_frame: int, line: str, events: list[Message | Noise]
) -> None:
    decoder = StreamDecoder(HOST, max_frame)
    assert joined(decoder.feed(bytes.fromhex(line)) + decoder.flush()) == events


@given(lines, directions, st.data())
def test_a_copy_goes_on_by_itself(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    cut = data.draw(st.integers(0, len(line)))
    decoder = StreamDecoder(direction)
    before = decoder.feed(line[:cut])
    other = copy(decoder)
    other.feed(b"\x55\x55\x00" * 90)
    other.flush()
    rest = decoder.feed(line[cut:]) + decoder.flush()
    assert joined(before + rest) == joined(read(direction, [line]))
    assert decoder.counters.fed == len(line)


# --- The invariants ------------------------------------------------------------------------------
@given(lines, directions, st.data())
def test_1_2_nothing_is_lost_all_is_counted_and_chunking_does_not_matter(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    decoder = StreamDecoder(direction)
    events: list[Message | Noise] = []
    fed = b""
    # From quiet to quiet, twice.
    for chunk in [*data.draw(pieces(line)), None, *data.draw(pieces(line)), None]:
        events += decoder.flush() if chunk is None else decoder.feed(chunk)
        fed += chunk or b""
        reported, counters, messages = bytes_of(events), decoder.counters, messages_in(events)
        assert fed.startswith(reported)
        assert len(reported) + decoder.pending == len(fed) == counters.fed
        assert counters.messages == len(messages)
        assert counters.unknown_frames == len(unknown_in(events))
        assert counters.noise == len(reported) - len(bytes_of(messages))
    assert (bytes_of(events), decoder.pending) == (2 * line, 0)
    # Messages, unknown frames and the reason of every byte of noise: all but where noise was cut.
    assert joined(read(direction, data.draw(pieces(line)))) == joined(read(direction, [line]))


@given(directions, st.data())
def test_3_noise_that_holds_no_complete_header_never_costs_a_frame(
    direction: Direction | None, data: st.DataObject
) -> None:
    line, sent = data.draw(strategies.noisy_streams(direction))
    expected = [decode(message.encode(), direction) for message in sent]
    assert messages_in(read(direction, data.draw(pieces(line)))) == expected
    # Nor is any of them held back until the line goes quiet.
    assert messages_in(read(direction, [line], quiet=False)) == expected


@given(lines, directions, st.none() | st.integers(4, 300), st.data())
def test_4_it_holds_at_most_the_largest_legal_frame(
    line: bytes, direction: Direction | None, max_frame: int | None, data: st.DataObject
) -> None:
    decoder = StreamDecoder(direction, max_frame)
    for chunk in data.draw(pieces(line)):
        decoder.feed(chunk)
        assert decoder.pending < min(LARGEST, max_frame or LARGEST)
        assert bytes_held(decoder) == decoder.pending


def bytes_held(decoder: StreamDecoder) -> int:
    """Return how many bytes a decoder keeps, in all its slots; it has no other place for them."""
    kept = [
        getattr(decoder, name)
        for kind in StreamDecoder.__mro__[:-1]
        for name in vars(kind)["__slots__"]
    ]
    assert not hasattr(decoder, "__dict__")
    assert not any(isinstance(value, (list, bytearray, memoryview, tuple)) for value in kept)
    return sum(len(value) for value in kept if isinstance(value, bytes))


@each_direction
def test_4_it_holds_no_more_for_a_beginning_within_an_unknown_frame(
    direction: Direction | None,
) -> None:
    # Both claim all that a length can say, and the second begins just before the first ends.
    for head in HEADS:
        for between in (0, 100, *range(247, 253)):
            decoder = StreamDecoder(direction)
            decoder.feed(bytes.fromhex("55 55 FF 63") + bytes(between))
            for byte in single_bytes(head + bytes(260)):
                decoder.feed(byte)
                assert decoder.pending < LARGEST


@pytest.mark.parametrize("command", [0x06, 0x08, 0x63])
def test_4_what_all_decoders_share_does_not_grow_with_what_arrives(command: int) -> None:
    def beginnings(group: int) -> None:
        for times in range(256):
            decoder = StreamDecoder(EITHER)
            decoder.feed(bytes([0x55, 0x55, 5, command, group, times]))
            decoder.feed(bytes([group, times]))

    beginnings(0)
    # What is collected meanwhile would hide what is kept.
    gc.disable()
    try:
        before = sys.getallocatedblocks()
        for group in range(1, 8):
            beginnings(group)
        grown = sys.getallocatedblocks() - before
    finally:
        gc.enable()
    # One in ten of these frames, if it were kept, would be more.
    assert grown < 7 * 256 // 10


@given(lines, directions, st.data())
def test_5_flush_rescans_what_a_false_header_was_holding_back(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    decoder = StreamDecoder(direction)
    reported = bytes_of(event for chunk in data.draw(pieces(line)) for event in decoder.feed(chunk))
    last = decoder.flush()
    assert scanned(last) == oracle.scan(line[len(reported) :], oracles(direction))
    # After silence nothing is remembered: the decoder is as good as new.
    assert (decoder.pending, decoder.flush()) == (0, [])
    assert joined(decoder.feed(line)) == joined(read(direction, [line], quiet=False))


@given(unknown_frames(), st.integers(0, 16), directions, st.data())
def test_6_an_unknown_command_never_swallows_what_follows(
    unknown: bytes, kept: int, direction: Direction | None, data: st.DataObject
) -> None:
    # However much of the unknown frame there is, and however much of what follows it claims.
    message = data.draw(strategies.messages(direction))
    line = unknown[: 4 + kept] + message.encode()
    found = messages_in(read(direction, data.draw(pieces(line)), quiet=False))
    assert found == [decode(message.encode(), direction)]


@given(st.lists(unknown_frames(), min_size=1, max_size=4), directions, st.data())
def test_6_an_unknown_frame_is_shown(
    frames: list[bytes], direction: Direction | None, data: st.DataObject
) -> None:
    # As soon as it is whole, whatever may follow.
    events = read(direction, data.draw(pieces(b"".join(frames))), quiet=False)
    assert unknown_in(events) == events
    assert [event.data for event in unknown_in(events)] == frames
    assert [event.command for event in unknown_in(events)] == [frame[3] for frame in frames]
    assert [event.parameters for event in unknown_in(events)] == [frame[4:] for frame in frames]


# --- Chosen lines --------------------------------------------------------------------------------

# The first 86 bytes of a move of 65 servos: what LENGTH 55 counts, with a stray 55 in front.
LONG_MOVE = ServoMove(800, [(servo, 500) for servo in range(65)]).encode()[:86].hex(" ")
FIVE = ServoMove(1500, [(servo, 500) for servo in range(1, 6)])
STOPS, VOLTAGE = ActionGroupStop(), BatteryVoltage(7500)
LX16A = "55 55 01 07 01 F4 01 E8 03 16"
WRONG = ("55 54", "55 55 00 55 55 04 06 00", "55 55 08 03 02", "55 55 08 03 01")
ZERO, NONE, NO_13 = noise("55 55 00", LENGTH), unknown("55 55 02 63"), noise("13", HEADER)


@in_turn(
    "direction, line, events",
    lambda: [
        (HOST, "", []),
        (HOST, "00", [noise("00", HEADER)]),
        # An unknown command's length is not believed.
        (HOST, "55 55 FF 55 55 02 07", [noise("55 55 FF", UNKNOWN), STOPS]),
        (CONTROLLER, "55 55 FF 55 55 02 07", [noise("55 55 FF", UNKNOWN), ActionGroupStopped()]),
        # An unknown frame is shown when nothing else is in it, and hides nothing behind it.
        (HOST, "55 55 03 63 2A 55 55 02 07", [unknown("55 55 03 63 2A"), STOPS]),
        (HOST, "55 55 06 63 55 55 02 07", [noise("55 55 06 63", UNKNOWN), STOPS]),
        # Its last byte may begin a frame, which is worth more.
        (HOST, "55 55 03 63 55 55 02 07", [noise("55 55 03 63", UNKNOWN), STOPS]),
        # What follows a message or an unknown frame is judged anew.
        (HOST, "55 55 00 55 55 02 07 13", [ZERO, STOPS, NO_13]),
        (HOST, "55 55 00 55 55 02 63 13", [ZERO, NONE, NO_13]),
        # The reports are unknown to a controller, and shown to it.
        (HOST, "55 55 05 08 08 01 00", [unknown("55 55 05 08 08 01 00")]),
        # One unknown frame in another that never ends, seen when the line has gone quiet.
        (HOST, "55 55 40 63 55 55 02 64", [noise("55 55 40 63", UNKNOWN), unknown("55 55 02 64")]),
        # Each reason for which a header is refused.
        (HOST, " ".join(WRONG), [*map(noise, WRONG, (HEADER, LENGTH, COUNT, SHORT))]),
        (EITHER, "55 55 06 15 02", [noise("55 55 06 15 02", COUNT)]),
        # A stray 55 before a move of five reads as an unload, until the count is seen.
        (HOST, f"55 {FIVE.encode().hex(' ')}", [noise("55", COUNT), FIVE]),
        # A stray 55 before a long move reads as an unknown frame, in which the move has begun.
        (HOST, f"55 {LONG_MOVE}", [noise("55", UNKNOWN), noise(LONG_MOVE, SHORT)]),
        # There is no checksum: a frame cut short takes its rest from the next.
        (HOST, "55 55 05 06 08 55 55 02 07", [ActionGroupRun(8, 0x5555), noise("02 07", HEADER)]),
        # An LX-16A frame: servo 1 to 500 in 1000 ms.
        (HOST, f"{LX16A} 55 55 02 07", [noise(LX16A, LENGTH), STOPS]),
    ],
)
def test_a_stream_reads_as_expected(
    direction: Direction | None, line: str, events: list[Message | Noise]
) -> None:
    data = bytes.fromhex(line)
    assert joined(read(direction, [data])) == events
    assert joined(read(direction, single_bytes(data))) == events


SHORT_VOLTAGE = noise("55 55 09 0F", LENGTH)
RUN_OF_HEADERS = noise("55 55 55 55 55 55", UNKNOWN)
# What an unknown frame that was none leaves, in front of a voltage.
LEFT = {
    "55 55 0C 63 01 55 55 09 0F": [noise("55 55 0C 63 01", UNKNOWN), SHORT_VOLTAGE],
    # But one piece for a run of headers, each a byte after the other.
    "55 55 0C 63 55 55 55 55 55 55": [noise("55 55 0C 63", UNKNOWN), RUN_OF_HEADERS],
    # Two headers with a byte between them are no run.
    "55 55 10 63 55 55 09 0F 55 55 09 0F": [noise("55 55 10 63", UNKNOWN), *[SHORT_VOLTAGE] * 2],
    # Other unknown frames may be in there, and what follows them is judged anew.
    "55 55 12 63 55 55 02 63 07 55 55 02 63 55 55 09 0F": [
        *(noise("55 55 12 63", UNKNOWN), NONE, noise("07", HEADER), NONE, SHORT_VOLTAGE)
    ],
}


@in_turn("line", lambda: LEFT)
def test_what_an_unknown_frame_leaves_that_was_none_has_a_piece_for_each_refused_header(
    line: str,
) -> None:
    data, events = bytes.fromhex(line) + VOLTAGE.encode(), [*LEFT[line], VOLTAGE]
    assert read(CONTROLLER, [data]) == events
    assert read(CONTROLLER, [b"\x13" + data]) == [NO_13, *events]


@each_direction
def test_an_empty_feed_is_no_sign_of_silence(direction: Direction | None) -> None:
    for head in HEADS:
        decoder = StreamDecoder(direction)
        decoder.feed(head)
        pending = decoder.pending
        assert decoder.feed(b"") == []
        assert decoder.pending == pending


# --- Noise as a value ----------------------------------------------------------------------------
def test_noise_is_equal_by_value_and_kind() -> None:
    data = bytes.fromhex("55 55 02 63")
    plain, odd = Noise(data, HEADER), UnknownFrame(data, HEADER)
    assert plain == Noise(data, HEADER) != odd == UnknownFrame(data, HEADER)
    assert hash(plain) == hash(Noise(data, HEADER))
    for other in (Noise(data, SHORT), Noise(data[1:], HEADER), odd, data):
        assert plain != other
    assert len({plain, odd, Noise(data, HEADER)}) == 2


def test_noise_cannot_be_changed() -> None:
    piece: Any = noise("00", HEADER)
    for name in ("data", "reason", "colour"):
        with pytest.raises(AttributeError):
            setattr(piece, name, b"")


def test_noise_shows_itself_and_can_be_taken_apart() -> None:
    for event, shown in (
        (noise("55 AA", HEADER), "Noise(bytes.fromhex('55 AA'), Reason.BAD_HEADER)"),
        (
            unknown("55 55 02 63"),
            "UnknownFrame(bytes.fromhex('55 55 02 63'), Reason.UNKNOWN_COMMAND)",
        ),
    ):
        assert repr(event) == shown
        assert eval(shown) == event  # noqa: S307
        assert type(event).__match_args__ == ("data", "reason")


@in_turn("size", lambda: [1, 3, 1000])
def test_every_event_is_counted(size: int) -> None:
    line = bytes.fromhex("00 13 55 55 02 07 55 55 02 07 01 55 55 03 01 2A 55 55 02 07")
    decoder = StreamDecoder(HOST)
    for turn in (1, 2):
        for at in range(0, len(line), size):
            decoder.feed(line[at : at + size])
        counted = f"fed={20 * turn}, messages={3 * turn}, noise={8 * turn}, unknown_frames={turn}"
        assert repr(decoder.counters) == f"Counters({counted})"


# --- Work ----------------------------------------------------------------------------------------
def calls(work: Callable[[], object]) -> int:
    """Return how many functions are called by `work`: time, without a clock."""
    count = 0

    def profile(frame: FrameType, event: str, argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    # What is collected meanwhile is not what the work has left behind.
    gc.disable()
    sys.setprofile(profile)
    try:
        work()
    finally:
        sys.setprofile(before)
        gc.enable()
    return count
