"""The reference stream decoder: its rules, one line of bytes each, worked out by hand."""

from framegen.language.values import Direction
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, compiled_file
from tests.in_turn import in_turn

SERVO = compiled_file(BUSSERVO).model
HOST = ReferenceDecoder(SERVO, [Direction("host", "controller")])
SMALL = ReferenceDecoder(SERVO, [Direction("host", "controller")], max_frame=64)
BOTH = ReferenceDecoder(SERVO, SERVO.directions)

HOUSE = ReferenceDecoder(compiled_file(DEMO).model, [Direction("gateway", "station")])
TIGHT = ReferenceDecoder(HOUSE.model, HOUSE.directions, max_frame=8)

STOP = "55550207"
# A line, its bytes, and what they are: a message by name, else `?` or the reason, and the bytes.
LINES: list[tuple[ReferenceDecoder, str, list[tuple[str, str]]]] = [
    (HOST, "", []),
    (HOST, STOP + STOP, [("ActionGroupStop", STOP)] * 2),
    # Bytes without a header are one piece, and a refused header costs one byte.
    (HOST, "0013" + STOP, [("bad header", "0013"), ("ActionGroupStop", STOP)]),
    (HOST, "55" + STOP, [("unknown command", "55"), ("ActionGroupStop", STOP)]),
    (HOST, "5555FF" + STOP, [("unknown command", "5555ff"), ("ActionGroupStop", STOP)]),
    # Each refused header begins a piece; those of one reason are joined.
    (
        HOST,
        "00555500111155550022",
        [("bad header", "00"), ("length mismatch", "555500111155550022")],
    ),
    (HOST, "5555005555FF63", [("length mismatch", "555500"), ("unknown command", "5555ff63")]),
    # The end of a line: what was waited for is too short, and a begun header is none.
    (HOST, "5555", [("too short", "5555")]),
    (HOST, "55", [("bad header", "55")]),
    (HOST, "5555080301E80301", [("too short", "5555080301e80301")]),
    (HOST, "5555080301" + STOP, [("too short", "5555080301"), ("ActionGroupStop", STOP)]),
    # An unknown frame is shown where all of it came and nothing in it may begin a frame, ...
    (HOST, "555504630102" + STOP, [("?", "555504630102"), ("ActionGroupStop", STOP)]),
    (HOST, "555502630055", [("?", "55550263"), ("bad header", "0055")]),
    # ... which it may not where it is cut short, holds a frame, or ends as a header begins.
    (HOST, "5555046301", [("unknown command", "5555046301")]),
    (HOST, "55550663" + STOP, [("unknown command", "55550663"), ("ActionGroupStop", STOP)]),
    (HOST, "5555036355" + "00", [("unknown command", "555503635500")]),
    (HOST, "555504635555" + "0207", [("unknown command", "55550463"), ("ActionGroupStop", STOP)]),
    # A claim within one that is none is judged by its own bytes, too.
    (
        HOST,
        "55550A63" + "5555026300000000"[:8],
        [("unknown command", "55550a63"), ("?", "55550263")],
    ),
    # What is larger than there is room for is refused by its length, known or not.
    (SMALL, "55553F63" + STOP, [("length mismatch", "55553f63"), ("ActionGroupStop", STOP)]),
    (SMALL, "555541031355", [("length mismatch", "555541031355")]),
    # Where the id comes first, it is unknown before the length is there, which still has a say.
    (HOUSE, "C35AA577", [("unknown command", "c35aa577")]),
    (HOUSE, "C35AA57700020000", [("?", "c35aa57700020000")]),
    (HOUSE, "C35AA577FFFF0000", [("unknown command", "c35aa577ffff0000")]),
    (TIGHT, "C35AA57700020000", [("?", "c35aa57700020000")]),
    (TIGHT, "C35AA5770003000000", [("unknown command", "c35aa5770003000000")]),
    # With both ends received, an id is unknown only where neither sends it.
    (BOTH, "55550208" + "55550408", [("length mismatch", "5555020855550408")]),
    (BOTH, "5555040FC91E", [("BatteryVoltage", "5555040fc91e")]),
]


@in_turn("line, text, expected", lambda: LINES)
def test_a_stream_gives_its_events(
    line: ReferenceDecoder, text: str, expected: list[tuple[str, str]]
) -> None:
    events = line.decode(bytes.fromhex(text))
    assert [
        (
            event.message.name
            if event.message
            else "?"
            if event.kind == "unknown"
            else event.reason,
            event.data.hex(),
        )
        for event in events
    ] == expected
    assert [event.at for event in events] == [
        len(b"".join(each.data for each in events[:number])) for number in range(len(events))
    ]


@in_turn(
    "line, text, held",
    lambda: [
        (HOST, STOP, 0),
        (HOST, "00", 0),
        (HOST, "0055", 1),
        (HOST, "00555502", 3),
        (HOST, "5555080301E803", 7),
        # A claim waits for all of its bytes, unless a frame in it is there already.
        (HOST, "5555046301", 5),
        (HOST, "555504630102", 0),
        (HOST, "55550A635555", 6),
        (HOST, "55550A63" + STOP, 0),
        (HOST, "55550A63" + STOP + "55", 1),
        (HOUSE, "C35AA577", 4),
    ],
)
def test_what_may_become_a_frame_is_held(line: ReferenceDecoder, text: str, held: int) -> None:
    data = bytes.fromhex(text)
    events = line.decode_so_far(data)
    assert b"".join(event.data for event in events) == data[: len(data) - held]


heads = st.sampled_from(["55", "5555", "555502", "55550263", "55550463", "5555FF63", STOP, "00"])
texts = st.lists(heads, max_size=10).map("".join).map(bytes.fromhex)


@given(st.sampled_from([HOST, SMALL, BOTH]), texts, texts)
def test_reported_events_stand_whatever_follows(
    line: ReferenceDecoder, begun: bytes, rest: bytes
) -> None:
    early = line.decode_so_far(begun)
    messages = [(event.at, event.data) for event in early if event.kind != "noise"]
    for whole in line.decode(begun + rest), line.decode_so_far(begun + rest):
        later = [(event.at, event.data) for event in whole if event.kind != "noise"]
        assert later[: len(messages)] == messages
    held = len(begun) - sum(len(event.data) for event in early)
    assert 0 <= held <= SERVO.largest(line.directions)
