"""Events of a line, in words and as JSON: messages, noise, and frames of unknown command."""

from __future__ import annotations

import json

from ..codec.event_bytes import bytes_of
from ..codec.noise import Noise, UnknownFrame
from ..frame.bytes_like import format_hex
from ..frame.free_name import freely_named
from ..frame.pluralize import pluralize
from ..recording.file import EITHER, NOISE
from .values import fields_as_text, fields_in_json

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator
    from typing import Any

    from ..codec.counters import Counters
    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from ..frame.message import Message
    from ..recording.entry import Entry

# Noise that has the shape of a frame.
UNKNOWN = "unknown"
# What is said of an unknown frame beside its numbers: behind them, and all of it as JSON.
_PARAMETERS = "parameters"
_NOISE_KEYS = ["offset", "time", "from", "noise", "reason", _PARAMETERS]


def kinds(codec: ProtocolCodec) -> list[str]:
    """Return what an event may be called, whatever message it is: by who sent it, or noise."""
    return [*codec.senders, EITHER, NOISE, UNKNOWN]


def names_of(
    event: Message | Noise, direction: Direction | None, codec: ProtocolCodec
) -> list[str]:
    """Return the names of the messages that it may be; none for noise."""
    if isinstance(event, Noise):
        return []
    name = type(event).__name__
    return [name, *(kind.__name__ for kind in codec.twins(event))] if direction is None else [name]


def sender_of(event: Message | Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    """Return who sent it; `either` if that is unknown; or that it is noise."""
    if isinstance(event, Noise):
        return UNKNOWN if isinstance(event, UnknownFrame) else NOISE
    return origin_of(event, direction, codec)[0]


def origin_of(
    event: Message | Noise, direction: Direction | None, codec: ProtocolCodec
) -> tuple[str, list[str]]:
    """Return who sent it, noise or not, `either` if that is unknown; and the messages it may be."""
    if isinstance(event, Noise):
        return EITHER if direction is None else direction.sender, []
    names = names_of(event, direction, codec)
    return EITHER if len(names) > 1 else event.DIRECTION.sender, names


def in_words(event: Message | Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    """Return the name and the fields with their units; for noise, why it is noise."""
    if isinstance(event, UnknownFrame):
        parameters = format_hex(event.parameters) or "none"
        said = freely_named(event.numbers, [_PARAMETERS]) | {_PARAMETERS: parameters}
        return " ".join(f"{name}={value}" for name, value in said.items())
    if isinstance(event, Noise):
        return _why(event, direction, codec)
    name = " or ".join(names_of(event, direction, codec))
    return " ".join(part for part in (name, fields_as_text(event)) if part)


def in_json(event: Message | Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    """Return the text of a JSON object: who sent it, noise or not, and what it holds."""
    sender, names = origin_of(event, direction, codec)
    if isinstance(event, Noise):
        record: dict[str, Any] = {"from": sender, "noise": format_hex(event.data)}
        record["reason"] = event.reason.value
        if isinstance(event, UnknownFrame):
            record |= freely_named(event.numbers, _NOISE_KEYS)
            record[_PARAMETERS] = format_hex(event.parameters)
        return json.dumps(record)
    name, *others = names
    way, fields = event.DIRECTION.value, fields_in_json(event)
    what = f'"direction": "{way}", "message": "{name}", "fields": {fields}'
    either = f', "or": {json.dumps(others)}' if others else ""
    return (
        f'{{"from": {json.dumps(sender)}, {what}, "hex": "{format_hex(event.encode())}"{either}}}'
    )


def counted(entries: Iterable[Entry], seen: Counters) -> Iterator[Entry]:
    """Yield the entries of a recording, and count them."""
    for entry in entries:
        event = entry.event
        size = len(bytes_of(event))
        seen.fed += size
        if isinstance(event, Noise):
            seen.noise += size
            seen.unknown_frames += isinstance(event, UnknownFrame)
        else:
            seen.messages += 1
        yield entry


def totals(seen: Counters) -> str:
    """Return what a decoder has seen, in words."""
    unknown = (
        f", {pluralize(seen.unknown_frames, 'unknown frame')} in it" if seen.unknown_frames else ""
    )
    totals = f"{pluralize(seen.fed, 'byte')}: {pluralize(seen.messages, 'message')}"
    return f"{totals}, {pluralize(seen.noise, 'byte')} of noise{unknown}"


def _why(noise: Noise, direction: Direction | None, codec: ProtocolCodec) -> str:
    """Return the reason, and what was expected, if the bytes show it."""
    table = codec.table_for(direction)
    verdict = table.weigh(noise.data)
    if verdict.kind is None and verdict.reason is noise.reason:
        return f"{noise.reason.value}: {table.error(noise.data, verdict).problem}"
    return noise.reason.value
