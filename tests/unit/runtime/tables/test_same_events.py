"""Tables hold exactly the events of the stream decoder, however hostile the line is."""

import busservo
import pytest
from busservo import Direction, strategies
from framegen.model.stream import ReferenceDecoder
from hypothesis import example, given
from hypothesis import strategies as st

from tests import oracle
from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.protocols.libraries import direction_of
from tests.strategies import DIRECTIONS, directions, oracles, pieces
from tests.strategies import lines as servo_lines
from tests.unit.runtime.tables.hostile import hostile_lines
from tests.unit.runtime.tables.rows import places_of_reference, rows_in_tables, rows_of_decoder

# What no frame begins with, and enough of it: behind it, a line is decided without its end.
FILLER = bytes(600)
blocks = st.sampled_from([1, 2, 7, 64, 600, 1 << 20])


def holding(inner: bytes) -> bytes:
    """Return a move whose time and targets are these bytes, and what they lack as zeros."""
    count = max(1, -(-(len(inner) - 2) // 3))
    payload = inner.ljust(2 + 3 * count, b"\0")
    return bytes([0x55, 0x55, 5 + 3 * count, 3, count]) + payload


# Frames in frames, and heads of frames that reach behind the end of the one that holds them.
inner = st.sampled_from(
    [
        *map(bytes.fromhex, ("55 55 02 07", "55 55 05 06 08 01 00", "55 55 02 0F", "55 55 02 63")),
        *(bytes([0x55, 0x55, 5 + 3 * count, 3, count]) for count in (1, 2, 3)),
        *map(bytes.fromhex, ("55", "55 55", "55 55 0A", "55 55 05 63", "07", "00", "02 07")),
    ]
)
nests = st.recursive(
    st.lists(inner, max_size=6).map(b"".join),
    lambda held: st.lists(held.map(lambda data: holding(data[:240])) | inner, max_size=4).map(
        b"".join
    ),
    max_leaves=8,
)

servo_frames = strategies.messages().map(busservo.Message.encode)
hostile = servo_lines | hostile_lines(busservo, servo_frames) | nests
tails = st.sampled_from([b"", FILLER])


@given(st.lists(hostile, max_size=3).map(b"".join), tails, directions, blocks)
@example(b"\x55" * 700, b"", None, 7)
@example(b"\x55\x55\x02" * 300, b"", Direction.HOST_TO_CONTROLLER, 64)
@example(b"\x55\x55\xff" * 300, FILLER, None, 600)
@example(b"\x55\x55\x30\x63" * 200, FILLER, Direction.CONTROLLER_TO_HOST, 600)
def test_tables_hold_what_the_decoder_finds(
    line: bytes, tail: bytes, direction: Direction | None, block: int
) -> None:
    line += tail
    found = rows_in_tables(busservo, line, direction, block=block)
    assert found == rows_of_decoder(busservo, line, direction)


@given(hostile, directions, st.data())
def test_they_hold_it_however_the_decoder_is_fed(
    line: bytes, direction: Direction | None, data: st.DataObject
) -> None:
    line += FILLER
    chunks = data.draw(pieces(line))
    expected = rows_of_decoder(busservo, line, direction, chunks)
    assert rows_in_tables(busservo, line, direction, block=600) == expected


@given(hostile, tails, directions)
def test_they_hold_what_the_reference_finds(
    line: bytes, tail: bytes, direction: Direction | None
) -> None:
    line += tail
    model = compiled_file(BUSSERVO).model
    ways = [each for each in model.directions if direction in (None, direction_of(busservo, each))]
    found = [row.place for row in rows_in_tables(busservo, line, direction, block=100)]
    assert found == places_of_reference(ReferenceDecoder(model, ways).decode(line))


@given(hostile, tails, directions)
def test_they_hold_the_messages_of_the_oracle(
    line: bytes, tail: bytes, direction: Direction | None
) -> None:
    rows = rows_in_tables(busservo, line + tail, direction)
    at, expected = 0, []
    for event in oracle.scan(line + tail, oracles(direction)):
        if isinstance(event, bytes):
            at += len(event)
            continue
        name, fields = event
        size = len(oracle.build(name, fields))
        expected.append((name, at, size, fields))
        at += size
    messages = [row for row in rows if row.table not in ("noise", "unknown")]
    assert [(row.table, row.offset, row.size, row.fields) for row in messages] == expected


STOP, RUN = bytes.fromhex("55 55 02 07"), bytes.fromhex("55 55 05 06 08 01 00")
UNKNOWN = bytes.fromhex("55 55 03 63 2A")
HOST = Direction.HOST_TO_CONTROLLER
SAID = HOST.value
# Typed in by hand: a line with the filler behind it, and what the tables hold in front of that.
WORKED_OUT: list[tuple[bytes, list[tuple[str, int, int, str | None, str | None]]]] = [
    (STOP, [("ActionGroupStop", 0, 4, SAID, None)]),
    (b"\0" + STOP, [("noise", 0, 1, SAID, "bad header"), ("ActionGroupStop", 1, 4, SAID, None)]),
    # The byte in front of the header is one of a header that is refused.
    (
        b"\x55" + STOP,
        [("noise", 0, 1, SAID, "unknown command"), ("ActionGroupStop", 1, 4, SAID, None)],
    ),
    (
        UNKNOWN + STOP,
        [("unknown", 0, 5, SAID, "unknown command"), ("ActionGroupStop", 5, 4, SAID, None)],
    ),
    # A claim in which a message begins is none.
    (
        bytes.fromhex("55 55 06 63") + STOP,
        [("noise", 0, 4, SAID, "unknown command"), ("ActionGroupStop", 4, 4, SAID, None)],
    ),
    (
        bytes.fromhex("55 55 09 03") + RUN,
        [("noise", 0, 4, SAID, "length mismatch"), ("ActionGroupRun", 4, 7, SAID, None)],
    ),
]


HELD = holding(b"\0\0" + STOP + RUN + STOP)
# The head of a move stands at the end of another one, and what it would hold behind that.
REACHING = holding(b"\0\0\0" + bytes.fromhex("55 55 0B 03 02"))
WORKED_OUT += [
    # A header begins at the end of what is claimed, though nothing comes of it.
    (
        bytes.fromhex("55 55 03 63 55 00") + STOP,
        [("noise", 0, 6, SAID, "unknown command"), ("ActionGroupStop", 6, 4, SAID, None)],
    ),
    # What a frame holds is no event.
    (
        HELD + STOP,
        [
            ("ServoMove", 0, len(HELD), SAID, None),
            ("ActionGroupStop", len(HELD), 4, SAID, None),
        ],
    ),
    (
        REACHING + STOP + STOP,
        [
            ("ServoMove", 0, len(REACHING), SAID, None),
            ("ActionGroupStop", len(REACHING), 4, SAID, None),
            ("ActionGroupStop", len(REACHING) + 4, 4, SAID, None),
        ],
    ),
    # Behind the first claim begins the second, within which nothing does; it reaches further.
    (
        bytes.fromhex("55 55 07 63 00 55 55 04 63") + bytes.fromhex("00 00") + STOP,
        [
            ("unknown", 0, 9, SAID, "unknown command"),
            ("noise", 9, 2, SAID, "bad header"),
            ("ActionGroupStop", 11, 4, SAID, None),
        ],
    ),
]


@in_turn("block", lambda: [1, 5, 600, None])
@in_turn("line, expected", lambda: WORKED_OUT)
def test_they_hold_what_was_worked_out_by_hand(
    line: bytes, expected: list[tuple[str, int, int, str | None, str | None]], block: int | None
) -> None:
    rows = rows_in_tables(busservo, line + FILLER, HOST, block=block)
    *before, last = [row[:5] for row in rows]
    assert before == expected
    assert last == ("noise", len(line), len(FILLER), SAID, "bad header")


def test_a_frame_is_whole_wherever_a_block_ends() -> None:
    frame = busservo.ServoPositions([(servo, 500 + servo) for servo in range(20)]).encode()
    line = UNKNOWN + frame + RUN + STOP + b"\x55\x55" + frame[:-1] + FILLER
    expected = rows_of_decoder(busservo, line, None)
    assert [row.table for row in expected][:4] == [
        "unknown",
        "ServoPositions",
        "ActionGroupRun",
        "ActionGroupStop",
    ]
    for block in (1, 2, 3, 5, 7, *range(60, 75), 119):
        assert rows_in_tables(busservo, line, None, block=block) == expected


@in_turn("before", lambda: range(0, 700, 35))
def test_a_claim_that_holds_a_frame_is_none_wherever_a_block_ends(before: int) -> None:
    claim = bytes.fromhex("55 55 C6 63") + bytes(192) + STOP
    line = bytes(before) + claim + FILLER
    rows = rows_in_tables(busservo, line, HOST, block=900)
    *head, stop, tail = [row[:3] for row in rows]
    assert (stop, tail) == (
        ("ActionGroupStop", before + 196, 4),
        ("noise", before + 200, len(FILLER)),
    )
    assert {table for table, *_ in head} == {"noise"}


def test_noise_goes_on_behind_a_last_block_that_is_whole() -> None:
    # The block behind it is empty.
    line = STOP + b"\x55\x55\0" + bytes(1193)
    rows = [row[:5] for row in rows_in_tables(busservo, line, HOST, block=600)]
    assert rows == [
        ("ActionGroupStop", 0, 4, SAID, None),
        ("noise", 4, 1196, SAID, "length mismatch"),
    ]


@pytest.mark.parametrize("direction", DIRECTIONS, ids=str)
def test_long_noise_is_one_row_of_each_reason(direction: Direction | None) -> None:
    noise = b"\0" * 300_000 + b"\x55\x55\0" * 100_000
    rows = rows_in_tables(busservo, noise + STOP, direction, block=65536)
    said = None if direction is None else direction.value
    assert [row[:5] for row in rows[:2]] == [
        ("noise", 0, 300_000, said, "bad header"),
        ("noise", 300_000, 300_000, said, "length mismatch"),
    ]
    assert sum(row.size for row in rows) == len(noise) + len(STOP)
