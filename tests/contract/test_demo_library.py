"""The library of another protocol, with all features of the language, against the reference.

And that of a protocol with messages of every shape: tests/contract/shapes.yaml.
"""

import importlib
import io
import itertools
import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from types import ModuleType
from typing import Any, Literal

import pytest
from framegen.cases.valid import valid_frames
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.values import Direction
from framegen.model import codec
from framegen.model.codec import NotAFrame
from framewire.frame.parts import message_parts
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import (
    DEMO,
    Data,
    compiled_of,
    data_of,
    files_of,
    kiln,
    library,
    library_files,
    vectors_of,
)
from tests.in_turn import in_turn
from tests.protocols.libraries import direction_of, made_of, values_in
from tests.protocols.peer import Values
from tests.side_by_side import library_of, linted

SPEC = data_of(DEMO)


def example_of_shape(frame: str, values: Data) -> Data:
    return {"title": "One", "hex": frame, "values": values, "constructed": "By hand."}


def described(fields: Data) -> Data:
    """Return fields with something said of each."""
    said = {name: {"about": "It.", **field} for name, field in fields.items()}
    for field in said.values():
        if "fields" in field:
            field["fields"] = described(field["fields"])
    return said


SHAPES = data_of(Path(__file__).with_name("shapes.yaml"))


def shapes_alone(*names: str) -> Data:
    """Return the spec of some shapes of messages, or of all."""
    part: Data = {"type": "u8"}
    return {
        **{key: SPEC[key] for key in ("framegen", "sources", "endpoints", "link", "byte_order")},
        "protocol": {**SPEC["protocol"], "name": "shapes", "version": "1.0.0"},
        "frame": {
            "preamble": {"is": "constant", "bytes": "AA"},
            "size": {"is": "length", "counts": ["body"], **part},
            "kind": {"is": "id", **part},
            "body": {"is": "body"},
        },
        "messages": {
            name: {
                "id": bytes.fromhex(next(iter(shape["frames"])))[2],
                "direction": "gateway -> station",
                "summary": "Made up.",
                "cite": "manual, nowhere",
                "length": shape["length"],
                "fields": described(shape["fields"]),
                "examples": [example_of_shape(*each) for each in shape["frames"].items()],
            }
            for name, shape in SHAPES.items()
            if not names or name in names
        },
    }


COMPILED = {"greenhouse": compiled_of(SPEC), "shapes": compiled_of(shapes_alone())}
MODELS = {name: compiled.model for name, compiled in COMPILED.items()}
LAYOUT = MODELS["greenhouse"]


@cache
def files(name: str) -> dict[str, str]:
    return library_files(COMPILED[name])


@pytest.fixture(scope="module", autouse=True)
def greenhouse() -> Iterator[ModuleType]:
    """Return the library, imported under its own name; beside it stands that of the shapes."""
    with library(files("shapes")), library(files("greenhouse")) as made:
        yield made


def lib(name: str = "greenhouse") -> Any:
    """Return a library, for Hypothesis, which takes no fixtures."""
    return importlib.import_module(name)


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
    command: Any = importlib.import_module("greenhouse.__main__")
    for way, found in (("gateway_to_station", "1 message"), ("gateway_to_display", "0 messages")):
        assert command.main(["decode", "--direction", way, example_of("VentsOpen")]) == 0
        assert f": {found}," in capsys.readouterr().err
    assert command.main(["decode", "--direction", "gateway", "00"]) == 2
    assert "invalid choice: 'gateway'" in capsys.readouterr().err


def test_parts_of_frames_are_called_as_the_author_calls_them(greenhouse: ModuleType) -> None:
    unknown = greenhouse.UnknownFrame(bytes.fromhex("C3 5A A5 FF 00 01 2A"), None)
    assert unknown.numbers == {"kind": 255}
    message = greenhouse.VentsOpen.decode(bytes.fromhex(example_of("VentsOpen")))
    names = [name for _, name, _ in message_parts(message)]
    assert names[:3] == [name for name in SPEC["frame"] if name != "payload"]


def example_of(name: str) -> str:
    hex_: str = SPEC["messages"][name]["examples"][0]["hex"]
    return hex_


# ------------------------------------------------------------------ values, both ways

each_library = pytest.mark.parametrize("name", MODELS)


def arguments(values: Values) -> Values:
    """Return values of the reference codec as a message takes them: elements as tuples."""
    return {
        name: [tuple(item.values()) if isinstance(item, dict) else item for item in value]
        if isinstance(value, list)
        else value
        for name, value in values.items()
    }


def result_here(name: str, data: bytes, way: Direction) -> tuple[Any, ...]:
    try:
        message = lib(name).decode(data, direction_of(lib(name), way))
    except lib(name).DecodeError as error:
        return error.reason.value, error.offset
    kind = type(message).__name__
    return kind, values_in(MODELS[name].messages[kind], message)


def result_there(name: str, data: bytes, way: Direction) -> tuple[Any, ...]:
    try:
        decoded = codec.decode(MODELS[name], way, data)
    except NotAFrame as error:
        return error.reason, error.offset
    return decoded.layout.name, decoded.values


def assert_both_agree(name: str, data: bytes, way: Direction) -> None:
    # As text, in which what is no number is the same as itself.
    assert repr(result_here(name, data, way)) == repr(result_there(name, data, way))


def places(frame: bytes) -> list[int]:
    """Return every place in a frame; of hundreds of equal elements, those at either end."""
    return [*range(len(frame))[:40], *range(len(frame))[40:][-20:]]


@each_library
def test_every_byte_of_a_frame_matters(name: str) -> None:
    """Of a message of any shape: cut short anywhere and changed anywhere, both codecs agree."""
    for valid in valid_frames(MODELS[name]):
        frame, layout = valid.data, valid.message
        made = made_of(lib(name), layout, dict(valid.values))
        assert made.encode() == frame
        assert result_here(name, frame, layout.direction) == (layout.name, valid.values)
        for rows in arguments(dict(valid.values)).values():
            if rows and isinstance(rows, list) and isinstance(rows[0], tuple):
                assert made.columns() == tuple(zip(*rows, strict=True))
        for at in places(frame):
            for bit in (0x01, 0x80):
                changed = frame[:at] + bytes([frame[at] ^ bit]) + frame[at + 1 :]
                assert_both_agree(name, changed, layout.direction)
            assert_both_agree(name, frame[:at], layout.direction)


def test_it_refuses_every_bad_vector_for_the_reason_given() -> None:
    vectors = vectors_of(COMPILED["greenhouse"])
    ways = {way.key: way for way in LAYOUT.directions}
    assert len(vectors["valid"]) >= 13
    for vector in vectors["valid"]:
        found = result_here("greenhouse", bytes.fromhex(vector["hex"]), ways[vector["direction"]])
        assert found == (vector["message"], vector["fields"])
    for vector in vectors["invalid"]:
        found = result_here("greenhouse", bytes.fromhex(vector["hex"]), ways[vector["direction"]])
        assert found == (vector["reason"], vector["offset"]), vector
    # Nothing stands behind its fields.
    absent = {lib().Reason.BAD_CHECKSUM, lib().Reason.BAD_TRAILER}
    assert {vector["reason"] for vector in vectors["invalid"]} == {
        reason.value for reason in {*lib().Reason} - absent
    }


# ------------------------------------------------------------------ facts, by hand

# A message, its frame worked out on paper, and who sends it.
ASKED, TOLD, SHOWN = "GATEWAY_TO_STATION", "STATION_TO_GATEWAY", "GATEWAY_TO_DISPLAY"
VENTS = {"ramp_s": 0x1234, "vents": [(7, -900), (8, 900), (9, -1)]}
OF_VENTS = "C3 5A A5 10 00 0C 12 34 03 07 FC 7C 08 03 84 09 FF FF"
READINGS = {"uptime_s": 1, "readings": [-32768, 32767, -2]}
OF_READINGS = "C3 5A A5 11 00 0B 00 00 00 01 03 80 00 7F FF FF FE"
NOTHING = {"uptime_s": 0xFFFFFFFE, "readings": []}


@in_turn(
    "name, fields, text, direction",
    lambda: [
        ("StationRead", {}, "C3 5A A5 11 00 00", ASKED),
        ("VentJammed", {"vent_id": 255, "trim": -128}, "C3 5A A5 12 00 02 FF 80", TOLD),
        ("TextShow", {"number": -(2**31)}, "C3 5A A5 10 00 04 80 00 00 00", SHOWN),
        ("TextShow", {"number": 0x01020304}, "C3 5A A5 10 00 04 01 02 03 04", SHOWN),
        ("VentsOpen", VENTS, OF_VENTS, ASKED),
        ("StationState", NOTHING, "C3 5A A5 11 00 05 FF FF FF FE 00", TOLD),
        ("StationState", READINGS, OF_READINGS, TOLD),
    ],
)
def test_frames_worked_out_on_paper(
    greenhouse: Any, name: str, fields: dict[str, Any], text: str, direction: str
) -> None:
    frame = bytes.fromhex(text)
    message = getattr(greenhouse, name)(**fields)
    assert message.encode() == frame
    assert direction == message.DIRECTION.name
    assert greenhouse.decode(frame, message.DIRECTION) == message
    assert arguments(values_in(LAYOUT.messages[name], message)) == fields


@in_turn(
    "name, text, values",
    lambda: [(name, *row) for name, shape in SHAPES.items() for row in shape["frames"].items()],
)
def test_frames_of_a_shape_worked_out_on_paper(name: str, text: str, values: Values) -> None:
    frame, (way,) = bytes.fromhex(text), MODELS["shapes"].directions
    assert result_here("shapes", frame, way) == (name, values) == result_there("shapes", frame, way)
    message = MODELS["shapes"].messages[name]
    assert made_of(lib("shapes"), message, values).encode() == frame
    assert codec.encode(message, values) == frame


@in_turn(
    "text, refusal",
    lambda: [row for shape in SHAPES.values() for row in shape.get("refused", {}).items()],
)
def test_frames_of_a_shape_are_none_on_paper(text: str, refusal: list[Any]) -> None:
    frame, (way,) = bytes.fromhex(text), MODELS["shapes"].directions
    assert result_here("shapes", frame, way) == tuple(refusal)
    assert result_there("shapes", frame, way) == tuple(refusal)


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


def test_a_derived_field_knows_its_list_and_a_scale_is_told(greenhouse: Any) -> None:
    vents, readings = greenhouse.VentsOpen.vents, greenhouse.StationState.readings
    assert (vents.at, vents.element, vents.counts) == (9, greenhouse.Vent, range(1, 9))
    assert vents.count is greenhouse.VentsOpen.vent_count
    assert (readings.element, readings.fields[0].unit) == (None, "cK")
    assert "A step is 0.01 K." in readings.__doc__


def test_an_id_means_what_its_direction_says(greenhouse: Any) -> None:
    """0x10 is sent two ways by one endpoint, and 0x11 by either end of one line."""
    direction = greenhouse.Direction
    assert [way.name for way in direction] == [ASKED, TOLD, SHOWN]
    show, read = greenhouse.TextShow(-2), greenhouse.StationRead()
    for way in (direction.GATEWAY_TO_DISPLAY, None):
        assert greenhouse.decode(show.encode(), way) == show
    for frame, way, reason, offset in (
        (show.encode(), direction.GATEWAY_TO_STATION, "length mismatch", 4),
        (read.encode(), direction.STATION_TO_GATEWAY, "length mismatch", 4),
        (read.encode(), direction.GATEWAY_TO_DISPLAY, "unknown command", 3),
    ):
        with pytest.raises(greenhouse.DecodeError) as refused:
            greenhouse.decode(frame, way)
        assert (refused.value.reason.value, refused.value.offset) == (reason, offset)
    way = direction.GATEWAY_TO_DISPLAY
    assert (way.sender, way.receiver) == ("gateway", "display")


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


# ------------------------------------------------------------------ streams


BAD = bytes.fromhex("C3 5A A5 10 00 06 00 00 01 01 03 85")


# The end of it may be the beginning of what follows.
@in_turn("cut", lambda: range(len(BAD) - 3, len(BAD) + 1))
@in_turn("size", lambda: [1, 100])
def test_a_frame_out_of_range_is_noise_and_costs_nothing_behind_it(
    greenhouse: Any, cut: int, size: int
) -> None:
    good = greenhouse.VentsOpen(ramp_s=1, vents=[(1, 900)])
    decoder = greenhouse.StreamDecoder(greenhouse.Direction.GATEWAY_TO_STATION)
    line = BAD[:cut] + good.encode()
    *before, last = (
        event for at in range(0, len(line), size) for event in decoder.feed(line[at : at + size])
    )
    assert last == good
    assert b"".join(event.data for event in before) == BAD[:cut]
    if cut == len(BAD):
        assert {event.reason for event in before} == {greenhouse.Reason.OUT_OF_RANGE}


@in_turn(
    "max_frame, text, reason, is_unknown",
    lambda: [
        # Where the id comes first, it is unknown before the length is there, which still has a say.
        (None, "C3 5A A5 77", "unknown command", False),
        (None, "C3 5A A5 77 00 02 00 00", "unknown command", True),
        (None, "C3 5A A5 77 FF FF 00 00", "unknown command", False),
        (8, "C3 5A A5 77 00 02 00 00", "unknown command", True),
        (8, "C3 5A A5 77 00 03 00 00 00", "unknown command", False),
    ],
)
def test_a_frame_of_an_unknown_id_is_one_as_far_as_its_length_goes(
    greenhouse: Any, max_frame: int | None, text: str, reason: str, is_unknown: bool
) -> None:
    decoder = greenhouse.StreamDecoder(greenhouse.Direction.GATEWAY_TO_STATION, max_frame)
    (event,) = decoder.feed(bytes.fromhex(text)) + decoder.flush()
    assert (event.data, event.reason.value) == (bytes.fromhex(text), reason)
    assert isinstance(event, greenhouse.UnknownFrame) == is_unknown


@each_library
@given(data=st.data())
def test_its_strategies_make_what_the_reference_codec_reads(name: str, data: st.DataObject) -> None:
    message = data.draw(importlib.import_module(f"{name}.strategies").messages())
    (way,) = (way for way in MODELS[name].directions if way.key == message.DIRECTION.value)
    kind = type(message).__name__
    found = kind, values_in(MODELS[name].messages[kind], message)
    assert result_there(name, message.encode(), way) == found


# ------------------------------------------------------------------ other shapes


def test_derived_values_are_there_on_messages_and_elements() -> None:
    with library(files("shapes")) as made:
        kind: Any = made.SignedAndAbsent
        there = kind(depth=2**32 - 5, level=8, steps=[(65533,), (65534,), (65535,)])
        assert (there.depth, there.signed_depth, there.absent) == (2**32 - 5, -5, False)
        assert [each.signed_height for each in there.steps] == [-3, -2, -1]
        assert [each.absent for each in there.steps] == [False, True, True]
        assert kind(depth=5, level=9, steps=[]).absent
        assert kind(depth=5, level=9, steps=[]).signed_depth == 5


def test_limits_hold_for_a_number_and_for_numbers_in_a_list() -> None:
    with library(files("shapes")) as made:
        limits = importlib.import_module(f"{made.__name__}._exchanges").LIMITS
        limits.check(made.Limited(9, [1, 9]), limits.usual)
        for level, numbers, place in [(10, [1], "level: 10"), (1, [1, 0], "numbers[1]: 0")]:
            with pytest.raises(made.LimitError) as refused:
                limits.check(made.Limited(level, numbers), limits.usual)
            problem = f"{place} is outside the limits 1..9; limits=None sends anything"
            assert str(refused.value) == problem


# Each order of bytes meets every value of the other four, which meet one another in full.
ORDERS = [("size", "kind", "body"), ("kind", "size", "body")]
COUNTED = [["body"], ["size", "kind", "body"], ["kind", "body"]]
LAYOUTS = [*itertools.product(ORDERS, ["u8", "u16"], ["u8", "u16"], COUNTED)]
FRAMES = [*zip(itertools.cycle(["little", "big"]), LAYOUTS, strict=False)]


@in_turn("order, parts, size, kind, counts", lambda: [(order, *row) for order, row in FRAMES])
def test_a_frame_of_any_layout_works(
    order: Literal["little", "big"], parts: list[str], size: str, kind: str, counts: list[str]
) -> None:
    widths = {"size": NUMBER_TYPES[size].size, "kind": NUMBER_TYPES[kind].size, "body": 3}
    length = sum(widths[part] for part in counts)
    values = {"size": length, "kind": 9}
    head = [values[part].to_bytes(widths[part], order) for part in parts if part != "body"]
    frame = b"".join([b"\xaa", *head, b"\1\7\0" if order == "little" else b"\1\0\7"])
    data = shapes_alone("BareNumbers")
    whole = {"is": "length", "type": size, "counts": counts}
    made_of_parts = {**data["frame"], "size": whole, "kind": {"is": "id", "type": kind}}
    data["frame"] = {part: made_of_parts[part] for part in ("preamble", *parts)}
    data["byte_order"] = order
    data["messages"]["BareNumbers"] |= {
        "id": 9,
        "length": f"2 * many + {length - 2}",
        "examples": [example_of_shape(frame.hex(" "), {"numbers": [7]})],
    }
    compiled = compiled_of(data)
    message = compiled.model.messages["BareNumbers"]
    assert codec.encode(message, {"numbers": [7]}) == frame
    # Without the command, for what is done with the codec alone.
    files = library_files(compiled).items()
    with library({path: text for path, text in files if not path.endswith("/_command.py")}) as made:
        any_made: Any = made
        bare = any_made.BareNumbers([7])
        assert bare.encode() == frame
        decoder = any_made.StreamDecoder(None)
        events = decoder.feed(b"\xaa" + frame * 3 + b"\x00") + decoder.flush()
        assert [event for event in events if isinstance(event, any_made.Message)] == [bare] * 3


# ------------------------------------------------------------------ the tools of the trade

# Other protocols, by the names of their files: one with poses, two in which one end alone speaks.
OTHERS = ("blinds", "lamp", "weather")


@cache
def many() -> dict[str, dict[str, str]]:
    """Return the libraries of the demo, the guide, all the shapes above, and a minimal spec."""
    bare = shapes_alone("Nothing")
    bare["protocol"]["name"] = "bare"
    specs = [kiln(), bare, *(data_of(DEMO.with_name(f"{name}.yaml")) for name in OTHERS)]
    others = {data["protocol"]["name"]: files_of(data) for data in specs}
    return {name: files(name) for name in COMPILED} | others


# tests/unit/targets/test_other_protocols.py has the others.
@pytest.mark.parametrize("name", ["kiln", "shapes", "bare"])
def test_every_verb_of_a_library_has_help(capsys: pytest.CaptureFixture[str], name: str) -> None:
    with library(many()[name]):
        main = importlib.import_module(f"{name}.__main__").main
        verbs = {*importlib.import_module(f"{name}._command").PROGRAM.verbs} - {"simulate"}
        assert len(verbs) > 5
        for verb in verbs:
            assert main([verb, "--help"]) == 0
            assert capsys.readouterr().out.startswith(f"usage: {name} {verb} ")


@pytest.mark.parametrize("name", ["kiln", "bare", "weather"])
def test_the_doctor_of_a_library_finds_its_way_without_a_board(
    capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    with library(many()[name]):
        main = importlib.import_module(f"{name}.__main__").main
        # There is nobody to be waited for.
        monkeypatch.setattr("framewire.command.checks.rate.EXTRA_TIME", 0.0)
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


def test_linters_find_nothing_in_the_libraries(tmp_path: Path) -> None:
    for name, made in many().items():
        library_of(name, made).write(tmp_path)
    assert linted(tmp_path) == {}


def test_no_check_is_switched_off_in_the_generated_part() -> None:
    """In what templates made; the runtime is code like any other, and gives its reasons."""
    for name in (
        "__init__.py",
        "messages.py",
        "_library.py",
        "strategies.py",
    ):
        text = files("greenhouse")[f"generated/greenhouse/{name}"]
        assert re.findall(r"#\s*(?:noqa|type:|pyright:|mypy:|fmt:|pragma)", text) == [], name
