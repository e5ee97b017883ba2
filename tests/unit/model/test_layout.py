"""The layout of a spec: offsets, lengths and times, against numbers calculated by hand."""

from typing import Any, NamedTuple

import pytest
from framegen.language.spec import Concern, Spec
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, Unencodable, decode, encode
from framegen.model.envelope import derive_envelope
from framegen.model.facts import NoSuchFact, look_up
from framegen.model.layout import MessageLayout
from framegen.model.model import Model, derive
from framegen.model.slots import Items, Number
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, data_of, layout_of
from tests.in_turn import in_turn
from tests.mutations.places import having

SPECS = {"busservo": data_of(BUSSERVO), "greenhouse": data_of(DEMO)}
LAYOUTS = {name: layout_of(data) for name, data in SPECS.items()}
SERVO = LAYOUTS["busservo"]
HOUSE = LAYOUTS["greenhouse"]
HOST = Direction("host", "controller")
CONTROLLER = Direction("controller", "host")


class Row(NamedTuple):
    """A line of the protocol document, as numbers: from the header's first byte on."""

    id: int
    sender: str
    offsets: dict[str, int]
    lengths: list[int]
    largest: int
    kind: str


# The command is byte 3 and the first parameter byte 4; the length counts the parameters and two
# more, and no length is above 255.
GROUP, IDS = {"group": 4, "times": 5}, {"servo_count": 4, "servo_ids": 5}
PLACES = {"servo_count": 4, "positions": 5}
MOVE = {"servo_count": 4, "time_ms": 5, "targets": 7}
DOCUMENT = {
    "ServoMove": Row(3, "host", MOVE, [*range(8, 255, 3)], 256, "command"),
    "ActionGroupRun": Row(6, "host", GROUP, [5], 7, "command"),
    "ActionGroupStop": Row(7, "host", {}, [2], 4, "command"),
    "ActionGroupSpeed": Row(11, "host", {"group": 4, "percent": 5}, [5], 7, "command"),
    "BatteryVoltageRead": Row(15, "host", {}, [2], 4, "query"),
    "ServoUnload": Row(20, "host", IDS, [*range(4, 256)], 257, "command"),
    "ServoPositionsRead": Row(21, "host", IDS, [*range(4, 256)], 257, "query"),
    "ActionGroupStarted": Row(6, "controller", GROUP, [5], 7, "report"),
    "ActionGroupStopped": Row(7, "controller", {}, [2], 4, "report"),
    "ActionGroupCompleted": Row(8, "controller", GROUP, [5], 7, "report"),
    "BatteryVoltage": Row(15, "controller", {"voltage_mv": 4}, [4], 6, "reply"),
    "ServoPositions": Row(21, "controller", PLACES, [*range(3, 256, 3)], 257, "reply"),
}


@in_turn("name", lambda: DOCUMENT)
def test_a_message_lies_as_the_document_has_it(name: str) -> None:
    message = SERVO.messages[name]
    offsets = {slot.name: slot.at for slot in message.fields}
    sender, lengths = message.direction.sender, [*message.lengths]
    found = Row(message.id, sender, offsets, lengths, message.largest, SERVO.kind(name))
    assert found == DOCUMENT[name]


def test_a_list_ends_where_the_number_of_its_bytes_does() -> None:
    data = data_of(DEMO)
    readings = data["messages"]["StationState"]["fields"]["readings"]
    readings["sized_by"] = readings.pop("counted_by")
    state = derive(Spec.model_validate(data)).messages["StationState"]
    assert state.counts == range(128)
    frame = encode(state, {"uptime_s": 0, "readings": [-1] * 127})
    assert frame == bytes.fromhex("C3 5A A5 11 01 03 00 00 00 00 FE") + 254 * b"\xff"


def test_the_frame_of_bus_servos() -> None:
    frame = SERVO.frame
    assert frame.header == b"\x55\x55"
    parts = [(each.name, each.at, each.number_type.name) for each in (frame.length, frame.id)]
    assert parts == [("length", 2, "u8"), ("command", 3, "u8")]
    assert (frame.body_at, frame.uncounted, frame.counted) == (4, 2, 2)
    assert frame.legal_ids == range(256)


def test_the_frame_of_the_greenhouse() -> None:
    frame = HOUSE.frame
    assert frame.header == b"\xc3\x5a\xa5"
    assert (frame.id.at, frame.length.at, frame.body_at) == (3, 4, 6)
    assert (frame.uncounted, frame.counted) == (6, 0)
    assert HOUSE.messages["VentsOpen"].largest == 33
    assert HOUSE.messages["StationState"].largest == 521


def test_a_header_may_be_written_in_parts() -> None:
    whole = SPECS["greenhouse"]["frame"]
    parts = {"first": {**whole["preamble"], "bytes": "C3"}}
    parts |= {"rest": {**whole["preamble"], "bytes": "5A A5"}, **whole}
    del parts["preamble"]
    parted = layout_of({**SPECS["greenhouse"], "frame": parts})
    assert parted.frame.header == HOUSE.frame.header
    example = SPECS["greenhouse"]["messages"]["VentsOpen"]["examples"][0]
    data = bytes.fromhex(example["hex"])
    message = parted.messages["VentsOpen"]
    assert encode(message, example["values"]) == data
    assert decode(parted, message.direction, data).values == example["values"]


def test_a_frame_takes_its_time_on_the_line() -> None:
    """9600 8N1 is 960 bytes a second; 19200 8E2 has twelve bits a byte."""
    move = SERVO.messages["ServoMove"]
    assert move.wire_seconds(25) == pytest.approx(0.02604, abs=1e-5)
    assert move.wire_seconds(11 + 23) == pytest.approx(0.0354, abs=1e-4)
    assert move.wire_seconds(move.largest) == pytest.approx(256 / 960)
    assert HOUSE.messages["StationRead"].wire_seconds(6) == pytest.approx(6 * 12 / 19200)


@pytest.mark.parametrize(
    ("link", "bits"),
    [
        ({}, 10),
        ({"data_bits": 7}, 9),
        ({"parity": "odd"}, 11),
        ({"parity": "even", "stop_bits": 2}, 12),
        ({"data_bits": 5, "stop_bits": 2}, 8),
    ],
)
def test_a_byte_has_its_start_parity_and_stop_bits(link: dict[str, Any], bits: int) -> None:
    data = {**SPECS["busservo"], "link": {"baud": 9600, **link}}
    assert layout_of(data).spec.link.bits_per_byte == bits


def test_every_slot_of_a_frame_has_its_place() -> None:
    placed = SERVO.messages["ServoMove"].lay_out(2)
    assert " ".join(f"{each.path}:{each.at}+{each.size}" for each in placed) == (
        "header:0+2 length:2+1 command:3+1 servo_count:4+1 time_ms:5+2 targets[0].servo_id:7+1"
        " targets[0].position:8+2 targets[1].servo_id:10+1 targets[1].position:11+2"
    )
    placed = HOUSE.messages["StationState"].lay_out(2)
    assert " ".join(f"{each.path}:{each.at}" for each in placed) == (
        "preamble:0 kind:3 size:4 uptime_s:6 reading_count:10 readings[0]:11 readings[1]:13"
    )
    roles = [slot.role for slot in SERVO.messages["ActionGroupStop"].slots]
    assert roles == ["constant", "length", "id"]


def test_what_stands_behind_the_body_counts_from_the_end() -> None:
    envelope = SERVO.lookalikes["lx16a"]
    assert " ".join(f"{slot.name}:{slot.at}" for slot in envelope.slots) == (
        "header:0 servo_id:2 length:3 command:4 parameters:5 checksum:-1"
    )
    placed = {each.path: (each.at, each.size) for each in envelope.lay_out(10)}
    assert (placed["parameters"], placed["checksum"]) == ((5, 4), (9, 1))
    assert (envelope.least, envelope.uncounted) == (6, 3)
    assert [slot.name for slot in envelope.tail] == ["checksum"]


def test_a_number_is_read_where_it_stands() -> None:
    move, lookalike = SERVO.messages["ServoMove"], SERVO.lookalikes["lx16a"]
    frame = bytes.fromhex("55 55 08 03 01 E8 03 09 D0 07")
    read = [slot.read_in(frame) for slot in move.slots if isinstance(slot, Number)]
    assert read == [8, 3, 1, 1000]
    *_, checksum = lookalike.slots
    assert isinstance(checksum, Number)
    assert checksum.read_in(bytes.fromhex("55 55 01 03 1C DF")) == 0xDF
    time = move.slots[4]
    assert isinstance(time, Number)
    assert [size for size in range(len(frame)) if time.is_in(frame[:size])] == [7, 8, 9]
    # Where bytes are cut short, nobody knows how far off their end is.
    assert not checksum.is_in(bytes.fromhex("55 55 01 03 1C DF"))


def every_message() -> list[Any]:
    return [
        pytest.param(message, id=f"{house} {name}")
        for house, layout in LAYOUTS.items()
        for name, message in layout.messages.items()
    ]


@in_turn("message", every_message)
def test_the_slots_of_each_legal_frame_fill_it_with_no_gap_or_overlap(
    message: MessageLayout,
) -> None:
    for count in message.counts:
        laid_out = message.lay_out(count)
        taken = [byte for placed in laid_out for byte in range(placed.at, placed.end)]
        assert taken == list(range(message.size_at(count)))


@in_turn("message", every_message)
def test_each_legal_length_has_one_count_and_each_count_one_length(message: MessageLayout) -> None:
    lengths = [message.formula.at(count) for count in message.counts]
    assert lengths == list(message.lengths)
    assert [message.formula.count_at(length) for length in lengths] == list(message.counts)
    assert message.lengths[-1] <= message.frame.length.high
    largest = encode(message, _values(message, message.counts[-1]))
    assert (message.largest, message.counts[-1]) == (len(largest), message.count_of(largest))


def _values(message: MessageLayout, count: int) -> dict[str, Any]:
    values: dict[str, Any] = {}
    for slot in message.arguments:
        if isinstance(slot, Number):
            values[slot.name] = slot.low
            continue
        assert isinstance(slot, Items)
        numbers = {field.name: field.high for field in slot.fields if isinstance(field, Number)}
        one = numbers if slot.element else next(iter(numbers.values()))
        values[slot.name] = [one] * count
    return values


def test_what_a_user_gives_is_everything_but_the_count() -> None:
    names = ("ServoMove", "ServoPositions", "ActionGroupRun", "ActionGroupStop")
    given_ = [[argument.name for argument in SERVO.messages[name].arguments] for name in names]
    assert given_ == [["time_ms", "targets"], ["positions"], ["group", "times"], []]


def test_a_field_is_narrowed_by_a_range_of_its_own() -> None:
    numbers = HOUSE.messages["VentsOpen"].numbers_by_path
    vent_id, angle = numbers["vents.vent_id"], numbers["vents.angle"]
    assert (vent_id.low, vent_id.high, vent_id.narrowed) == (0, 255, False)
    assert (angle.low, angle.high, angle.narrowed) == (-900, 900, True)
    for message in SERVO.messages.values():
        assert not any(number.narrowed for number in message.numbers_by_path.values())


@pytest.mark.parametrize(
    ("declared", "low", "high"),
    [(None, 0, 65535), ("5..", 5, 65535), ("0..7", 0, 7), ("0..65535", 0, 65535)],
)
def test_an_open_range_ends_where_the_type_does(declared: str | None, low: int, high: int) -> None:
    place = "messages.BatteryVoltage"
    voltage = {"type": "u16", "about": "It.", **({"range": declared} if declared else {})}
    shown = {"title": "An end", "constructed": "By hand."}
    ends = {end: f"55 55 04 0F {end.to_bytes(2, 'little').hex(' ')}" for end in (low, high)}
    examples = [{**shown, "hex": h, "values": {"voltage_mv": end}} for end, h in ends.items()]
    said = {f"{place}.fields": {"voltage_mv": voltage}, f"{place}.examples": examples}
    layout = layout_of(having(SPECS["busservo"], said))
    field = layout.messages["BatteryVoltage"].numbers_by_path["voltage_mv"]
    assert (field.low, field.high) == (low, high)
    assert field.narrowed == ((low, high) != (0, 65535))


def test_directions_come_in_the_order_in_which_they_first_appear() -> None:
    assert SERVO.directions == [HOST, CONTROLLER]
    ways = ["gateway -> station", "station -> gateway", "gateway -> display"]
    assert [str(way) for way in HOUSE.directions] == ways
    for way in (HOST, CONTROLLER):
        sent = SERVO.sent(way)
        documented = {row.id for row in DOCUMENT.values() if row.sender == way.sender}
        assert documented <= {message.id for message in sent}
        assert {message.direction for message in sent} == {way}
    assert list(SERVO.sent(Direction("host", "host"))) == []


@pytest.mark.parametrize(("gone", "kind"), [("length", "length"), ("command", "id")])
def test_who_wants_a_length_or_an_id_asks_first_whether_there_is_one(gone: str, kind: str) -> None:
    spec = Spec.model_validate(SPECS["busservo"])
    parts = {name: part for name, part in spec.envelopes["frame"].items() if name != gone}
    envelope = derive_envelope(parts, "little")
    assert (envelope.length_part is None, envelope.id_part is None) == (
        kind == "length",
        kind == "id",
    )
    with pytest.raises(AssertionError, match=f"^frames of frame have no {kind}$"):
        assert envelope.length is not envelope.id


# ------------------------------------------------------------------ the reference codec


FAR = {"servo_id": 1, "position": 70000}
KEYS, OUTSIDE = "targets[0] must have the keys servo_id, ", "is outside 0..65535"


@in_turn(
    "name, values, said",
    lambda: [
        ("ServoMove", {"targets": []}, "`time_ms` is missing"),
        ("ServoMove", {"time_ms": 1, "targets": [], "x": 1}, "ServoMove has no field `x`"),
        ("ServoMove", {"time_ms": 1, "targets": {}}, "targets must be a list"),
        ("ServoMove", {"time_ms": 1, "targets": []}, "targets: 0 items is outside 1..83"),
        ("ServoMove", {"time_ms": 1, "targets": [5]}, f"{KEYS}position"),
        ("ServoMove", {"time_ms": 1, "targets": [{"servo_id": 1}]}, f"{KEYS}position"),
        ("ServoMove", {"time_ms": 1, "targets": [FAR]}, f"targets[0].position: 70000 {OUTSIDE}"),
        ("ServoUnload", {"servo_ids": [1, 256]}, "servo_ids[1]: 256 is outside 0..255"),
        ("ServoUnload", {"servo_ids": [True]}, "servo_ids[0]: True is not a whole number"),
        ("ActionGroupRun", {"group": "1", "times": 0}, "group: '1' is not a whole number"),
        ("ActionGroupRun", {"group": 1, "times": -1}, f"times: -1 {OUTSIDE}"),
    ],
)
def test_the_reference_codec_refuses_what_no_frame_can_carry(
    name: str, values: dict[str, Any], said: str
) -> None:
    with pytest.raises(Unencodable) as refused:
        encode(SERVO.messages[name], values)
    assert str(refused.value).startswith(said)


@given(st.sampled_from(list(LAYOUTS)), st.data())
def test_what_the_reference_codec_accepts_it_writes_again(house: str, data: st.DataObject) -> None:
    layout = LAYOUTS[house]
    way = data.draw(st.sampled_from(layout.directions))
    message = data.draw(st.sampled_from(layout.sent(way)))
    count = data.draw(st.integers(message.counts[0], min(message.counts[-1], 5)))
    frame = bytearray(encode(message, _values(message, count)))
    for _ in range(data.draw(st.integers(0, 3))):
        frame[data.draw(st.integers(0, len(frame) - 1))] = data.draw(st.integers(0, 255))
    try:
        decoded = decode(layout, way, bytes(frame))
    except NotAFrame as error:
        offset = error.offset
    else:
        offset = 0
        assert encode(decoded.layout, decoded.values) == frame
    assert 0 <= offset <= len(frame)


@in_turn(
    "message, parameter, said",
    lambda: [
        ("ServoMove", 1, "servo_count"),
        ("ServoMove", 3, "time_ms, high byte"),
        ("ServoMove", 5, "targets[0].position, low byte"),
        ("ServoUnload", 3, "servo_ids[1]"),
        ("ActionGroupRun", 4, "ActionGroupRun has no parameter byte 4: it has 3 at most"),
        ("ServoUnload", 254, "ServoUnload has no parameter byte 254: it has 253 at most"),
        ("ActionGroupStop", 1, "ActionGroupStop has no parameter byte 1: it has 0 at most"),
    ],
)
def test_a_parameter_is_named_by_its_number(message: str, parameter: int, said: str) -> None:
    concern = Concern.model_validate({"message": message, "parameter": parameter})
    try:
        found = str(look_up(SERVO, concern))
    except NoSuchFact as error:
        found = str(error)
    assert found == said


@pytest.mark.parametrize("model", LAYOUTS.values(), ids=LAYOUTS)
def test_a_model_is_shown_by_its_name_and_never_whole(model: Model) -> None:
    shown = [repr(model), *map(repr, model.messages.values()), repr(model.exchanges[0])]
    assert max(map(len, shown)) < 2_000
