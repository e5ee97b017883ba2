"""The columns of tables: every field as the message has it, with its type and its meaning."""

import json
from importlib import import_module
from itertools import accumulate
from typing import Any

import busservo
import pyarrow as pa
import pytest
from busservo import strategies, tables
from framegen.language.values import Direction
from framegen.model.slots import Field, Items, Number, Packed, Text
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import DEMO, data_of, files_of, library
from tests.few_each import few_each
from tests.mutations.places import renamed
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES, messages_of
from tests.protocols.streams import LARGE, all_ways
from tests.rows import some
from tests.unit.runtime.tables.hostile import sealing
from tests.unit.runtime.tables.rows import Row, exact, fields_of, rows_in_tables
from tests.unit.runtime.tables.shown import is_shown

EVENT = ["offset", "size", "direction", "time", "clock"]

# --- Values --------------------------------------------------------------------------------------

each_way = pytest.mark.parametrize(
    ("name", "way"),
    some([pytest.param(*each, id=f"{each[0]}-{each[1].sender}") for each in all_ways()], is_shown),
)


@each_way
@few_each
@given(data=st.data())
def test_each_field_is_what_the_message_says(
    libraries: Libraries, name: str, way: Direction, data: st.DataObject
) -> None:
    """All messages of a direction, in one capture."""
    made, direction = libraries[name], direction_of(libraries[name], way)
    drawable: Any = import_module(f"{made.__name__}.strategies")
    kinds = [kind for kind in made.MESSAGES if kind.DIRECTION is direction]
    drawn = [data.draw(drawable._any_of(kind)) for kind in kinds * 2]
    sent = [message for message in drawn if len(message.encode()) <= LARGE]
    ends = [*accumulate((len(message.encode()) for message in sent), initial=0)]
    line = b"".join(message.encode() for message in sent)
    assert rows_in_tables(made, line, direction) == [
        Row(
            type(message).__name__,
            offset,
            len(message.encode()),
            direction.value,
            fields=fields_of(message),
        )
        for message, offset in zip(sent, ends, strict=False)
    ]


@given(st.lists(strategies.messages(busservo.Direction.HOST_TO_CONTROLLER), max_size=5))
def test_fields_of_the_servo_controller(sent: list[Any]) -> None:
    # Behind these bytes all of it is found at many places at once.
    line = b"".join(message.encode() for message in sent) + bytes(600)
    *rows, _ = rows_in_tables(busservo, line, busservo.Direction.HOST_TO_CONTROLLER)
    assert [(row.table, row.fields) for row in rows] == [
        (type(message).__name__, fields_of(message)) for message in sent
    ]


def test_numbers_at_the_ends_of_their_types(libraries: Libraries) -> None:
    made = libraries["everything"]
    codec: Any = import_module(f"{made.__name__}._library").CODEC
    envelope = codec.protocol().envelopes["ask"]
    (example,) = messages_of("everything")["Numbers"].message.examples
    plain, begin = example.hex, 11
    for filling in (b"\0", b"\xff", b"\x80", b"\x7f", bytes.fromhex("7FF8000000000001")):
        middle = (filling * 99)[: len(plain) - begin - 3]
        # The numbers with a range stay as they are.
        frame = bytearray(plain[:begin] + middle + plain[-3:])
        for at, size in ((29, 2), (58, 2)):
            frame[at : at + size] = plain[at : at + size]
        sealed = envelope.sealed(bytes(frame), [3])
        (row,) = rows_in_tables(made, sealed, made.Direction.ASKER_TO_TELLER)
        assert row.fields == fields_of(made.decode(sealed, made.Direction.ASKER_TO_TELLER))


TAIL = bytes.fromhex("BE EF 03 A5 0A 00 01 02 80 00 01 00 00 60 40 D6")
ABSENT = {"first": 1, "second": None, "third": None, "fourth": None}


def test_what_is_absent_is_null(libraries: Libraries) -> None:
    made = libraries["everything"]
    seal = sealing(made)
    frames = [
        TAIL,
        seal(bytes.fromhex("BE EF 03 A5 03 00 01 63 00")),
        seal(bytes.fromhex("BE EF 03 A5 02 00 01 00")),
    ]
    rows = rows_in_tables(made, b"".join(frames), made.Direction.TELLER_TO_ASKER)
    assert [row.fields for row in rows] == [
        exact({"first": 1, "second": 2, "third": 0x800001, "fourth": 3.5}),
        ABSENT | {"second": 99},
        ABSENT,
    ]


def test_every_character_of_ascii_is_text(libraries: Libraries) -> None:
    made = libraries["everything"]
    frame = made.Texts(name="\x01 ~\x7f", note="\x7f").encode()
    row, *_ = rows_in_tables(made, frame + bytes(600), made.Direction.TELLER_TO_ASKER)
    assert (row.table, row.fields) == ("Texts", {"name": "\x01 ~\x7f", "note": "\x7f"})


def test_zeros_within_a_text_are_part_of_it(libraries: Libraries) -> None:
    made = libraries["everything"]
    frame = made.Texts(name="a\0b", note="\0c\0").encode()
    (row,) = rows_in_tables(made, frame, made.Direction.TELLER_TO_ASKER)
    assert row.fields == {"name": "a\0b", "note": "\0c\0"}


# --- Names ---------------------------------------------------------------------------------------


def test_a_field_of_the_name_of_another_column_has_a_name_of_its_own() -> None:
    data = data_of(DEMO)
    taken = {"number": "time", "trim": "size", "uptime_s": "offset", "ramp_s": "clock"}
    for old, new in {**taken, "vent_id": "direction"}.items():
        data = renamed(data, old, new)
    with library(files_of(data)) as made:
        schemas = import_module(f"{made.__name__}.tables").schemas()
        for schema in schemas.values():
            assert len({*schema.names}) == len(schema.names)
        fields = {name for schema in schemas.values() for name in schema.names[len(EVENT) :]}
        assert fields >= {"time_", "size_", "offset_", "clock_", "direction_"}
        # Within an element nothing else has that name.
        (listed,) = (
            schema.field(name).type.value_type
            for schema in schemas.values()
            for name in schema.names
            if pa.types.is_list(schema.field(name).type)
            if pa.types.is_struct(schema.field(name).type.value_type)
        )
        assert listed.field(0).name == "direction"


def test_tables_are_called_as_messages_are() -> None:
    assert [*tables.schemas()] == [*(kind.__name__ for kind in busservo.MESSAGES), "noise"]
    assert tables.NOISE == "noise"


# --- Types and meanings --------------------------------------------------------------------------

TYPES = {
    "u8": pa.uint8(),
    "u16": pa.uint16(),
    "u24": pa.uint32(),
    "u32": pa.uint32(),
    "u64": pa.uint64(),
    "i8": pa.int8(),
    "i16": pa.int16(),
    "i24": pa.int32(),
    "i32": pa.int32(),
    "i64": pa.int64(),
    "f32": pa.float32(),
    "f64": pa.float64(),
}


def expected_type(slot: Field) -> pa.DataType:
    """Return the type of a column, by the type that the spec gives its field."""
    match slot:
        case Number():
            return TYPES[slot.number_type.name]
        case Text():
            return pa.string()
        case Packed():
            return pa.list_(pa.uint16() if slot.number_type.bits <= 16 else pa.uint32())
        case Items() if slot.text is not None:
            return pa.string()
        case Items() if slot.element is None:
            return pa.list_(expected_type(slot.fields[0]))
    return pa.list_(pa.struct([(each.name, expected_type(each)) for each in slot.fields]))


def expected_metadata(slot: Field) -> dict[str, Any]:
    """Return what is said of a column, by what the spec says of its field."""
    field: Any = slot.field
    said = {"about": field.about}
    for key in ("unit", "signed_as"):
        if getattr(field, key, None):
            said[key] = getattr(field, key)
    if getattr(field, "scale", None) is not None:
        scale = field.scale
        said["scale"] = {
            "step": f"{scale.step:f}",
            "unit": scale.unit,
            "offset": f"{scale.offset:f}",
        }
    if getattr(field, "values", None):
        said["values"] = {name: named.value for name, named in field.values.items()}
    if getattr(field, "bits", None):
        said["bits"] = {name: [bits.at.low, bits.at.high] for name, bits in field.bits.items()}
    return said


def metadata(column: pa.Field) -> dict[str, Any]:
    """Return what is said of a column."""
    said = {key.decode(): value.decode() for key, value in (column.metadata or {}).items()}
    return {
        key: json.loads(value) if key in ("scale", "values", "bits") else value
        for key, value in said.items()
    }


@pytest.mark.parametrize("name", some(FILES, is_shown))
def test_types_and_meanings_are_those_of_the_spec(libraries: Libraries, name: str) -> None:
    made = libraries[name]
    schemas = import_module(f"{made.__name__}.tables").schemas()
    for message, layout in messages_of(name).items():
        schema, kind = schemas[message], getattr(made, message)
        assert schema.names[: len(EVENT)] == EVENT
        columns = {column.name.rstrip("_"): column for column in [*schema][len(EVENT) :]}
        assert [*columns] == [each.name for each in layout.slots if each in layout.arguments]
        for slot in layout.arguments:
            column = columns[slot.name]
            assert column.type == expected_type(slot), (message, slot.name)
            assert metadata(column) == expected_metadata(slot), (message, slot.name)
        assert schema.metadata[b"message"].decode() == message
        assert schema.metadata[b"direction"].decode() == kind.DIRECTION.value
        assert schema.metadata[b"summary"].decode() == layout.message.summary


def test_tables_have_the_schemas_that_are_promised() -> None:
    frames = b"".join(bytes.fromhex(each) for each in ("55 55 02 07", "55 55 04 0F 4C 1D", "00"))
    for capture in (b"", frames, frames + bytes(600)):
        read = tables.read(capture, form="raw")
        for name, schema in tables.schemas().items():
            assert read[name].schema.equals(schema, check_metadata=True)
    assert tables.schemas() == tables.schemas()
