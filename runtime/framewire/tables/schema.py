"""The Arrow schemas of the tables: a column for each field, with its unit and its named values."""

from __future__ import annotations

import json
from functools import cache, cached_property
from typing import TYPE_CHECKING, Any

import pyarrow as pa

from ..protocol.slots import List, Number, Packed
from ..recording.layout import (
    NOISE,
    PARAMETERS,
    REASON_COLUMN,
    REASONS,
    UNKNOWN_COLUMN,
    layouts_of,
)
from .places import dtype_of

if TYPE_CHECKING:
    from ..codec.protocol_codec import ProtocolCodec
    from ..protocol.slots import Slot
    from ..recording.layout import Column, Layout, Layouts


# Of a column of few names, each is held once.
_NAMES = pa.dictionary(pa.int8(), pa.string())
REASON_NAMES = pa.array([each.value for each in REASONS], pa.string())
CLOCK = pa.timestamp("us", tz="UTC")

_EVENT: tuple[tuple[str, pa.DataType, dict[str, str]], ...] = (
    (
        "offset",
        pa.int64(),
        {"about": "The byte of the capture at which it begins.", "unit": "byte"},
    ),
    ("size", pa.uint32(), {"about": "How many bytes it has.", "unit": "byte"}),
    ("direction", _NAMES, {"about": "Who sent it to whom, where that is known."}),
    ("time", pa.float64(), {"about": "When it came, since the recording began.", "unit": "s"}),
    ("clock", CLOCK, {"about": "The time of day at which it came."}),
)


class Schemas:
    """The schemas of the tables of a protocol.

    `direction_names` are the names of the directions, in their order.
    """

    def __init__(self, layouts: Layouts) -> None:
        self.layouts = layouts
        self.direction_names = pa.array([each.value for each in layouts.directions], pa.string())
        self._made: dict[Layout, pa.Schema] = {}

    def every(self) -> dict[str, pa.Schema]:
        """Return the schema of each table, by name: one a message, and `noise`."""
        return {each.name: self.of(each) for each in self.layouts.every} | {NOISE: self.noise}

    def of(self, layout: Layout) -> pa.Schema:
        """Return the schema of the table of one message; made once."""
        made = self._made.get(layout)
        if made is None:
            made = self._made[layout] = self._schema_of(layout)
        return made

    def _schema_of(self, layout: Layout) -> pa.Schema:
        fields = [
            _field(each.name, arrow_type(layout, each), _said_of(each)) for each in layout.columns
        ]
        about = {
            "message": layout.name,
            "summary": layout.described.summary,
            "direction": layout.kind.DIRECTION.value,
            "protocol": self.layouts.described.title,
        }
        return pa.schema([*_event_fields(), *fields], metadata=about)

    @cached_property
    def noise(self) -> pa.Schema:
        """The schema of the table of noise and unknown frames."""
        numbers = [
            _field(column, kind, {"about": "Of an unknown frame."})
            for column, kind in self.unknown_numbers.values()
        ]
        is_unknown = {"about": "Whether it is a frame that is not known."}
        return pa.schema(
            [
                *_event_fields(),
                _field(REASON_COLUMN, _NAMES, {"about": "Why it is no message."}),
                _field(UNKNOWN_COLUMN, pa.bool_(), is_unknown),
                *numbers,
                _field(PARAMETERS, pa.binary(), {"about": "The fields of an unknown frame."}),
            ],
            metadata={
                "summary": "Noise and unknown frames.",
                "protocol": self.layouts.described.title,
            },
        )

    @cached_property
    def unknown_numbers(self) -> dict[str, tuple[str, pa.DataType]]:
        """Columns and types of the numbers that tell unknown frames apart, by their names."""
        # None is negative, and one of eight bytes needs all of its bits.
        return {
            name: (column, pa.uint64() if size == 8 else pa.int64())
            for name, (column, size) in self.layouts.unknown_columns.items()
        }


@cache
def schemas_of(codec: ProtocolCodec) -> Schemas:
    """Return the schemas of the tables of a protocol; made once."""
    return Schemas(layouts_of(codec))


def arrow_type(layout: Layout, column: Column) -> Any:
    """Return the type of the values of a field."""
    slot = column.slot
    if isinstance(slot, Packed):
        return pa.list_(pa.uint16() if slot.bits <= 16 else pa.uint32())
    if not isinstance(slot, List) or slot.text:
        return _plain_type(slot)
    names = layout.element_names(column)
    if not names:
        (number,) = column.fields
        return pa.list_(_field("item", _plain_type(number), _said(number)))
    pairs = zip(names, column.fields, strict=True)
    return pa.list_(
        pa.struct([_field(name, _plain_type(each), _said(each)) for name, each in pairs])
    )


def _plain_type(slot: Slot) -> pa.DataType:
    """Return the type of a number or a text."""
    return pa.from_numpy_dtype(dtype_of(slot)) if isinstance(slot, Number) else pa.string()


def _event_fields() -> list[pa.Field]:
    return [_field(name, kind, said) for name, kind, said in _EVENT]


def _field(name: str, kind: pa.DataType, said: dict[str, str]) -> pa.Field:
    return pa.field(name, kind, metadata=said)


def _said_of(column: Column) -> dict[str, str]:
    """Return what is known of a column; of bare numbers and characters, what each of them is."""
    slot = column.slot
    is_bare = isinstance(slot, List) and not slot.element
    return _said(column.fields[0]) | _said(slot) if is_bare else _said(slot)


def _said(slot: Slot) -> dict[str, str]:
    """Return what is known of a field, as metadata: text, or JSON."""
    texts = {key: getattr(slot, key, "") for key in ("about", "unit", "signed_as")}
    found = {key: text for key, text in texts.items() if text}
    scale = slot.scale if isinstance(slot, (Number, Packed)) else None
    if scale is not None:
        offset = scale.offset or "0"
        found["scale"] = json.dumps({"step": scale.step, "unit": scale.unit, "offset": offset})
    if isinstance(slot, Number) and slot.values:
        values = {name: each.value for name, each in slot.values.items()}
        found["values"] = json.dumps(values)
    if isinstance(slot, Number) and slot.bits:
        bits = {name: [each.low, each.high] for name, each in slot.bits.items()}
        found["bits"] = json.dumps(bits)
    return found
