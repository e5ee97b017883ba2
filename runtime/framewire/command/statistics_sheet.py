"""Statistics of a line, on one screen for people, and as JSON for programs."""

from __future__ import annotations

import json
import sys
from datetime import datetime, timezone

from ..explain.words import scaled
from ..frame.free_name import freely_named
from ..frame.pluralize import pluralize
from ..recording.file import EITHER
from .sheet import Sheet

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence
    from typing import Any

    from ..frame.direction import Direction
    from ..line.link import Link
    from ..tables.stats.extremes import Extremes
    from ..tables.stats.statistics import Span, Statistics

_NONE = "-"
# Of so many channels or addresses each has its own range; of more, all have one.
_MOST_KEYS = 16
_SILENCES = 3


def as_json(found: Statistics, baud: float, link: Link) -> str:
    """Return all of it as a line of JSON, with times in seconds and shares from 0 to 1."""
    return json.dumps(
        {
            "bytes": found.size,
            "baud": baud,
            "wire_seconds": _wire(found.size, baud, link),
            "span": _span_in_json(found.span),
            "sent": [
                {
                    "from": _sender(direction),
                    "bytes": size,
                    "share": _share(size, found.size),
                    "load": _load(size, found.span, baud, link),
                }
                for direction, size in found.sent.items()
            ],
            "messages": [
                {
                    "message": each.name,
                    "direction": each.direction.value,
                    "count": each.count,
                    "share": _share(each.count, found.message_count),
                    "bytes": each.size,
                    "share_of_bytes": _share(each.size, found.size),
                    "per_second": _rate(each.count, found.span),
                    "median_gap": _rounded(each.median_gap),
                    "longest_gap": _rounded(each.longest_gap),
                }
                for each in found.messages
            ],
            "noise": {
                "bytes": found.noise_size,
                "share": _share(found.noise_size, found.size),
                "reasons": [
                    {"reason": each.reason.value, "count": each.count, "bytes": each.size}
                    for each in found.noise
                ],
                "unknown_frames": [
                    freely_named(each.numbers, ["count", "bytes"])
                    | {"count": each.count, "bytes": each.size}
                    for each in found.unknown
                ],
            },
            "silences": [
                {
                    "seconds": _rounded(each.seconds),
                    "time": _rounded(each.time),
                    "offset": each.offset,
                }
                for each in found.silences
            ],
            "values": [
                {
                    "message": each.quantity.layout.name,
                    "field": each.quantity.path,
                    "of": None if each.quantity.key is None else each.quantity.key.name,
                    "number": each.key,
                    "count": each.count,
                    "absent": each.absent,
                    "lowest": each.lowest,
                    "highest": each.highest,
                    "unit": each.quantity.slot.unit or None,
                }
                for each in found.ranges
            ],
        }
    )


def show(found: Statistics, name: str, baud: float, link: Link) -> None:
    """Print it on a screen."""
    sheet = Sheet(sys.stdout)
    count, noise = pluralize(found.message_count, "message"), pluralize(found.noise_size, "byte")
    share = f" ({_percent(_share(found.noise_size, found.size))})" if found.noise_size else ""
    sheet.heading(f"{name}: {pluralize(found.size, 'byte')}, {count}, {noise} of noise{share}")
    if not found.size:
        return
    sheet.paragraph(_when(found, baud, link))
    sheet.heading("who sent it")
    sheet.columns(_aligned(("", "bytes", "share", "load"), _sent(found, baud, link)))
    if found.messages:
        sheet.heading("messages")
        head = "", "count", "share", "bytes", "share", "per second", "median gap", "longest gap"
        sheet.columns(_aligned(head, _messages(found)))
    if found.noise_size:
        sheet.heading("noise")
        sheet.columns(_aligned(("", "count", "bytes", "share"), _noise(found)))
    if found.silences:
        sheet.heading("longest silences")
        rows = [
            (_duration(each.seconds), f"from {each.time:.3f} s on, until byte {each.offset}")
            for each in found.silences[:_SILENCES]
        ]
        sheet.columns(rows)
    ranges = [*_ranges(found.ranges)]
    if ranges:
        sheet.heading("values, from the lowest to the highest")
        sheet.columns(ranges)


def _when(found: Statistics, baud: float, link: Link) -> str:
    """Return in words how long it is, or why that is not known."""
    span = found.span
    if span is None:
        wire = _duration(_wire(found.size, baud, link))
        return f"No times in this capture. At {baud:g} baud, its bytes take {wire}."
    said = f"{_duration(span.seconds)} from the first event to the last"
    if span.clock is not None:
        began = datetime.fromtimestamp(span.clock, timezone.utc)
        said += f"; it begins {began:%Y-%m-%d %H:%M:%S} UTC"
    if span.recordings > 1:
        said += f"; {span.recordings} recordings stand behind each other"
    return f"{said}."


def _sent(found: Statistics, baud: float, link: Link) -> Iterator[tuple[str, ...]]:
    for direction, size in found.sent.items():
        load = _percent(_load(size, found.span, baud, link))
        yield _sender(direction), str(size), _percent(_share(size, found.size)), load
    if link.local_echo and len(found.sent) > 1:
        # Both ends share one wire.
        load = _percent(_load(found.size, found.span, baud, link))
        yield "the line", str(found.size), _percent(1.0), load


def _messages(found: Statistics) -> Iterator[tuple[str, ...]]:
    for each in found.messages:
        rate = _rate(each.count, found.span)
        yield (
            each.name,
            str(each.count),
            _percent(_share(each.count, found.message_count)),
            str(each.size),
            _percent(_share(each.size, found.size)),
            _NONE if rate is None else f"{rate:.2f}",
            _duration(each.median_gap),
            _duration(each.longest_gap),
        )


def _noise(found: Statistics) -> Iterator[tuple[str, ...]]:
    for each in found.noise:
        share = _percent(_share(each.size, found.size))
        yield each.reason.value, str(each.count), str(each.size), share
    for other in found.unknown:
        numbers = " ".join(f"{name}={number}" for name, number in other.numbers.items())
        share = _percent(_share(other.size, found.size))
        yield f"unknown frame {numbers or 'of others'}", str(other.count), str(other.size), share


def _ranges(ranges: Iterable[Extremes]) -> Iterator[tuple[str, str]]:
    """Yield each number with its range, or that of each channel or address."""
    by_name: dict[str, list[Extremes]] = {}
    for each in ranges:
        by_name.setdefault(each.quantity.name, []).append(each)
    for name, some in by_name.items():
        key, slot = some[0].quantity.key, some[0].quantity.slot
        unit = f" {slot.unit}" if slot.unit else ""
        if key is None or (len(some) == 1 and some[0].key is None):
            yield name, f"{_range(some)}{unit}{_scaled(some)}{_absent(some)}"
        elif len(some) > _MOST_KEYS:
            about = f", {len(some)} numbers as {key.name}"
            yield name, f"{_range(some)}{unit}{_scaled(some)}{_absent(some)}{about}"
        else:
            every = (f"{each.key}:{_range([each])}{_absent([each])}" for each in some)
            yield name, f"{key.name} {', '.join(every)}{unit}"


def _range(some: Sequence[Extremes]) -> str:
    return "..".join(map(str, _ends(some))) or _NONE


def _scaled(some: Sequence[Extremes]) -> str:
    """Return the range in the larger unit, if there is one."""
    scale = some[0].quantity.slot.scale
    if scale is None or not _ends(some):
        return ""
    ends = "..".join(f"{scaled(scale, end):f}" for end in _ends(some))
    return f" = {ends} {scale.unit}".rstrip()


def _absent(some: Sequence[Extremes]) -> str:
    absent = sum(each.absent for each in some)
    return f" ({absent} absent)" if absent else ""


def _ends(some: Sequence[Extremes]) -> list[float]:
    """Return the lowest value and the highest: one, if they are the same; none without values."""
    low = [each.lowest for each in some if each.lowest is not None]
    high = [each.highest for each in some if each.highest is not None]
    return [*dict.fromkeys((min(low), max(high)))] if low else []


def _aligned(head: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> list[tuple[str, ...]]:
    """Return a table whose columns but the first are numbers, without those that are unknown."""
    names, *columns = zip(head, *rows, strict=True)
    known = [column for column in columns if {*column[1:]} != {_NONE}]
    widths = [max(map(len, column)) for column in known]
    padded = [
        [f"{cell:>{width}}" for cell in column] for column, width in zip(known, widths, strict=True)
    ]
    return [*zip(names, *padded, strict=True)]


def _sender(direction: Direction | None) -> str:
    return EITHER if direction is None else direction.sender


def _share(part: int, whole: int) -> float:
    return part / whole if whole else 0.0


def _percent(share: float | None) -> str:
    return _NONE if share is None else f"{share:.1%}"


def _wire(size: int, baud: float, link: Link) -> float:
    """Return how many seconds bytes take on the wire."""
    return size * link.bits_per_byte / baud


def _load(size: int, span: Span | None, baud: float, link: Link) -> float | None:
    """Return the share of the time in which bytes were on the wire."""
    return None if span is None or not span.seconds else _wire(size, baud, link) / span.seconds


def _rate(count: int, span: Span | None) -> float | None:
    return None if span is None or not span.seconds else count / span.seconds


def _span_in_json(span: Span | None) -> dict[str, Any] | None:
    if span is None:
        return None
    clock = None
    if span.clock is not None:
        clock = datetime.fromtimestamp(span.clock, timezone.utc).isoformat()
    return {
        "first": span.first,
        "last": _rounded(span.last),
        "seconds": _rounded(span.seconds),
        "clock": clock,
        "recordings": span.recordings,
    }


def _rounded(seconds: float | None) -> float | None:
    """Return a time to the microsecond, as recordings have it."""
    return None if seconds is None else round(seconds, 6)


def _duration(seconds: float | None) -> str:
    """Return a time with as many digits as matter: `4.2 ms`, `1.25 s`, `12:05 min`, `3:02 h`."""
    if seconds is None:
        return _NONE
    if seconds < 1:
        return f"{seconds * 1e3:.1f} ms"
    if seconds < 60:
        return f"{seconds:.2f} s"
    minutes = round(seconds) // 60
    if minutes < 60:
        return f"{minutes}:{round(seconds) % 60:02} min"
    return f"{minutes // 60}:{minutes % 60:02} h"
