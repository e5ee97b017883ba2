"""What tables hold, and what decoders find, as rows in the order of the capture."""

import struct
from collections.abc import Iterable, Iterator
from datetime import datetime
from importlib import import_module
from types import ModuleType
from typing import Any, NamedTuple

from framegen.model.stream import Event as ReferenceEvent


class Row(NamedTuple):
    """One event: a message by its name, `noise` or `unknown`; what is not known of it is None."""

    table: str
    offset: int
    size: int
    direction: str | None = None
    reason: str | None = None
    time: float | None = None
    fields: Any = None
    clock: datetime | None = None

    @property
    def place(self) -> tuple[str, int, int, str | None]:
        """What every decoder can tell of it."""
        return self.table, self.offset, self.size, self.reason


def rows_in_tables(
    made: ModuleType,
    source: Any,
    direction: Any = None,
    *,
    block: int | None = None,
    form: str = "raw",
) -> list[Row]:
    """Return what the tables of a capture hold, read in blocks of some size."""
    tables: Any = import_module(f"{made.__name__}.tables")
    size = {} if block is None else {"block": block}
    rows: list[Row] = []
    for batches in tables.read_batches(source, form=form, direction=direction, **size):
        for name, batch in batches.items():
            assert batch.num_rows
            rows += [_row(name, values) for values in batch.to_pylist()]
    # Each table is in the order of the capture by itself.
    for name in {row.table for row in rows}:
        offsets = [row.offset for row in rows if row.table == name]
        assert offsets == sorted(offsets)
    return sorted(rows, key=lambda row: row.offset)


def _row(name: str, values: dict[str, Any]) -> Row:
    offset, size, direction, time, clock = (
        values.pop(each) for each in ("offset", "size", "direction", "time", "clock")
    )
    if name != "noise":
        return Row(name, offset, size, direction, None, time, exact(values), clock)
    reason = values.pop("reason")
    if values.pop("unknown"):
        return Row("unknown", offset, size, direction, reason, time, exact(values), clock)
    assert set(values.values()) <= {None}
    return Row("noise", offset, size, direction, reason, time, None, clock)


def rows_of_decoder(
    made: ModuleType, line: bytes, direction: Any = None, chunks: Iterable[bytes] = ()
) -> list[Row]:
    """Return what a stream decoder finds on a line that is quiet then."""
    decoder = made.StreamDecoder(direction)
    events = [event for chunk in [*chunks] or [line] for event in decoder.feed(chunk)]
    return joined(_told(made, [*events, *decoder.flush()], direction))


def _told(made: ModuleType, events: Iterable[Any], direction: Any) -> Iterator[Row]:
    offset = 0
    for event in events:
        is_message = isinstance(event, made.Message)
        data = event.encode() if is_message else event.data
        if is_message:
            sender = sender_of(made, event, direction)
            yield Row(type(event).__name__, offset, len(data), sender, fields=fields_of(event))
        else:
            yield noise_row(made, event, offset, None if direction is None else direction.value)
        offset += len(data)


# The names of columns that every table has; a field of such a name is another column.
_TAKEN = ("offset", "size", "direction", "time", "clock")


def fields_of(message: Any) -> Any:
    """Return what the columns of a message should hold."""
    fields = message.to_dict()
    return exact({f"{name}_" if name in _TAKEN else name: fields[name] for name in fields})


def noise_row(made: ModuleType, event: Any, offset: int, direction: str | None) -> Row:
    """Return the row of noise, or of an unknown frame."""
    is_unknown = isinstance(event, made.UnknownFrame)
    fields = None
    if is_unknown:
        numbers = dict.fromkeys(_ids(made)) | event.numbers
        fields = exact({**numbers, "parameters": event.parameters})
    name = "unknown" if is_unknown else "noise"
    return Row(name, offset, len(event.data), direction, event.reason.value, fields=fields)


def _ids(made: ModuleType) -> list[str]:
    """Return the names of all addresses and ids in frames."""
    codec: Any = import_module(f"{made.__name__}._library").CODEC
    slots = [slot for each in codec.protocol().envelopes.values() for slot in each.slots]
    return [slot.name for slot in slots if slot.role in ("address", "id")]


def sender_of(made: ModuleType, message: Any, direction: Any) -> str | None:
    """Return the direction of a message; None where it may have gone another way as well."""
    if direction is not None:
        return str(direction.value)
    ways = [way for way in made.Direction if _is_legal(made, message.encode(), way)]
    return message.DIRECTION.value if len(ways) == 1 else None


def _is_legal(made: ModuleType, frame: bytes, way: Any) -> bool:
    try:
        made.decode(frame, way)
    except made.DecodeError:
        return False
    return True


def joined(rows: Iterable[Row]) -> list[Row]:
    """Return rows with neighbouring noise of one reason joined."""
    whole: list[Row] = []
    for row in rows:
        last = whole[-1] if whole else None
        if last and row.table == "noise" and last._replace(offset=row.offset, size=row.size) == row:
            whole[-1] = last._replace(size=last.size + row.size)
        else:
            whole.append(row)
    return whole


def places_of_reference(events: Iterable[ReferenceEvent]) -> list[tuple[str, int, int, str | None]]:
    """Return the places of what the reference decoder finds."""
    return [
        (
            event.message.name if event.message else event.kind,
            event.at,
            len(event.data),
            event.reason or None,
        )
        for event in events
    ]


def exact(value: Any) -> Any:
    """Return a value with every float as its bits, so that equal means the same."""
    if isinstance(value, float):
        return struct.pack(">d", value)
    if isinstance(value, dict):
        return {name: exact(item) for name, item in value.items()}
    return [exact(item) for item in value] if isinstance(value, list) else value
