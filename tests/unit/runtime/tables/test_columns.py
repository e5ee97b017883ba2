"""The columns of tables: every field as the message has it, with its type and its meaning."""

import json
from importlib import import_module
from typing import Any

import busservo
import pyarrow as pa
import pytest
from busservo import tables
from framegen.model.slots import Field, Items, Number, Packed, Text
from framewire.explain import checksum
from pyarrow.types import is_list, is_struct

from tests.factories import DEMO, data_of, files_of, library
from tests.mutations.places import renamed
from tests.protocols.libraries import Libraries
from tests.protocols.specs import FILES, messages_of
from tests.rows import some
from tests.unit.runtime.tables.conftest import is_shown
from tests.unit.runtime.tables.rows import fields_of, rows_in_tables

EVENT = ["offset", "size", "direction", "time", "clock"]


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
        sealed = checksum.sealed(envelope, bytes(frame), [3])
        (row,) = rows_in_tables(made, sealed, made.Direction.ASKER_TO_TELLER)
        assert row.fields == fields_of(made.decode(sealed, made.Direction.ASKER_TO_TELLER))


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
        lists = [each.type for schema in schemas.values() for each in schema if is_list(each.type)]
        (listed,) = (each.value_type for each in lists if is_struct(each.value_type))
        assert listed.field(0).name == "direction"


def test_tables_are_called_as_messages_are() -> None:
    assert [*tables.schemas()] == [*(kind.__name__ for kind in busservo.MESSAGES), "noise"]
    assert tables.NOISE == "noise"


TYPES = {
    **{f"u{bits}": getattr(pa, f"uint{bits}")() for bits in (8, 16, 32, 64)},
    **{f"i{bits}": getattr(pa, f"int{bits}")() for bits in (8, 16, 32, 64)},
    "u24": pa.uint32(),
    "i24": pa.int32(),
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
    said = {key: getattr(field, key, None) for key in ("about", "unit", "signed_as")}
    if (scale := getattr(field, "scale", None)) is not None:
        step, offset = f"{scale.step:f}", f"{scale.offset:f}"
        said["scale"] = {"step": step, "unit": scale.unit, "offset": offset}
    values, bits = getattr(field, "values", None) or {}, getattr(field, "bits", None) or {}
    said["values"] = {name: named.value for name, named in values.items()}
    said["bits"] = {name: [each.at.low, each.at.high] for name, each in bits.items()}
    return {key: value for key, value in said.items() if value or key == "about"}


def metadata(column: pa.Field) -> dict[str, Any]:
    """Return what is said of a column."""
    said = {key.decode(): value.decode() for key, value in (column.metadata or {}).items()}
    in_json = {key: json.loads(said[key]) for key in ("scale", "values", "bits") if key in said}
    return said | in_json


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
