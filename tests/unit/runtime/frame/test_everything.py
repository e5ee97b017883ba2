"""The library of a protocol with every kind of part and field: what its messages are to a user."""

from __future__ import annotations

import copy
import inspect
import json
import math
import pickle
import sys
from importlib import import_module
from typing import TYPE_CHECKING, Any

import pytest
from framegen.targets.python.message_view import MessageView
from framewire.client.exchange import column
from framewire.command.values import fields_as_text, fields_in_json, message_from_text
from framewire.frame import big, little
from framewire.frame.lists import List
from framewire.frame.number import ANY_ORDER, I8, U8, Number, order_of
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import compiled_file, library, library_of
from tests.in_turn import in_turn
from tests.protocols.specs import FILES, messages_of

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from types import ModuleType

NUMBERS: dict[str, Any] = messages_of("everything")["Numbers"].message.examples[0].values
LISTS: dict[str, Any] = messages_of("everything")["Lists"].message.examples[0].values
POINT, READING = (1, 5), ("VBAT", 12.5, 99, -300)


@pytest.fixture(scope="module")
def everything() -> Iterator[Any]:
    """Return the library, imported."""
    with library(library_of(FILES["everything"])) as made:
        yield made


def numbers(made: Any, **changes: Any) -> Any:
    return made.Numbers(**{**NUMBERS, **changes})


def lists(made: Any, **changes: Any) -> Any:
    points = [tuple(point.values()) for point in LISTS["points"]]
    readings = [tuple(reading.values()) for reading in LISTS["readings"]]
    return made.Lists(**{**LISTS, "points": points, "readings": readings, **changes})


def flags(made: Any, error: int = 0, mode: int = 0, position: int = 0, temperature: int = 0) -> Any:
    return made.Flags(error, mode, position, temperature)


def texts(made: Any, **changes: Any) -> Any:
    return made.Texts(**{"name": "", "note": "", **changes})


def tail(made: Any, **changes: Any) -> Any:
    return made.Tail(1, **changes)


def test_the_address_comes_first_and_the_running_number_by_name(everything: Any) -> None:
    assert everything.Numbers.__match_args__[0] == "station"
    assert everything.Numbers.__match_args__[-1] == "sequence"
    parameters = inspect.signature(everything.Lists).parameters
    assert next(iter(parameters)) == "station"
    assert parameters["sequence"].kind is inspect.Parameter.KEYWORD_ONLY
    assert parameters["sequence"].default == 0
    assert dict(everything.Lists.DEFAULTS) == {"sequence": 0}


def test_named_addresses_are_constants_and_may_lie_outside_the_range(everything: Any) -> None:
    kind = everything.Numbers
    assert (kind.STATION_ALL, kind.STATION_FIRST) == (65535, 1)
    assert numbers(everything, station=kind.STATION_ALL).station == 65535
    with pytest.raises(everything.EncodeError, match=r"station: 501 is outside 1\.\.500"):
        numbers(everything, station=501)


def test_several_ids_are_constants(everything: Any) -> None:
    kind = everything.Lists
    assert (kind.CLASS, kind.KIND, kind.VERSION, kind.IDS) == (1, 3, 9, (1, 3, 9))
    assert not hasattr(kind, "COMMAND")
    assert (everything.Flags.COMMAND, everything.Flags.IDS) == (1, (1,))


def test_named_bits_are_properties_and_masks(everything: Any) -> None:
    kind, found = everything.Flags, flags(everything, error=0x53, mode=1)
    assert (found.error_voltage, found.error_heat, found.error_code) == (True, True, 5)
    assert flags(everything).error_voltage is False
    assert (kind.ERROR_VOLTAGE, kind.ERROR_HEAT, kind.ERROR_CODE) == (0x01, 0x02, 0xF0)
    assert dict(kind.error.bits) == {"voltage": 0x01, "heat": 0x02, "code": 0xF0}


def test_bits_of_an_element_and_of_what_is_absent(everything: Any) -> None:
    point = everything.Point(x=1, flags=0b1101)
    assert (point.flags_near, point.flags_far) == (True, 6)
    assert everything.Tail(1).third_low is None
    assert everything.Tail(1, 2, 3, 1.5).third_low is True


def test_constants_and_reserved_bytes_are_no_fields(everything: Any) -> None:
    made = flags(everything)
    assert made.__match_args__ == ("error", "mode", "position", "temperature")
    frame = made.encode()
    assert (frame[5:6], frame[7:9]) == (b"\x04", b"\x01\x02")
    kinds = [type(each).__name__ for each in everything.Flags.CONSTANTS]
    assert kinds == ["Always", "Reserved", "Reserved", "Always"]


def test_reserved_bytes_are_kept_whatever_they_are(everything: Any) -> None:
    made = flags(everything)
    body = made.encode()[2:7] + b"\xaa\xbb" + made.encode()[9:-1]
    frame = b"\xbe\xef" + body + bytes([sum(body) & 0xFF])
    read = everything.Flags.decode(frame)
    assert read.encode() == frame
    assert read.to_dict() == made.to_dict()
    assert read != made
    assert pickle.loads(pickle.dumps(read)).encode() == frame  # noqa: S301 - it is our own


@in_turn("present, size", lambda: [((), 8), ((2,), 9), ((2, 3, 1.5), 16)])
def test_what_is_absent_is_none(everything: Any, present: tuple[Any, ...], size: int) -> None:
    # Where nothing is there, the checksum follows: no value that a field could have.
    tail = everything.Tail(200, *present)
    assert (tail.second, tail.third, tail.fourth) == (*present, *[None] * (3 - len(present)))
    assert len(tail.encode()) == size
    assert everything.Tail.decode(tail.encode()) == tail
    assert everything.Tail.from_dict(tail.to_dict()) == tail


def test_what_is_absent_has_no_value_to_compare(everything: Any) -> None:
    """Limits and replies are compared by column: of what is absent, there is none."""
    assert column(everything.Tail(1), "second") == []
    assert column(everything.Tail(1, second=7), "second") == [7]


@in_turn(
    "changes, problem",
    lambda: [
        ({"a_u8": 2}, r"a_u8: 2 is outside 3\.\.200"),
        ({"a_u8": True}, "a_u8: True is a truth value, not a whole number"),
        ({"a_u24": 1 << 24}, r"a_u24: 16777216 is outside 0\.\.16777215"),
        ({"little_i24": -8388609}, r"little_i24: -8388609 is outside -8388608\.\.8388607"),
        ({"a_u64": 1 << 64}, r"a_u64: 18446744073709551616 is outside 0\.\."),
        ({"an_i8": 128}, r"an_i8: 128 is outside -128\.\.127"),
        ({"a_u32": 1 << 32}, r"a_u32: 4294967296 is outside 0\.\.4294967295"),
        ({"little_i32": 1 << 31}, r"little_i32: 2147483648 is outside -2147483648\.\.2147483647"),
        ({"an_i16": 301}, r"an_i16: 301 is outside -300\.\.300"),
        ({"little_u16": 0}, r"little_u16: 0 is outside 1\.\.1000"),
        ({"an_f32": "1"}, "an_f32: '1' is not a number, but a str"),
        ({"an_f32": None}, "an_f32: None is not a number, but nothing"),
        ({"an_f64": True}, "an_f64: True is a truth value, not a number"),
        ({"an_f64": 10**400}, "an_f64: an integer of 1329 bits is outside -1.797"),
        ({"little_f32": 1e39}, "little_f32: 1e.39 is outside -3.402"),
        ({"sequence": 256}, r"sequence: 256 is outside 0\.\.255"),
        ({"station": 0}, r"station: 0 is outside 1\.\.500"),
    ],
)
def test_a_bad_number_is_named(everything: Any, changes: dict[str, Any], problem: str) -> None:
    with pytest.raises(everything.EncodeError, match=problem) as raised:
        numbers(everything, **changes)
    (path,) = changes
    assert (raised.value.path, raised.value.value) == (path, changes[path])


@in_turn(
    "make, changes, problem",
    lambda: [
        (lists, {"channels": [0] * 7}, "channels: 7 numbers, and there are always 8"),
        (lists, {"channels": [0] * 7 + [2048]}, r"channels\[7\]: 2048 is outside 0\.\.2047"),
        (lists, {"channels": "12345678"}, "channels: '12345678' is not a list of whole numbers"),
        (lists, {"low_bits": [0, 0, 10, 0]}, r"low_bits\[2\]: 10 is outside 0\.\.9"),
        (lists, {"triple": [0, 0]}, r"triple: 2 items is outside 3\.\.3"),
        (lists, {"triple": [0, 6, 0]}, r"triple\[1\]: 6 is outside -5\.\.5"),
        (lists, {"angles": [0, "1"]}, r"angles\[1\]: '1' is not a number, but a str"),
        (lists, {"points": [(1, 2), (1, 256)]}, r"points\[1\]\.flags: 256 is outside 0\.\.255"),
        (lists, {"points": [(1, 2), (1,)]}, r"points\[1\]: \(1,\) is not \(x, flags\)"),
        (lists, {"readings": [READING] * 21}, r"readings: 21 items is outside 0\.\.20"),
        *(
            (lists, {"readings": [(label, 1, quality, 1)]}, rf"readings\[0\]\.{problem}")
            for label, quality, problem in (
                ("VBATT", 1, "label: 5 characters, and there is"),
                ("\xb0C", 1, "label: '\xb0' at 0 is not a char"),
                ("C", 101, r"quality: 101 is outside 0\.\.100"),
            )
        ),
        (texts, {"name": "123456789"}, "name: 9 characters, and there is room for 8"),
        (texts, {"note": "x" * 41}, r"note: 41 characters is outside 0\.\.40"),
        (texts, {"note": "\xe9"}, "note: '\xe9' at 0 is not a character of ASCII"),
        (texts, {"name": b"a"}, "name: b'a' is not text, but a bytes"),
        (tail, {"third": 1}, "second: it is absent, and third behind it is not: give"),
        (tail, {"second": 1, "third": 1}, "fourth: no frame ends before it: give fourth, or none"),
        (tail, {"second": 100}, r"second: 100 is outside 0\.\.99"),
        (tail, {"second": 1, "third": 1, "fourth": 1e39}, "fourth: 1e.39 is outside -3.40"),
    ],
)
def test_a_bad_list_text_and_tail_is_named(
    everything: Any, make: Callable[..., Any], changes: dict[str, Any], problem: str
) -> None:
    with pytest.raises(everything.EncodeError, match=problem):
        make(everything, **changes)


@in_turn(
    "at, byte, problem",
    lambda: [
        (5, 0x05, "layout is 05, and always 04"),
        (9, 0x0A, r"mode is 10, outside 0\.\.9"),
        (18, 0x01, "mark is 01 03, and always 02 03"),
    ],
)
def test_a_field_that_is_wrong_in_a_frame_is_named(
    everything: Any, at: int, byte: int, problem: str
) -> None:
    frame = bytearray(flags(everything).encode())
    frame[at] = byte
    with pytest.raises(everything.DecodeError, match=problem) as raised:
        everything.Flags.decode(frame)
    assert raised.value.reason is everything.Reason.OUT_OF_RANGE


def specimens(made: ModuleType) -> list[Any]:
    return [
        getattr(made, name).decode(example.hex)
        for name, layout in messages_of("everything").items()
        for example in layout.message.examples
    ]


def test_messages_are_values(everything: Any) -> None:
    names = {name: getattr(everything, name) for name in everything.__all__}
    for message in specimens(everything):
        assert eval(repr(message), names) == message  # noqa: S307 - it is our own
        assert pickle.loads(pickle.dumps(message)) == message  # noqa: S301 - it is our own
        assert type(message).from_dict(json.loads(json.dumps(message.to_dict()))) == message
        assert copy.copy(message) == message == message.__replace__()
        assert len({message, message.__replace__()}) == 1
        if sys.version_info >= (3, 13):
            assert copy.replace(message) == message


@in_turn("word", lambda: ["nan", "inf", "-inf"])
def test_what_json_has_no_number_for_comes_back_from_its_word(everything: Any, word: str) -> None:
    names = everything.Tail.__match_args__
    fields = dict(zip(names, (200, 2, 3, word), strict=True))
    assert str(everything.Tail.from_dict(fields).fourth) == word


def test_values_are_shown_in_json_as_they_are(everything: Any) -> None:
    for message in [*specimens(everything), everything.Tail(1), everything.Texts('"\\', "")]:
        assert json.loads(fields_in_json(message)) == message.to_dict()
    shown = fields_in_json(numbers(everything, an_f32=math.nan, an_f64=-math.inf))
    assert '"an_f32": "nan", "an_f64": "-inf"' in shown


def test_values_are_shown_in_words(everything: Any) -> None:
    shown = fields_as_text
    words = "error=3 (voltage, heat) mode=1 (busy) position=65535 (unknown) temperature=0"
    assert shown(flags(everything, 3, 1, 65535)) == words
    assert shown(flags(everything, 0x52, 1)).startswith("error=82 (heat, code 5) ")
    assert shown(everything.Tail(1, 2)) == "first=1 second=2"
    assert shown(everything.Texts("a b", "c:d,e%")) == "name=a%20b note=c%3Ad%2Ce%25"
    reading = "readings=VBAT:12.5:99:-300"
    assert shown(lists(everything)).endswith(f"points=1:5,70000:0 {reading} sequence=0")
    assert "an_f32=1.5 m " in shown(numbers(everything))


@in_turn(
    "kind, words, given",
    lambda: [
        ("Flags", "error=voltage+heat mode=busy position=unknown temperature=0x10", (3, 1, -1, 16)),
        ("Tail", "first=1", (1,)),
        ("Tail", "first=1 second=2", (1, 2)),
        ("Texts", "name=a%20b note=%", ("a b", "%")),
        ("Texts", "name= note=", ("", "")),
        ("Rest", "values=-1,300", ([-1, 300],)),
        ("Rest", "values=", ([],)),
    ],
)
def test_values_are_read_from_words(
    everything: Any, kind: str, words: str, given: tuple[Any, ...]
) -> None:
    made = getattr(everything, kind)
    expected = made(*(0xFFFF if value == -1 else value for value in given))
    assert message_from_text(made, words.split(" ")) == expected


def test_an_example_is_written_for_the_command_as_it_is_read(everything: Any) -> None:
    model = compiled_file(FILES["everything"]).model
    for layout in model.messages.values():
        kind = getattr(everything, layout.name)
        for example in layout.message.examples:
            words = MessageView(layout, model).command_words(example.values)
            made = message_from_text(kind, words)
            assert made.encode() == example.hex


@in_turn(
    "kind, words, problem",
    lambda: [
        ("Tail", "second=1", r"needs first; it is written Tail first=FIRST \[second=SECOND\]"),
        ("Flags", "error=smoke", "'smoke' is no number: write it like 12 or 0x0C, or voltage"),
        ("Tail", "first=1 fourth=x", "fourth: 'x' is no number: write it like 1.5"),
        ("Lists", "station=1 channels=1,x", r"channels\[1\]: 'x' is no number"),
        ("Lists", "readings=a:1", r"readings\[0\]: 'a:1' is not label:value:quality:delta"),
        ("Lists", "", r"channels=CHANNELS,\.\.\. .* points=X:FLAGS,\.\.\."),
    ],
)
def test_words_that_are_no_values_are_named(
    everything: Any, kind: str, words: str, problem: str
) -> None:
    with pytest.raises(Exception, match=problem):
        message_from_text(getattr(everything, kind), words.split())


def test_an_element_is_a_tuple_with_names(everything: Any) -> None:
    (reading,) = lists(everything).readings
    assert reading == READING
    assert isinstance(reading, everything.Reading)
    assert repr(reading) == "Reading(label='VBAT', value=12.5, quality=99, delta=-300)"
    assert reading._replace(label="X").label == "X"
    assert pickle.loads(pickle.dumps(reading)) == reading  # noqa: S301 - it is our own
    assert lists(everything).points[0] == POINT


def test_every_field_has_its_documentation(everything: Any) -> None:
    assert everything.Numbers.station.__doc__ == "Who is meant."
    assert everything.Flags.error_voltage.__doc__.startswith("The voltage is wrong.")
    assert everything.Flags.temperature.__doc__ == "How warm it is. A step is 0.125 °C - 256."
    for kind in everything.MESSAGES:
        for name in kind.__match_args__:
            assert getattr(kind, name).__doc__


def test_a_notebook_shows_every_part(everything: Any) -> None:
    strip = flags(everything, 3, 1, 65535)._repr_html_()
    for shown in ("what", "sum", "layout", "3 (voltage, heat)", "1 (busy)", "65535 (unknown)"):
        assert f">{shown}<" in strip
    strip = lists(everything)._repr_html_()
    for shown in ("300", "992, 0, 2047, 1, 2, 3, 4, 5", "x 1, flags 5 (near, far 2)"):
        assert shown in strip
    assert "third" not in everything.Tail(1, 2)._repr_html_()


@given(st.data())
def test_the_strategies_make_messages_of_every_kind(everything: Any, data: st.DataObject) -> None:
    strategies = import_module(f"{everything.__name__}.strategies")
    message = data.draw(strategies.messages())
    assert type(message).decode(message.encode()) == message
    again = type(message).from_dict(message.to_dict())
    assert again.encode() == message.encode()


# -------------------------------------------------------------------- the byte order of numbers
def test_the_order_is_that_of_most_numbers() -> None:
    assert order_of([]) == order_of([U8(), I8()]) == ANY_ORDER
    assert order_of([U8(), little.U16(), little.I16(), big.U16()]) == "<"
    assert order_of([big.U16(), little.U16(), U8(), big.U16()]) == ">"


@pytest.mark.parametrize("number", [little.U16(), big.U16()])
def test_a_list_in_one_order_is_read_at_once(number: Number) -> None:
    listed = List(4, number, 0, 9)
    assert listed.is_read
    data = listed.packed([1, 0x0203])
    assert data == b"".join(map(number.struct.pack, (1, 0x0203)))
    assert listed.numbers(b"head" + data) == (1, 0x0203)
