"""The library of another protocol, with all features of the language, against the reference."""

import doctest
import importlib
import io
import itertools
import json
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any

import pytest
from framegen.cases.valid import valid_frames
from framegen.compile import Compiled
from framegen.language.number_types import NUMBER_TYPES
from framegen.model import codec
from framegen.model.codec import NotAFrame
from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.slots import Items, Number, Slot
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import (
    DEMO,
    ROOT,
    Data,
    compiled_of,
    data_of,
    files_of,
    kiln,
    layout_of,
    library,
    library_files,
    rules_broken,
    vectors_of,
    write_files,
)
from tests.in_turn import in_turn

SPEC = data_of(DEMO)
LAYOUT = layout_of(SPEC)


@pytest.fixture(scope="module", autouse=True)
def greenhouse() -> Iterator[ModuleType]:
    """Return the library, imported under its own name."""
    with library(files_of(SPEC)) as made:
        yield made


def lib() -> Any:
    """Return the same, for Hypothesis, which takes no fixtures."""
    return importlib.import_module("greenhouse")


def test_what_an_end_sends_to_two_others_is_read_back(greenhouse: ModuleType) -> None:
    """A recording says who has sent a line, and not to whom."""
    recordings: Any = importlib.import_module("greenhouse.recordings")
    sent = [
        (layout.direction, bytes.fromhex(example["hex"]))
        for name, layout in LAYOUT.messages.items()
        for example in SPEC["messages"][name]["examples"]
    ]
    lines = (f"{frame.hex(' ')}  # 0.5 s, {way.sender}: a\n" for way, frame in sent)
    entries = [*recordings.read(io.BytesIO("".join(lines).encode()))]
    assert [each.event.encode() for each in entries] == [frame for _, frame in sent]
    assert [each.direction.value for each in entries] == [way.key for way, _ in sent]
    raw = recordings.read(
        io.BytesIO(b"\0"), form="raw", direction=greenhouse.Direction(sent[0][0].key)
    )
    assert [each.direction.value for each in raw] == [sent[0][0].key]


def test_a_direction_is_asked_for_by_both_ends_where_one_sends_in_two(
    capsys: pytest.CaptureFixture[str],
) -> None:
    command: Any = importlib.import_module("greenhouse._cli")
    for way, found in (("gateway_to_station", "1 message"), ("gateway_to_display", "0 messages")):
        assert command.main(["decode", "--direction", way, example_of("VentsOpen")]) == 0
        assert f": {found}," in capsys.readouterr().err
    assert command.main(["decode", "--direction", "gateway", "00"]) == 2
    assert "invalid choice: 'gateway'" in capsys.readouterr().err


def test_parts_of_frames_are_called_as_the_author_calls_them(greenhouse: ModuleType) -> None:
    unknown = greenhouse.UnknownFrame(bytes.fromhex("C3 5A A5 FF 00 01 2A"), None)
    assert unknown.numbers == {"kind": 255}
    message = greenhouse.VentsOpen.decode(bytes.fromhex(example_of("VentsOpen")))
    parts: Any = importlib.import_module("greenhouse._frame.parts")
    names = [name for _, name, _ in parts.message_parts(message)]
    assert names[:3] == [name for name in SPEC["frame"] if name != "payload"]


def example_of(name: str) -> str:
    hex_: str = SPEC["messages"][name]["examples"][0]["hex"]
    return hex_


# ------------------------------------------------------------------ values, both ways


def numbers(field: Slot) -> st.SearchStrategy[int]:
    assert isinstance(field, Number)
    ends = [field.low, field.low + 1, field.high - 1, field.high, 0, 1, -1]
    legal = [end for end in ends if field.low <= end <= field.high]
    return st.sampled_from(legal) | st.integers(field.low, field.high)


def items(listed: Items) -> st.SearchStrategy[Any]:
    if listed.element is None:
        return numbers(listed.fields[0])
    names = [field.name for field in listed.fields]
    return st.tuples(*map(numbers, listed.fields)).map(
        lambda item: dict(zip(names, item, strict=True))
    )


def values_of(message: MessageLayout) -> st.SearchStrategy[dict[str, Any]]:
    return st.fixed_dictionaries(
        {
            argument.name: st.lists(items(argument), min_size=argument.low, max_size=8)
            if isinstance(argument, Items)
            else numbers(argument)
            for argument in message.arguments
        }
    )


def frames(model: Model = LAYOUT) -> st.SearchStrategy[tuple[MessageLayout, dict[str, Any]]]:
    return st.sampled_from(list(model.messages.values())).flatmap(
        lambda message: st.tuples(st.just(message), values_of(message))
    )


def arguments(values: dict[str, Any]) -> dict[str, Any]:
    """Return values of the reference codec as arguments of the library: elements as tuples."""
    return {
        name: [tuple(item.values()) if isinstance(item, dict) else item for item in value]
        if isinstance(value, list)
        else value
        for name, value in values.items()
    }


def said_by(message: Any) -> dict[str, Any]:
    """Return the fields of a message, comparable with `arguments`."""
    fields = {name: getattr(message, name) for name in message.__match_args__}
    return {
        name: [tuple(item) if isinstance(item, tuple) else item for item in value]
        if isinstance(value, tuple)
        else value
        for name, value in fields.items()
    }


def direction_of(message: MessageLayout) -> Any:
    return lib().Direction(message.direction.key)


@given(frames())
def test_it_encodes_as_the_reference_codec_does(
    case: tuple[MessageLayout, dict[str, Any]],
) -> None:
    message, values = case
    kind = getattr(lib(), message.name)
    made = kind(**arguments(values))
    frame = codec.encode(message, values)
    assert made.encode() == frame
    assert lib().decode(frame, direction_of(message)) == made == kind.decode(frame)
    assert said_by(kind.decode(frame)) == arguments(values)


def result_here(data: bytes, direction: Any) -> tuple[Any, ...]:
    try:
        message = lib().decode(data, direction)
    except lib().DecodeError as error:
        return error.reason.value, error.offset
    return type(message).__name__, said_by(message)


def result_there(data: bytes, direction: str, model: Model = LAYOUT) -> tuple[Any, ...]:
    [way] = [way for way in model.directions if way.key == direction]
    try:
        decoded = codec.decode(model, way, data)
    except NotAFrame as error:
        return error.reason, error.offset
    return decoded.layout.name, arguments(decoded.values)


@st.composite
def damaged(draw: st.DrawFn) -> bytes:
    message, values = draw(frames())
    data = bytearray(codec.encode(message, values))
    for _ in range(draw(st.integers(0, 3))):
        at = draw(st.integers(0, len(data)))
        kind = draw(st.sampled_from(["flip", "cut", "insert", "step", "end"]))
        if kind == "insert":
            data[at:at] = draw(st.binary(min_size=1, max_size=3))
        elif kind == "end":
            del data[at:]
        elif at < len(data):
            if kind == "cut":
                del data[at]
            elif kind == "flip":
                data[at] ^= draw(st.integers(1, 255))
            else:
                data[at] = (data[at] + draw(st.sampled_from([-1, 1]))) & 0xFF
    return bytes(data)


@given(damaged(), st.sampled_from([way.key for way in LAYOUT.directions]))
def test_it_refuses_what_the_reference_codec_refuses_and_says_the_same(
    data: bytes, direction: str
) -> None:
    assert result_here(data, lib().Direction(direction)) == result_there(data, direction)


@given(st.binary(max_size=30), st.sampled_from([way.key for way in LAYOUT.directions]))
def test_on_any_bytes_both_agree(data: bytes, direction: str) -> None:
    for bytes_ in (data, LAYOUT.frame.header + data):
        assert result_here(bytes_, lib().Direction(direction)) == result_there(bytes_, direction)


@given(frames())
def test_every_byte_of_a_frame_matters(case: tuple[MessageLayout, dict[str, Any]]) -> None:
    """Cut short anywhere and changed anywhere, both codecs agree on what is left."""
    message, values = case
    frame = codec.encode(message, values)
    direction = direction_of(message)
    for at in range(min(len(frame), 24)):
        for data in (frame[:at], frame[:at] + bytes([frame[at] ^ 0x81]) + frame[at + 1 :]):
            assert result_here(data, direction) == result_there(data, message.direction.key)


def test_it_refuses_every_bad_vector_for_the_reason_given() -> None:
    vectors = vectors_of(compiled_of(SPEC))
    assert len(vectors["valid"]) >= 13
    for vector in vectors["valid"]:
        frame = bytes.fromhex(vector["hex"])
        expected = vector["message"], arguments(vector["fields"])
        assert result_here(frame, lib().Direction(vector["direction"])) == expected
    reasons = set()
    for vector in vectors["invalid"]:
        frame = bytes.fromhex(vector["hex"])
        expected = vector["reason"], vector["offset"]
        assert result_here(frame, lib().Direction(vector["direction"])) == expected, vector
        reasons.add(vector["reason"])
    assert reasons == {reason.value for reason in lib().Reason}


# ------------------------------------------------------------------ facts, by hand

# A message, its frame worked out on paper, and who sends it.
BY_HAND: list[tuple[str, dict[str, Any], str, str]] = [
    ("StationRead", {}, "C3 5A A5 11 00 00", "GATEWAY_TO_STATION"),
    ("VentJammed", {"vent_id": 255, "trim": -128}, "C3 5A A5 12 00 02 FF 80", "STATION_TO_GATEWAY"),
    ("TextShow", {"number": -(2**31)}, "C3 5A A5 10 00 04 80 00 00 00", "GATEWAY_TO_DISPLAY"),
    ("TextShow", {"number": 0x01020304}, "C3 5A A5 10 00 04 01 02 03 04", "GATEWAY_TO_DISPLAY"),
    (
        "VentsOpen",
        {"ramp_s": 0x1234, "vents": [(7, -900), (8, 900), (9, -1)]},
        "C3 5A A5 10 00 0C 12 34 03 07 FC 7C 08 03 84 09 FF FF",
        "GATEWAY_TO_STATION",
    ),
    (
        "StationState",
        {"uptime_s": 0xFFFFFFFE, "readings": []},
        "C3 5A A5 11 00 05 FF FF FF FE 00",
        "STATION_TO_GATEWAY",
    ),
    (
        "StationState",
        {"uptime_s": 1, "readings": [-32768, 32767, -2]},
        "C3 5A A5 11 00 0B 00 00 00 01 03 80 00 7F FF FF FE",
        "STATION_TO_GATEWAY",
    ),
]


@pytest.mark.parametrize(("name", "fields", "text", "direction"), BY_HAND)
def test_frames_worked_out_on_paper(
    greenhouse: Any, name: str, fields: dict[str, Any], text: str, direction: str
) -> None:
    frame = bytes.fromhex(text)
    message = getattr(greenhouse, name)(**fields)
    assert message.encode() == frame
    assert direction == message.DIRECTION.name
    assert greenhouse.decode(frame, message.DIRECTION) == message
    assert said_by(message) == fields


def test_each_class_has_its_metadata(greenhouse: Any) -> None:
    facts = {
        kind.__name__: (kind.COMMAND, kind.LENGTHS, kind.__match_args__)
        for kind in greenhouse.MESSAGES
    }
    assert facts == {
        "VentsOpen": (0x10, range(6, 28, 3), ("ramp_s", "vents")),
        "StationRead": (0x11, range(1), ()),
        "StationState": (0x11, range(5, 516, 2), ("uptime_s", "readings")),
        "VentJammed": (0x12, range(2, 3), ("vent_id", "trim")),
        "TextShow": (0x10, range(4, 5), ("number",)),
    }
    assert greenhouse.VentsOpen.RAMP_S_AT_ONCE == 0
    assert greenhouse.Vent.__match_args__ == ("vent_id", "angle")
    assert greenhouse.__doc__.startswith("Greenhouse bus.\n")
    assert "Deprecated: The display reads the bus by itself" in greenhouse.TextShow.__doc__
    assert "Answered by StationState." in greenhouse.StationRead.__doc__


def test_a_field_is_documented_in_one_place(greenhouse: Any) -> None:
    angle = greenhouse.Vent.angle
    assert (angle.at, angle.low, angle.high, angle.unit) == (1, -900, 900, "0.1 degree")
    assert angle.__doc__ == "Where to turn it, downwards below zero."
    ramp = greenhouse.VentsOpen.ramp_s
    assert (ramp.at, ramp.low, ramp.high, ramp.unit) == (6, 0, 65535, "s")
    assert ramp.names == {"at_once": greenhouse.VentsOpen.RAMP_S_AT_ONCE}
    vents = greenhouse.VentsOpen.vents
    assert (vents.at, vents.element, vents.counts) == (9, greenhouse.Vent, range(1, 9))
    assert vents.count is greenhouse.VentsOpen.vent_count
    readings = greenhouse.StationState.readings
    assert (readings.element, readings.fields[0].unit) == (None, "cK")
    assert "A step is 0.01 K." in readings.__doc__
    assert greenhouse.VentsOpen.VENDOR_NAME == ""


def test_an_id_means_what_its_direction_says(greenhouse: Any) -> None:
    """0x10 is sent two ways by one endpoint, and 0x11 by either end of one line."""
    direction = greenhouse.Direction
    assert [way.name for way in direction] == [
        "GATEWAY_TO_STATION",
        "STATION_TO_GATEWAY",
        "GATEWAY_TO_DISPLAY",
    ]
    show = bytes.fromhex("C3 5A A5 10 00 04 FF FF FF FE")
    assert greenhouse.decode(show, direction.GATEWAY_TO_DISPLAY) == greenhouse.TextShow(-2)
    with pytest.raises(greenhouse.DecodeError) as refused:
        greenhouse.decode(show, direction.GATEWAY_TO_STATION)
    assert (refused.value.reason.value, refused.value.offset) == ("length mismatch", 4)
    assert greenhouse.decode(show, None) == greenhouse.TextShow(-2)
    read = greenhouse.StationRead().encode()
    with pytest.raises(greenhouse.DecodeError) as refused:
        greenhouse.decode(read, direction.STATION_TO_GATEWAY)
    assert (refused.value.reason.value, refused.value.offset) == ("length mismatch", 4)
    with pytest.raises(greenhouse.DecodeError) as refused:
        greenhouse.decode(read, direction.GATEWAY_TO_DISPLAY)
    assert (refused.value.reason.value, refused.value.offset) == ("unknown command", 3)
    assert (direction.GATEWAY_TO_DISPLAY.sender, direction.GATEWAY_TO_DISPLAY.receiver) == (
        "gateway",
        "display",
    )


@pytest.mark.parametrize("angle", [-901, 901, -32768, 32767])
def test_a_narrowed_range_is_held_both_ways(greenhouse: Any, angle: int) -> None:
    frame = bytes.fromhex("C3 5A A5 10 00 09 00 00 02 01 00 00 02") + angle.to_bytes(
        2, "big", signed=True
    )
    with pytest.raises(greenhouse.DecodeError) as refused:
        greenhouse.VentsOpen.decode(frame)
    assert (refused.value.reason, refused.value.offset) == (greenhouse.Reason.OUT_OF_RANGE, 13)
    assert f"{angle}, outside -900..900" in str(refused.value)
    with pytest.raises(greenhouse.EncodeError) as unfit:
        greenhouse.VentsOpen(ramp_s=0, vents=[(1, 0), (2, angle)])
    assert (unfit.value.path, unfit.value.value) == ("vents[1].angle", angle)
    assert str(unfit.value) == f"vents[1].angle: {angle} is outside -900..900"


@in_turn(
    "name, fields, said",
    lambda: [
        ("VentsOpen", {"ramp_s": 0, "vents": []}, "vents: 0 items is outside 1..8"),
        ("VentsOpen", {"ramp_s": 0, "vents": [(1, 0)] * 9}, "vents: 9 items is outside 1..8"),
        ("VentsOpen", {"ramp_s": 65536, "vents": [(1, 0)]}, "ramp_s: 65536 is outside 0..65535"),
        (
            "VentsOpen",
            {"ramp_s": 0, "vents": [(256, 0)]},
            "vents[0].vent_id: 256 is outside 0..255",
        ),
        (
            "StationState",
            {"uptime_s": 2**32, "readings": []},
            "uptime_s: 4294967296 is outside 0..4294967295",
        ),
        (
            "StationState",
            {"uptime_s": 0, "readings": [0, -32769]},
            "readings[1]: -32769 is outside -32768..32767",
        ),
        (
            "StationState",
            {"uptime_s": 0, "readings": [0] * 256},
            "readings: 256 items is outside 0..255",
        ),
        ("VentJammed", {"vent_id": 0, "trim": 128}, "trim: 128 is outside -128..127"),
        ("VentJammed", {"vent_id": -1, "trim": 0}, "vent_id: -1 is outside 0..255"),
        (
            "TextShow",
            {"number": 2**31},
            "number: 2147483648 is outside -2147483648..2147483647",
        ),
    ],
)
def test_what_no_frame_can_carry_is_refused(
    greenhouse: Any, name: str, fields: dict[str, Any], said: str
) -> None:
    with pytest.raises(greenhouse.EncodeError) as refused:
        getattr(greenhouse, name)(**fields)
    assert str(refused.value) == said


def test_the_docstrings_of_the_library_run(greenhouse: ModuleType) -> None:
    module = importlib.import_module("greenhouse.messages")
    globals_ = {**vars(greenhouse)}
    result = doctest.testmod(module, extraglobs=globals_, verbose=False)
    assert (result.failed, result.attempted) == (0, 5)


# ------------------------------------------------------------------ streams


@st.composite
def lines(draw: st.DrawFn) -> tuple[bytes, list[Any]]:
    """Return frames of stations with noise between that holds no header, and their messages."""
    line, sent = b"", []
    kinds = [m for m in LAYOUT.messages.values() if m.direction.sender == "station"]
    for _ in range(draw(st.integers(0, 5))):
        noise = draw(st.lists(st.sampled_from([0xC3, 0x5A, 0xA5, 0x11, 0, 2]), max_size=6))
        noisy = bytes(noise)
        if LAYOUT.frame.header not in noisy:
            line += noisy
        message = draw(st.sampled_from(kinds))
        values = draw(values_of(message))
        line += codec.encode(message, values)
        sent.append((message.name, arguments(values)))
    return line, sent


@given(lines(), st.data())
def test_a_stream_gives_every_frame_whatever_is_between_and_however_it_is_cut(
    line: tuple[bytes, list[Any]], data: st.DataObject
) -> None:
    bytes_, sent = line
    decoder = lib().StreamDecoder(lib().Direction.STATION_TO_GATEWAY)
    cuts = sorted(data.draw(st.lists(st.integers(0, len(bytes_)), max_size=6)))
    events = []
    for start, end in itertools.pairwise([0, *cuts, len(bytes_)]):
        events += decoder.feed(bytes_[start:end])
    events += decoder.flush()
    messages = [event for event in events if isinstance(event, lib().Message)]
    assert [(type(each).__name__, said_by(each)) for each in messages] == sent
    read = b"".join(e.encode() if isinstance(e, lib().Message) else e.data for e in events)
    assert read == bytes_
    assert decoder.pending == 0


@given(st.lists(damaged(), max_size=4).map(b"".join))
def test_a_stream_loses_and_invents_nothing(data: bytes) -> None:
    for direction in (None, *lib().Direction):
        decoder = lib().StreamDecoder(direction)
        events = decoder.feed(data) + decoder.flush()
        assert data == b"".join(
            e.encode() if isinstance(e, lib().Message) else e.data for e in events
        )
        for event in events:
            if isinstance(event, lib().Message):
                key = event.DIRECTION.value
                expected = type(event).__name__, said_by(event)
                assert result_there(event.encode(), key) == expected


def test_a_frame_out_of_range_is_noise_and_costs_nothing_behind_it(greenhouse: Any) -> None:
    bad = bytes.fromhex("C3 5A A5 10 00 06 00 00 01 01 03 85")
    good = greenhouse.VentsOpen(ramp_s=1, vents=[(1, 900)])
    decoder = greenhouse.StreamDecoder(greenhouse.Direction.GATEWAY_TO_STATION)
    assert decoder.feed(bad + good.encode()) == [
        greenhouse.Noise(bad, greenhouse.Reason.OUT_OF_RANGE),
        good,
    ]


def test_its_strategies_make_what_the_reference_codec_reads(greenhouse: Any) -> None:
    strategies = importlib.import_module("greenhouse.strategies")

    @given(strategies.messages())
    def agrees(message: Any) -> None:
        expected = type(message).__name__, said_by(message)
        assert result_there(message.encode(), message.DIRECTION.value) == expected

    agrees()


# ------------------------------------------------------------------ other shapes


def message_of(number: int, fields: dict[str, Any], *examples: tuple[dict[str, Any], str]) -> Data:
    return {
        "id": number,
        "direction": "gateway -> station",
        "summary": "Made up.",
        "cite": "manual, nowhere",
        "length": 0,
        "fields": {name: {"about": "Made up.", **field} for name, field in fields.items()},
        "examples": [
            {"title": "One", "hex": text, "values": values, "constructed": "By hand."}
            for values, text in examples
        ],
    }


def spec_with(name: str, message: Data, length: str | int, **frame: Any) -> Data:
    """Return a small protocol of one message."""
    spec = {key: SPEC[key] for key in ("framegen", "sources", "endpoints", "link")}
    part = {"preamble": {"is": "constant", "bytes": "AA"}, **frame}
    return {
        **spec,
        "protocol": {**SPEC["protocol"], "name": "made_up", "version": "1.0.0"},
        "byte_order": "big",
        "frame": part,
        "messages": {name: {**message, "length": length}},
    }


FRAME: dict[str, Any] = {
    "size": {"is": "length", "type": "u8", "counts": ["body"]},
    "kind": {"is": "id", "type": "u8"},
    "body": {"is": "body"},
}


def without_command(compiled: Compiled) -> dict[str, str]:
    """Return the library without its command, for what is done with codec and clients alone."""
    files = library_files(compiled)
    return {path: text for path, text in files.items() if "/_cli/" not in path}


def places(frame: bytes) -> list[int]:
    """Return every place in a frame; of hundreds of equal elements, those at either end."""
    return [*range(len(frame))[:40], *range(len(frame))[40:][-20:]]


def holds(data: Data) -> None:
    """Check that a library agrees with the reference codec on each message, ends included."""
    compiled = compiled_of(data)
    layout = compiled.model
    with library(without_command(compiled)) as made:
        library_: Any = made
        for valid in valid_frames(layout):
            frame, direction = valid.data, valid.message.direction.key
            kind = getattr(library_, valid.message.name)
            assert kind(**arguments(dict(valid.values))).encode() == frame
            message = library_.decode(frame, library_.Direction(direction))
            assert said_by(message) == arguments(dict(valid.values))
            for rows in said_by(message).values():
                if rows and isinstance(rows, list | tuple) and isinstance(rows[0], tuple):
                    assert message.columns() == tuple(zip(*rows, strict=True))
            for at in places(frame):
                for data_ in (frame[:at], frame[:at] + bytes([frame[at] ^ 1]) + frame[at + 1 :]):
                    try:
                        here: tuple[Any, ...] = (
                            valid.message.name,
                            said_by(library_.decode(data_, message.DIRECTION)),
                        )
                    except library_.DecodeError as error:
                        here = error.reason.value, error.offset
                    assert here == result_there(data_, direction, layout)
        doctest_ = doctest.testmod(
            importlib.import_module("made_up.messages"), extraglobs=vars(made)
        )
        assert (doctest_.failed, doctest_.attempted > 0) == (0, True)


COUNT = {"type": "u8"}
ABSENT: Data = {"absent": True, "about": "It is not there."}
SHAPES: dict[str, tuple[Data, str | int]] = {
    "numbers read as signed, and absent ones": (
        message_of(
            0x30,
            {
                "depth": {"type": "u32", "signed_as": "i32"},
                "level": {"type": "u8", "values": {"none": {**ABSENT, "value": 9}}},
                "n": COUNT,
                "steps": {
                    "element": "Step",
                    "counted_by": "n",
                    "fields": {
                        "height": {
                            "type": "u16",
                            "about": "It.",
                            "signed_as": "i16",
                            "values": {
                                "unplugged": {**ABSENT, "value": 65535},
                                "broken": {**ABSENT, "value": 65534},
                            },
                        }
                    },
                },
            },
            (
                {
                    "depth": 0xFFFF_FFFE,
                    "level": 9,
                    "steps": [{"height": 65535}, {"height": 65534}, {"height": 5}],
                },
                "AA 0C 30 FF FF FF FE 09 03 FF FF FF FE 00 05",
            ),
        ),
        "2 * n + 6",
    ),
    "limits of a number and of numbers in a list": (
        message_of(
            0x31,
            {
                "level": {"type": "u8", "limits": {"usual": "1..9"}},
                "n": COUNT,
                "numbers": {"type": "u8", "counted_by": "n", "limits": {"usual": "1..9"}},
            },
            ({"level": 1, "numbers": [2, 9]}, "AA 04 31 01 02 02 09"),
        ),
        "n + 2",
    ),
    "bare u16 numbers": (
        message_of(
            1,
            {"n": COUNT, "numbers": {"type": "u16", "counted_by": "n"}},
            ({"numbers": [1, 515]}, "AA 05 01 02 00 01 02 03"),
        ),
        "2 * n + 1",
    ),
    "a count between other fields": (
        message_of(
            2,
            {
                "first": {"type": "u16"},
                "n": COUNT,
                "last": {"type": "i16"},
                "numbers": {"type": "i8", "counted_by": "n", "count": "2..3"},
            },
            ({"first": 1, "last": -1, "numbers": [-1, 1]}, "AA 07 02 00 01 02 FF FF FF 01"),
        ),
        "n + 5",
    ),
    "a count of two bytes": (
        message_of(
            3,
            {"n": {"type": "u16"}, "numbers": {"type": "u8", "counted_by": "n"}},
            ({"numbers": [7]}, "AA 03 03 00 01 07"),
        ),
        "n + 2",
    ),
    "elements of one field": (
        message_of(
            4,
            {
                "n": COUNT,
                "steps": {
                    "element": "Step",
                    "counted_by": "n",
                    "fields": {"angle": {"type": "i16", "about": "It."}},
                },
            },
            ({"steps": [{"angle": -2}]}, "AA 03 04 01 FF FE"),
        ),
        "2 * n + 1",
    ),
    "elements of one narrowed field": (
        message_of(
            5,
            {
                "n": COUNT,
                "steps": {
                    "element": "Step",
                    "counted_by": "n",
                    "fields": {"angle": {"type": "i16", "about": "It.", "range": "-9..9"}},
                },
            },
            ({"steps": [{"angle": -9}, {"angle": 9}]}, "AA 05 05 02 FF F7 00 09"),
        ),
        "2 * n + 1",
    ),
    "narrowed numbers in front of a list": (
        message_of(
            6,
            {
                "mode": {"type": "u8", "range": "1..3"},
                "n": COUNT,
                "numbers": {"type": "u8", "counted_by": "n", "range": "10.."},
            },
            ({"mode": 1, "numbers": [10, 255]}, "AA 04 06 01 02 0A FF"),
            ({"mode": 3, "numbers": []}, "AA 02 06 03 00"),
        ),
        "n + 2",
    ),
    "elements of eight fields, behind another": (
        message_of(
            10,
            {
                "mode": {"type": "i16"},
                "n": COUNT,
                "rows": {
                    "element": "Step",
                    "counted_by": "n",
                    "count": "0..2",
                    "fields": {
                        **{f"column{n}": {"type": "u8", "about": "It."} for n in range(7)},
                        "last": {"type": "i16", "about": "It."},
                    },
                },
            },
            (
                {
                    "mode": 1,
                    "rows": [
                        {**{f"column{n}": 100 + n for n in range(7)}, "last": -1},
                        {**{f"column{n}": 6 - n for n in range(7)}, "last": 258},
                    ],
                },
                "AA 15 0A 00 01 02 64 65 66 67 68 69 6A FF FF 06 05 04 03 02 01 00 01 02",
            ),
        ),
        "9 * n + 3",
    ),
    "no fields at all": (message_of(7, {}, ({}, "AA 00 07")), 0),
    "one field": (message_of(8, {"only": {"type": "u8"}}, ({"only": 5}, "AA 01 08 05")), 1),
    "many named values": (
        message_of(
            9,
            {
                "mode": {
                    "type": "u8",
                    "unit": "mode",
                    "values": {
                        f"mode_number_{n}": {"value": n, "about": f"Mode {n}."} for n in range(6)
                    },
                }
            },
            *[({"mode": n}, f"AA 01 09 0{n}") for n in range(6)],
        ),
        1,
    ),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_message_of_any_shape_works(shape: str) -> None:
    message, length = SHAPES[shape]
    holds(spec_with("Made", message, length, **FRAME))


def test_derived_values_are_there_on_messages_and_elements() -> None:
    message, length = SHAPES["numbers read as signed, and absent ones"]
    with library(files_of(spec_with("Made", message, length, **FRAME))) as made:
        kind: Any = made.Made
        there = kind(depth=2**32 - 5, level=8, steps=[(65533,), (65534,), (65535,)])
        assert (there.depth, there.signed_depth, there.absent) == (2**32 - 5, -5, False)
        assert [each.signed_height for each in there.steps] == [-3, -2, -1]
        assert [each.absent for each in there.steps] == [False, True, True]
        assert kind(depth=5, level=9, steps=[]).absent
        assert kind(depth=5, level=9, steps=[]).signed_depth == 5


def test_limits_hold_for_a_number_and_for_numbers_in_a_list() -> None:
    message, length = SHAPES["limits of a number and of numbers in a list"]
    with library(files_of(spec_with("Made", message, length, **FRAME))) as made:
        limits = importlib.import_module(f"{made.__name__}._client.exchanges").LIMITS
        limits.check(made.Made(9, [1, 9]), limits.usual)
        for level, numbers, place in [(10, [1], "level: 10"), (1, [1, 0], "numbers[1]: 0")]:
            with pytest.raises(made.LimitError) as refused:
                limits.check(made.Made(level, numbers), limits.usual)
            problem = f"{place} is outside the limits 1..9; limits=None sends anything"
            assert str(refused.value) == problem


# Each order of bytes meets every value of the other four, which meet one another in full.
FRAMES = list(
    zip(
        itertools.cycle(["little", "big"]),
        itertools.product(
            [["size", "kind", "body"], ["kind", "size", "body"]],
            ["u8", "u16"],
            ["u8", "u16"],
            [["body"], ["size", "kind", "body"], ["kind", "body"]],
        ),
        strict=False,
    )
)


@pytest.mark.parametrize(
    ("order", "parts", "size", "kind", "counts"), [(order, *rest) for order, rest in FRAMES]
)
def test_a_frame_of_any_layout_works(
    order: str, parts: list[str], size: str, kind: str, counts: list[str]
) -> None:
    widths = {"size": NUMBER_TYPES[size].size, "kind": NUMBER_TYPES[kind].size, "body": 3}
    length = sum(widths[part] for part in counts)
    values = {"size": length, "kind": 9}
    head = b"".join(
        values[part].to_bytes(widths[part], "little" if order == "little" else "big")
        for part in parts
        if part != "body"
    )
    body = "01 07 00" if order == "little" else "01 00 07"
    fields = {"n": COUNT, "numbers": {"type": "u16", "counted_by": "n"}}
    made_of = {
        "size": {"is": "length", "type": size, "counts": counts},
        "kind": {"is": "id", "type": kind},
        "body": {"is": "body"},
    }
    message = message_of(9, fields, ({"numbers": [7]}, f"AA {head.hex(' ')} {body}"))
    data = spec_with("Made", message, f"2 * n + {length - 2}", **{p: made_of[p] for p in parts})
    data["byte_order"] = order
    compiled = compiled_of(data)
    layout = compiled.model
    with library(without_command(compiled)) as made:
        any_made: Any = made
        frame = b"\xaa" + head + bytes.fromhex(body)
        assert any_made.Made([7]).encode() == frame
        assert codec.encode(layout.messages["Made"], {"numbers": [7]}) == frame
        decoder = any_made.StreamDecoder(None)
        events = decoder.feed(b"\xaa" + frame * 3 + b"\x00") + decoder.flush()
        assert [e for e in events if isinstance(e, any_made.Message)] == [any_made.Made([7])] * 3


def test_the_widest_numbers_keep_every_value() -> None:
    message = message_of(
        1,
        {
            "stamp": {"type": "u64"},
            "n": COUNT,
            "stamps": {"type": "u64", "counted_by": "n"},
        },
        (
            {"stamp": 1, "stamps": [2**63]},
            "AA 11 01 00 00 00 00 00 00 00 01 01 80 00 00 00 00 00 00 00",
        ),
        ({"stamp": 2**64 - 2, "stamps": []}, "AA 09 01 FF FF FF FF FF FF FF FE 00"),
    )
    data = spec_with("Made", message, "8 * n + 9", **FRAME)
    assert rules_broken(data) == []
    holds(data)
    data["messages"]["Made"]["fields"]["stamp"]["range"] = f"1..{2**64 - 2}"
    holds(data)


# ------------------------------------------------------------------ the tools of the trade


def tool(name: str) -> str:
    beside = Path(sys.executable).with_name(name)
    found = str(beside) if beside.exists() else shutil.which(name)
    if found is None:
        pytest.skip(f"{name} is not installed: `pip install --group lint`")
    return found


# Other protocols, by the names of their files: one with poses, two in which one end alone speaks.
OTHERS = ("blinds", "lamp", "weather")


@cache
def many() -> dict[str, dict[str, str]]:
    """Return the libraries of the demo, the guide, all the shapes above, and a minimal spec."""
    specs = [SPEC, kiln(), *(data_of(DEMO.with_name(f"{name}.yaml")) for name in OTHERS)]
    for name, shapes in {"shapes": list(SHAPES), "bare": ["no fields at all"]}.items():
        messages = {
            f"Made{number:02}": {**SHAPES[shape][0], "length": SHAPES[shape][1]}
            for number, shape in enumerate(shapes)
        }
        for number, message in enumerate(messages.values()):
            _rename_element(message, f"Step{number:02}")
        data = spec_with("Made", {}, 0, **FRAME)
        specs.append({**data, "protocol": {**data["protocol"], "name": name}, "messages": messages})
    return {data["protocol"]["name"]: files_of(data) for data in specs}


def _rename_element(message: Data, name: str) -> None:
    message["fields"] = {
        key: {**field, "element": name} if "element" in field else field
        for key, field in message["fields"].items()
    }


@pytest.mark.parametrize("name", ["greenhouse", "kiln", "shapes", "bare"])
def test_every_verb_of_a_library_has_help(capsys: pytest.CaptureFixture[str], name: str) -> None:
    with library(many()[name]):
        main = importlib.import_module(f"{name}._cli").main
        verbs = {*importlib.import_module(f"{name}._cli.examples").VERBS} - {"simulate"}
        assert len(verbs) > 5
        for verb in verbs:
            assert main([verb, "--help"]) == 0
            assert capsys.readouterr().out.startswith(f"usage: {name} {verb} ")


@pytest.mark.parametrize("name", ["kiln", "bare", "weather"])
def test_the_doctor_of_a_library_finds_its_way_without_a_board(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    with library(many()[name]):
        main = importlib.import_module(f"{name}._cli").main
        # There is nobody to be waited for.
        monkeypatch.setattr(f"{name}._cli.checks.rate.EXTRA_TIME", 0.0)
        status = main(["doctor", "--port", "loop://", "--timeout", "0.01", "--json"])
    out, err = capsys.readouterr()
    assert status in {0, 1}, err
    states = {each["check"]: each["state"] for each in map(json.loads, out.splitlines())}
    assert states["opening"] == "passed"
    # A protocol without a question that has no fields has nothing to ask of any board.
    checks = {"rate", "reply"} - {"bare": {"rate", "reply"}, "weather": {"rate", "reply"}}.get(
        name, set()
    )
    assert {"rate", "reply"} & states.keys() == checks
    assert {states[check] for check in checks} <= {"failed", "unknown"}


@pytest.fixture(scope="module")
def side_by_side(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return the folder in which all of these libraries stand."""
    folder = tmp_path_factory.mktemp("many")
    for files in many().values():
        write_files(files, folder)
    return folder / "generated"


@pytest.mark.parametrize(
    "words",
    [
        ("ruff", "check", "--no-cache", "--config", str(ROOT / "pyproject.toml"), "."),
        # A tuple of one message, where the formatter has another opinion, is left out.
        (
            "ruff",
            "format",
            "--check",
            "--no-cache",
            "--line-length=100",
            "greenhouse",
            "kiln",
            "shapes",
            "blinds",
            "stage_lamp",
            "weather",
        ),
        pytest.param(
            ("mypy", "--strict", "--no-error-summary", "."),
            marks=pytest.mark.slow,
        ),
    ],
    ids=["ruff check", "ruff format", "mypy"],
)
def test_the_libraries_are_clean(
    side_by_side: Path, words: tuple[str, ...], tmp_path: Path
) -> None:
    name, *options = words
    if name == "mypy":
        options += [f"--config-file={ROOT / 'tests' / 'untyped.ini'}", f"--cache-dir={tmp_path}"]
    done = subprocess.run(
        [tool(name), *options], cwd=side_by_side, capture_output=True, encoding="utf-8", check=False
    )
    assert done.returncode == 0, done.stdout + done.stderr


def test_no_check_is_switched_off_in_the_generated_part() -> None:
    """In what templates made; the runtime is code like any other, and gives its reasons."""
    files = many()["greenhouse"]
    for name in (
        "__init__.py",
        "messages.py",
        "_frame/protocol.py",
        "_frame/direction.py",
        "strategies.py",
    ):
        text = files[f"generated/greenhouse/{name}"]
        assert re.findall(r"#\s*(?:noqa|type:|pyright:|mypy:|fmt:|pragma)", text) == [], name
