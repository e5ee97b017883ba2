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
    MESSAGES,
    ActionGroupRun,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    BatteryVoltage,
    Counters,
    Direction,
    Message,
    Noise,
    Reason,
    ServoMove,
    ServoPositions,
    StreamDecoder,
    UnknownFrame,
    decode,
    strategies,
)
from hypothesis import given
from hypothesis import strategies as st

from tests import oracle
from tests.cases import CASES, CONTROLLER, EITHER, HOST, BadFrame, Case, each_bad_frame, each_case
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

each_direction = pytest.mark.parametrize("direction", DIRECTIONS, ids=str)


# --- The table of truth --------------------------------------------------------------------------


@each_case
def test_a_frame_is_read_whole(case: Case) -> None:
    assert StreamDecoder(case.direction).feed(case.frame) == [case.message]


@each_case
def test_a_frame_is_read_byte_by_byte(case: Case) -> None:
    decoder = StreamDecoder(case.direction)
    *beginning, last = single_bytes(case.frame)

    assert [decoder.feed(byte) for byte in beginning] == [[] for _ in beginning]
    assert decoder.pending == len(beginning)
    assert decoder.feed(last) == [case.message]
    assert decoder.pending == 0


@each_case
def test_a_frame_is_read_with_trailing_data(case: Case) -> None:
    decoder = StreamDecoder(case.direction)

    assert decoder.feed(case.frame + b"\x55\x55\x02") == [case.message]
    assert decoder.pending == 3
    assert joined(decoder.flush()) == [noise("55 55 02", Reason.TOO_SHORT)]


@each_case
def test_a_frame_is_read_with_leading_noise(case: Case) -> None:
    for digits in ("00", "55", "13 55 AA", "55 55 01", "55 55 63", "00 55 55"):
        leading = bytes.fromhex(digits)
        for chunks in ([leading, case.frame], [leading + case.frame]):
            *before, message = read(case.direction, chunks, quiet=False)

            assert message == case.message, digits
            assert bytes_of(before) == leading
            assert not messages_in(before)


@each_case
def test_a_frame_is_read_without_a_direction(case: Case) -> None:
    assert read(EITHER, [case.frame]) == [decode(case.frame, EITHER)]


@each_case
def test_a_frame_is_read_after_any_frame(case: Case) -> None:
    friends = [other for other in CASES if other.direction is case.direction]

    line = b"".join(friend.frame + case.frame for friend in friends)

    assert read(case.direction, [line]) == [
        message for friend in friends for message in (friend.message, case.message)
    ]


@each_bad_frame
def test_a_bad_frame_is_noise(bad: BadFrame) -> None:
    events = read(bad.direction, [bad.frame])

    assert bytes_of(events) == bad.frame
    if bad.reason is not Reason.TRAILING_BYTES and STOP not in bad.frame:
        assert not messages_in(events)


@pytest.mark.parametrize("convert", [bytes, bytearray, memoryview])
def test_any_kind_of_bytes_is_taken(convert: Callable[[bytes], Any]) -> None:
    assert read(HOST, [convert(STOP)]) == [ActionGroupStop()]


def test_what_was_fed_may_change_afterwards() -> None:
    decoder = StreamDecoder(CONTROLLER)
    buffer = bytearray.fromhex("55 55 04 0F C9")
    decoder.feed(buffer)
    buffer[:] = bytes(5)

    assert decoder.feed(b"\x1e") == [BatteryVoltage(voltage_mv=7881)]


@pytest.mark.parametrize("data", ["55", 0x55, None, [0x55], object()])
def test_what_is_no_bytes_is_refused_and_changes_nothing(data: Any) -> None:
    decoder = StreamDecoder(HOST)
    decoder.feed(STOP[:3])
    with pytest.raises(TypeError, match="bytes, bytearray or memoryview expected"):
        decoder.feed(data)

    assert decoder.counters.fed == 3
    assert decoder.feed(STOP[3:]) == [ActionGroupStop()]


def test_a_direction_must_be_one() -> None:
    wrong: Any = "host"
    with pytest.raises(TypeError, match="a Direction expected"):
        StreamDecoder(wrong)


@pytest.mark.parametrize("max_frame", [3, 0, -1])
def test_no_frame_is_so_small(max_frame: int) -> None:
    text = f"max_frame is {max_frame}, and the smallest frame has 4 bytes"
    with pytest.raises(ValueError, match=re.escape(text)):
        StreamDecoder(HOST, max_frame)


def test_the_largest_frame_is_a_whole_number() -> None:
    wrong: Any = 6.5
    with pytest.raises(TypeError):
        StreamDecoder(HOST, wrong)


@pytest.mark.parametrize(
    ("max_frame", "line", "events"),
    [
        (4, "55 55 02 07", [ActionGroupStop()]),
        (6, "55 55 05 06 08 01 00", [noise("55 55 05 06 08 01 00", Reason.LENGTH_MISMATCH)]),
        (7, "55 55 05 06 08 01 00", [ActionGroupRun(group=8, times=1)]),
        # Whether its command is known makes no difference.
        (6, "55 55 05 63 08 01 00", [noise("55 55 05 63 08 01 00", Reason.LENGTH_MISMATCH)]),
        (1000, "55 55 02 07", [ActionGroupStop()]),
    ],
)
def test_a_frame_larger_than_the_largest_is_refused_by_its_length(
    max_frame: int, line: str, events: list[Message | Noise]
) -> None:
    decoder = StreamDecoder(HOST, max_frame)
    assert joined(decoder.feed(bytes.fromhex(line)) + decoder.flush()) == events


@given(lines, directions, st.integers(4, 300))
def test_nothing_larger_than_the_largest_frame_is_ever_held(
    line: bytes, direction: Direction | None, max_frame: int
) -> None:
    decoder = StreamDecoder(direction, max_frame)
    for byte in single_bytes(line):
        decoder.feed(byte)
        assert decoder.pending < max_frame


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
def test_1_nothing_is_lost(line: bytes, direction: Direction | None, data: st.DataObject) -> None:
    decoder = StreamDecoder(direction)
    events: list[Message | Noise] = []
    fed = b""
    for chunk in data.draw(pieces(line)):
        events += decoder.feed(chunk)
        fed += chunk
        reported = bytes_of(events)
        assert fed.startswith(reported)
        assert len(reported) + decoder.pending == len(fed)
    events += decoder.flush()

    assert bytes_of(events) == line
    assert decoder.pending == 0


@given(lines, directions, st.data())
def test_2_chunking_does_not_matter(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    chunks = data.draw(pieces(line))

    # Messages, unknown frames and the reason of every byte of noise: all but where noise was cut.
    assert joined(read(direction, chunks)) == joined(read(direction, [line]))


@given(directions, st.data())
def test_3_noise_that_holds_no_complete_header_never_costs_a_frame(
    direction: Direction | None, data: st.DataObject
) -> None:
    line, sent = data.draw(strategies.noisy_streams(direction))

    expected = [decode(message.encode(), direction) for message in sent]
    assert messages_in(read(direction, data.draw(pieces(line)))) == expected
    # Nor is any of them held back until the line goes quiet.
    assert messages_in(read(direction, [line], quiet=False)) == expected


@given(lines, directions, st.data())
def test_4_it_holds_at_most_the_largest_legal_frame(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    decoder = StreamDecoder(direction)
    for chunk in data.draw(pieces(line)):
        decoder.feed(chunk)
        assert decoder.pending < LARGEST
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
@in_turn("length", lambda: [0, 1, 2, 5, 85, 254, 255])
def test_4_it_holds_no_more_after_any_beginning_of_a_frame(
    direction: Direction | None, length: int
) -> None:
    decoder = StreamDecoder(direction)
    for command in range(256):
        decoder.feed(bytes([0x55, 0x55, length, command]))
        assert decoder.pending < LARGEST


@each_direction
def test_4_it_holds_no_more_for_a_beginning_within_an_unknown_frame(
    direction: Direction | None,
) -> None:
    # Both claim all that a length can say, and the second begins just before the first ends.
    for head in HEADS:
        for between in (0, 1, 100, *range(240, 253)):
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


@given(st.lists(st.binary(max_size=300) | lines | st.none(), max_size=6), directions)
def test_5_it_never_raises_on_input(
    chunks: list[bytes | None], direction: Direction | None
) -> None:
    decoder = StreamDecoder(direction)
    for chunk in chunks:
        events = decoder.flush() if chunk is None else decoder.feed(chunk)
        assert all(isinstance(event, (Message, Noise)) for event in events)


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


@given(lines, st.binary(max_size=12).filter(lambda data: data), directions)
def test_5_flush_finds_frames_behind_a_beginning_that_never_ends(
    line: bytes, rest: bytes, direction: Direction | None
) -> None:
    # A move of 83 servos is announced, and then the line goes quiet.
    hidden = bytes.fromhex("55 55 FE 03 53") + (line + rest)[:200]
    decoder = StreamDecoder(HOST if direction is None else direction)

    events = decoder.feed(hidden) + decoder.flush()

    assert scanned(events) == oracle.scan(hidden, oracles(direction or HOST))


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


@given(lines, directions)
def test_6_what_is_shown_has_the_exact_shape_of_an_unknown_frame(
    line: bytes, direction: Direction | None
) -> None:
    known = {kind.COMMAND for kind in MESSAGES if direction in (None, kind.DIRECTION)}
    for event in unknown_in(read(direction, [line])):
        assert event.reason is Reason.UNKNOWN_COMMAND
        assert event.data[:2] == b"\x55\x55"
        assert event.data[2] + 2 == len(event.data)
        assert event.command not in known
        # No message is within.
        assert oracle.scan(event.data, oracles(direction)) == [event.data]


# --- Chosen lines --------------------------------------------------------------------------------

# The first 86 bytes of a move of 65 servos: what LENGTH 55 counts, with a stray 55 in front.
LONG_MOVE = ServoMove(800, [(servo, 500) for servo in range(65)]).encode()[:86].hex(" ")


@in_turn(
    "direction, line, events",
    lambda: [
        (HOST, "", []),
        (HOST, "00", [noise("00", Reason.BAD_HEADER)]),
        # An unknown command's length is not believed.
        (
            HOST,
            "55 55 FF 55 55 02 07",
            [noise("55 55 FF", Reason.UNKNOWN_COMMAND), ActionGroupStop()],
        ),
        (
            CONTROLLER,
            "55 55 FF 55 55 02 07",
            [noise("55 55 FF", Reason.UNKNOWN_COMMAND), ActionGroupStopped()],
        ),
        # An unknown frame is shown when nothing else is in it, and hides nothing behind it.
        (
            HOST,
            "55 55 03 63 2A 55 55 02 07",
            [
                UnknownFrame(bytes.fromhex("55 55 03 63 2A"), Reason.UNKNOWN_COMMAND),
                ActionGroupStop(),
            ],
        ),
        (
            HOST,
            "55 55 06 63 55 55 02 07",
            [noise("55 55 06 63", Reason.UNKNOWN_COMMAND), ActionGroupStop()],
        ),
        # Its last byte may begin a frame, which is worth more.
        (
            HOST,
            "55 55 03 63 55 55 02 07",
            [noise("55 55 03 63", Reason.UNKNOWN_COMMAND), ActionGroupStop()],
        ),
        # What follows a message or an unknown frame is judged anew.
        (
            HOST,
            "55 55 00 55 55 02 07 13",
            [
                noise("55 55 00", Reason.LENGTH_MISMATCH),
                ActionGroupStop(),
                noise("13", Reason.BAD_HEADER),
            ],
        ),
        (
            HOST,
            "55 55 00 55 55 02 63 13",
            [
                noise("55 55 00", Reason.LENGTH_MISMATCH),
                UnknownFrame(bytes.fromhex("55 55 02 63"), Reason.UNKNOWN_COMMAND),
                noise("13", Reason.BAD_HEADER),
            ],
        ),
        # The reports are unknown to a controller, and shown to it.
        (
            HOST,
            "55 55 05 08 08 01 00",
            [UnknownFrame(bytes.fromhex("55 55 05 08 08 01 00"), Reason.UNKNOWN_COMMAND)],
        ),
        # One unknown frame in another that never ends, seen when the line has gone quiet.
        (
            HOST,
            "55 55 40 63 55 55 02 64",
            [
                noise("55 55 40 63", Reason.UNKNOWN_COMMAND),
                UnknownFrame(bytes.fromhex("55 55 02 64"), Reason.UNKNOWN_COMMAND),
            ],
        ),
        # Each reason for which a header is refused.
        (
            HOST,
            "55 54 55 55 00 55 55 04 06 00 55 55 08 03 02 55 55 08 03 01",
            [
                noise("55 54", Reason.BAD_HEADER),
                noise("55 55 00 55 55 04 06 00", Reason.LENGTH_MISMATCH),
                noise("55 55 08 03 02", Reason.COUNT_MISMATCH),
                noise("55 55 08 03 01", Reason.TOO_SHORT),
            ],
        ),
        (EITHER, "55 55 06 15 02", [noise("55 55 06 15 02", Reason.COUNT_MISMATCH)]),
        # A stray 55 before a move of five reads as an unload, until the count is seen.
        (
            HOST,
            "55 55 55 14 03 05 DC 05 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01",
            [
                noise("55", Reason.COUNT_MISMATCH),
                ServoMove(1500, [(1, 500), (2, 500), (3, 500), (4, 500), (5, 500)]),
            ],
        ),
        # A stray 55 before a long move reads as an unknown frame, in which the move has begun.
        (
            HOST,
            f"55 {LONG_MOVE}",
            [noise("55", Reason.UNKNOWN_COMMAND), noise(LONG_MOVE, Reason.TOO_SHORT)],
        ),
        # There is no checksum: a frame cut short takes its rest from the next.
        (
            HOST,
            "55 55 05 06 08 55 55 02 07",
            [ActionGroupRun(group=8, times=0x5555), noise("02 07", Reason.BAD_HEADER)],
        ),
        # An LX-16A frame: servo 1 to 500 in 1000 ms.
        (
            HOST,
            "55 55 01 07 01 F4 01 E8 03 16 55 55 02 07",
            [noise("55 55 01 07 01 F4 01 E8 03 16", Reason.LENGTH_MISMATCH), ActionGroupStop()],
        ),
    ],
)
def test_a_stream_reads_as_expected(
    direction: Direction | None, line: str, events: list[Message | Noise]
) -> None:
    data = bytes.fromhex(line)

    assert joined(read(direction, [data])) == events
    assert joined(read(direction, single_bytes(data))) == events


@pytest.mark.parametrize(
    ("line", "events"),
    [
        (
            "55 55 0C 63 01 55 55 09 0F 55 55 04 0F 4C 1D",
            [
                noise("55 55 0C 63 01", Reason.UNKNOWN_COMMAND),
                noise("55 55 09 0F", Reason.LENGTH_MISMATCH),
                BatteryVoltage(7500),
            ],
        ),
        # But one piece for a run of headers, each a byte after the other.
        (
            "55 55 0C 63 55 55 55 55 55 55 55 55 04 0F 4C 1D",
            [
                noise("55 55 0C 63", Reason.UNKNOWN_COMMAND),
                noise("55 55 55 55 55 55", Reason.UNKNOWN_COMMAND),
                BatteryVoltage(7500),
            ],
        ),
        # Two headers with a byte between them are no run.
        (
            "55 55 10 63 55 55 09 0F 55 55 09 0F 55 55 04 0F 4C 1D",
            [
                noise("55 55 10 63", Reason.UNKNOWN_COMMAND),
                noise("55 55 09 0F", Reason.LENGTH_MISMATCH),
                noise("55 55 09 0F", Reason.LENGTH_MISMATCH),
                BatteryVoltage(7500),
            ],
        ),
        # Other unknown frames may be in there, and what follows them is judged anew.
        (
            "55 55 12 63 55 55 02 63 07 55 55 02 63 55 55 09 0F 55 55 04 0F 4C 1D",
            [
                noise("55 55 12 63", Reason.UNKNOWN_COMMAND),
                UnknownFrame(bytes.fromhex("55 55 02 63"), Reason.UNKNOWN_COMMAND),
                noise("07", Reason.BAD_HEADER),
                UnknownFrame(bytes.fromhex("55 55 02 63"), Reason.UNKNOWN_COMMAND),
                noise("55 55 09 0F", Reason.LENGTH_MISMATCH),
                BatteryVoltage(7500),
            ],
        ),
    ],
)
def test_what_an_unknown_frame_leaves_that_was_none_has_a_piece_for_each_refused_header(
    line: str, events: list[Message | Noise]
) -> None:
    assert read(CONTROLLER, [bytes.fromhex(line)]) == events
    before = noise("13", Reason.BAD_HEADER)
    assert read(CONTROLLER, [b"\x13" + bytes.fromhex(line)]) == [before, *events]


@in_turn("second", lambda: range(30, 45))
@in_turn("first", lambda: [46, 50, 60])
def test_an_unknown_frame_that_begins_in_a_run_is_seen_however_the_run_was_cut(
    first: int, second: int
) -> None:
    run, rest = (first + second) * b"\x55", bytes(100)
    claimed = 2 + 0x55

    # What ends within the run may go on; the first to end behind it stands alone.
    void = max(0, len(run) + 1 - claimed)
    line = run + rest
    assert joined(read(CONTROLLER, [run[:first], run[first:], rest])) == [
        *([Noise(line[:void], Reason.UNKNOWN_COMMAND)] if void else []),
        UnknownFrame(line[void : void + claimed], Reason.UNKNOWN_COMMAND),
        Noise(line[void + claimed :], Reason.BAD_HEADER),
    ]


@each_case
def test_twenty_frames_are_all_read_after_one_stray_55(case: Case) -> None:
    line = b"\x55" + 20 * case.frame

    for chunks in ([line], single_bytes(line)):
        first, *rest = read(case.direction, chunks, quiet=False)

        assert bytes_of([first]) == b"\x55"
        assert rest == 20 * [case.message]


def test_a_piece_of_noise_runs_from_a_refused_header_to_the_next() -> None:
    line = bytes.fromhex("13 55 55 00 01 55 55 01 02 03")

    assert StreamDecoder(HOST).feed(line) == [
        noise("13", Reason.BAD_HEADER),
        noise("55 55 00 01", Reason.LENGTH_MISMATCH),
        noise("55 55 01 02 03", Reason.LENGTH_MISMATCH),
    ]


def test_a_length_that_none_can_have_is_refused_at_the_third_byte() -> None:
    assert StreamDecoder(HOST).feed(b"\x55\x55\x01") == [noise("55 55 01", Reason.LENGTH_MISMATCH)]


def test_a_length_that_this_command_cannot_have_is_refused_at_the_fourth_byte() -> None:
    decoder = StreamDecoder(HOST)

    assert decoder.feed(b"\x55\x55\x09") == []
    assert decoder.feed(b"\x03") == [noise("55 55 09 03", Reason.LENGTH_MISMATCH)]


@pytest.mark.parametrize(
    ("direction", "head"),
    [
        (HOST, "55 55 FE 03"),
        (HOST, "55 55 FF 14"),
        (CONTROLLER, "55 55 FF 15"),
        (EITHER, "55 55 FF 15"),
    ],
)
def test_a_count_that_disagrees_is_refused_at_the_fifth_byte(
    direction: Direction | None, head: str
) -> None:
    decoder = StreamDecoder(direction)

    assert decoder.feed(bytes.fromhex(head)) == []
    assert decoder.feed(b"\x01") == [noise(f"{head} 01", Reason.COUNT_MISMATCH)]


@each_direction
def test_an_empty_feed_is_no_sign_of_silence(direction: Direction | None) -> None:
    for head in HEADS:
        decoder = StreamDecoder(direction)
        decoder.feed(head)
        pending = decoder.pending

        assert decoder.feed(b"") == []
        assert decoder.pending == pending


def test_noise_is_judged_anew_after_silence() -> None:
    decoder = StreamDecoder(HOST)
    decoder.feed(b"\x55\x55\x00\x07")
    decoder.flush()

    assert decoder.feed(b"\x13") == [noise("13", Reason.BAD_HEADER)]


def test_silence_without_anything_held_says_nothing() -> None:
    assert StreamDecoder(HOST).flush() == []


@given(lines, directions)
def test_noise_without_a_header_before_it_is_a_bad_header(
    line: bytes, direction: Direction | None
) -> None:
    at = 0
    last: Message | Noise | None = None
    for event in read(direction, [line]):
        if type(event) is Noise and type(last) is not Noise:
            assert (event.reason is Reason.BAD_HEADER) is not line.startswith(b"\x55\x55", at)
        at += len(bytes_of([event]))
        last = event


# --- Noise as a value ----------------------------------------------------------------------------


def test_noise_is_equal_by_value_and_kind() -> None:
    data = bytes.fromhex("55 55 02 63")
    plain, unknown = Noise(data, Reason.BAD_HEADER), UnknownFrame(data, Reason.BAD_HEADER)

    assert plain == Noise(data, Reason.BAD_HEADER)
    assert hash(plain) == hash(Noise(data, Reason.BAD_HEADER))
    assert plain != Noise(data, Reason.TOO_SHORT)
    assert plain != Noise(data[1:], Reason.BAD_HEADER)
    assert plain != unknown
    assert unknown == UnknownFrame(data, Reason.BAD_HEADER)
    assert plain != data
    assert len({plain, unknown, Noise(data, Reason.BAD_HEADER)}) == 2


def test_noise_cannot_be_changed() -> None:
    piece: Any = noise("00", Reason.BAD_HEADER)

    for name in ("data", "reason", "colour"):
        with pytest.raises(AttributeError):
            setattr(piece, name, b"")


def test_noise_shows_itself() -> None:
    piece = noise("55 AA", Reason.BAD_HEADER)
    unknown = UnknownFrame(b"\x55\x55\x02\x63", Reason.UNKNOWN_COMMAND)

    assert repr(piece) == "Noise(bytes.fromhex('55 AA'), Reason.BAD_HEADER)"
    assert repr(unknown) == "UnknownFrame(bytes.fromhex('55 55 02 63'), Reason.UNKNOWN_COMMAND)"
    assert eval(repr(piece)) == piece  # noqa: S307
    assert eval(repr(unknown)) == unknown  # noqa: S307


def test_match_statements_distinguish_events() -> None:
    shown = []
    for event in read(CONTROLLER, [bytes.fromhex("00 55 55 02 63 55 55 05 06 08 01 00")]):
        match event:
            case ActionGroupStarted(group, times):
                shown.append(f"group {group} x {times}")
            case UnknownFrame(data, _):
                shown.append(f"unknown {data.hex()}")
            case Noise(data, Reason.BAD_HEADER):
                shown.append(f"noise {data.hex()}")

    assert shown == ["noise 00", "unknown 55550263", "group 8 x 1"]


# --- Counters ------------------------------------------------------------------------------------


@given(lines, directions, st.data())
def test_the_counters_add_up(line: bytes, direction: Direction | None, data: st.DataObject) -> None:
    decoder = StreamDecoder(direction)
    events: list[Message | Noise] = []
    for chunk in [*data.draw(pieces(line)), None]:
        events += decoder.flush() if chunk is None else decoder.feed(chunk)
        counters, messages = decoder.counters, messages_in(events)
        assert counters.messages == len(messages)
        assert counters.unknown_frames == len(unknown_in(events))
        assert counters.noise == len(bytes_of(events)) - len(bytes_of(messages))
        assert counters.fed == len(bytes_of(events)) + decoder.pending

    assert decoder.counters.fed == len(line)


@pytest.mark.parametrize("size", [1, 3, 1000])
def test_every_event_is_counted(size: int) -> None:
    line = bytes.fromhex("00 13 55 55 02 07 55 55 02 07 01 55 55 03 01 2A 55 55 02 07")
    decoder = StreamDecoder(HOST)
    for turn in (1, 2):
        for at in range(0, len(line), size):
            decoder.feed(line[at : at + size])
        counted = f"fed={20 * turn}, messages={3 * turn}, noise={8 * turn}, unknown_frames={turn}"
        assert repr(decoder.counters) == f"Counters({counted})"


def test_noise_is_reported_while_what_begins_behind_it_is_held() -> None:
    decoder = StreamDecoder(HOST)
    assert decoder.feed(bytes.fromhex("00 13 55 55")) == [Noise(b"\x00\x13", Reason.BAD_HEADER)]
    assert decoder.pending == 2


def test_what_ends_behind_an_unknown_frame_is_no_part_of_it_as_soon_as_that_is_whole() -> None:
    decoder = StreamDecoder(HOST)
    assert decoder.feed(bytes.fromhex("55 55 07 01 55 55 05 06")) == []
    assert bytes_of(decoder.feed(b"\x08")) == bytes.fromhex("55 55 07 01")
    assert decoder.pending == 5


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("55 55 00 55 55 00", [("55 55 00", "length"), ("55 55 00", "length")]),
        # A run of headers, each a byte after the other, is one piece: if it is for one reason.
        ("55 55 55 03 03 00", [("55 55 55 03 03 00", "length")]),
        ("55 55 55 0B 03 05 00", [("55", "length"), ("55 55 0B 03 05 00", "count")]),
    ],
)
def test_each_refused_header_is_a_piece_of_noise(
    line: str, expected: list[tuple[str, str]]
) -> None:
    decoder = StreamDecoder(HOST)
    events = decoder.feed(bytes.fromhex(line)) + decoder.flush()
    reasons = {"length": Reason.LENGTH_MISMATCH, "count": Reason.COUNT_MISMATCH}
    assert events == [Noise(bytes.fromhex(data), reasons[why]) for data, why in expected]


@in_turn(
    "direction, message",
    lambda: [
        (HOST, ServoMove(1000, [(1, 800)])),
        (CONTROLLER, ActionGroupStarted(8, 1)),
        # Of this length, a request and a reply share a head.
        (None, ServoPositions([(3, 800)])),
    ],
)
@in_turn("size", lambda: [2, 3, 4, 5, 6])
def test_noise_of_any_size_costs_no_frame_that_comes_in_two(
    size: int, direction: Direction | None, message: Message
) -> None:
    frame = message.encode()
    for before in range(16):
        decoder = StreamDecoder(direction)
        events = decoder.feed(bytes(before) + frame[:size]) + decoder.feed(frame[size:])
        assert messages_in(events) == [message], before


def test_the_counters_show_themselves() -> None:
    decoder = StreamDecoder(CONTROLLER)
    assert isinstance(decoder.counters, Counters)
    assert repr(decoder.counters) == "Counters(fed=0, messages=0, noise=0, unknown_frames=0)"

    decoder.feed(bytes.fromhex("00 55 55 02 63 55 55 02 07 55"))
    assert repr(decoder.counters) == "Counters(fed=10, messages=1, noise=5, unknown_frames=1)"


# --- Work ----------------------------------------------------------------------------------------

# Beginnings repeated for as long as one cares to send them.
HOSTILE = (
    "55",
    "55 00",
    "00",
    "55 55 FF",
    "55 55 55 63",
    "55 55 FF 63",
    "55 55 FF 63 00",
    "55 55 02 63",
    "55 55 FE 03 53",
    "55 55 FF 14 FC",
    "55 55 FF 15 54",
    "55 55 FF 15 FC",
    "55 55 08 03 02",
    "55 55 FF 63 55 55 FE 03 53",
    "55 55 05 06 55",
    "55 55 02 07",
)
# So many calls of functions, Python's own included, does a byte cost at most. A decoder that looks
# at anything twice for each byte that it holds back would need hundreds.
CALLS_PER_BYTE = 120


def uncut(line: bytes) -> list[bytes]:
    """Return `line`, in one piece."""
    return [line]


CUTS = (uncut, single_bytes)


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


@each_direction
@in_turn("pattern", lambda: HOSTILE)
@in_turn("cut", lambda: CUTS, ids=lambda cut: cut.__name__)
def test_hostile_input_costs_linear_time(
    pattern: str, direction: Direction | None, cut: Callable[[bytes], list[bytes]]
) -> None:
    def cost(size: int) -> int:
        line = (bytes.fromhex(pattern) * size)[:size]
        chunks = cut(line)
        return calls(lambda: read(direction, chunks))

    # What is looked up once for all is none of it. Each is more than is ever held: at first, there
    # is less to look at.
    for size in (512, 768, 1024):
        cost(size)
    small, middle, large = cost(512), cost(768), cost(1024)

    assert large <= CALLS_PER_BYTE * 1024
    # At the end of the line, one more beginning may be left than at that of another.
    assert large - middle <= 1.05 * (middle - small) + 100


@given(
    st.lists(st.sampled_from(HEADS) | st.binary(max_size=4), min_size=1, max_size=4).map(b"".join),
    directions,
    st.sampled_from(CUTS),
)
def test_no_pattern_is_found_that_costs_more(
    pattern: bytes, direction: Direction | None, cut: Callable[[bytes], list[bytes]]
) -> None:
    line = ((pattern or b"\0") * 1200)[:1200]
    chunks = cut(line)

    assert calls(lambda: read(direction, chunks)) <= CALLS_PER_BYTE * len(line) + 200
