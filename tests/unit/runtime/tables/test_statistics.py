"""Statistics of every protocol are those of its decoder's events, however a capture is cut."""

import math
from collections import Counter
from collections.abc import Iterator
from importlib import import_module
from types import ModuleType
from typing import Any

import busservo
import pytest
from framegen.language.values import Direction
from framewire.command import statistics_sheet
from framewire.explain.words import scaled
from framewire.tables.stats.statistics import statistics
from framewire.tables.stats.traces import Traces
from hypothesis import given
from hypothesis import strategies as st

from tests.few_each import few_each
from tests.handed import handed_by
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES
from tests.rows import some
from tests.unit.runtime.tables.rows import joined, rows_of_decoder
from tests.unit.runtime.tables.test_other_protocols import lines_of, ways_of

QUICK = {"lxservo", "everything"}
CASES = some(
    [pytest.param(name, way) for name in FILES for way in ways_of(name)],
    lambda name, way: name in QUICK and way is None,
)


def part(made: ModuleType, name: str) -> Any:
    return import_module(f"{made.__name__}.{name}")


def statistics_of(made: ModuleType, line: bytes, **how: Any) -> Any:
    return statistics(part(made, "_library").CODEC, line, form="raw", **how)


def traces_of(made: ModuleType) -> Any:
    library = part(made, "_library")
    return Traces(library.LINK.bits_per_byte / 9600, library.CODEC.received)


def _measured(
    made: ModuleType, name: str, way: Direction | None, data: st.DataObject
) -> tuple[bytes, Any, Any]:
    """Return a line, who sends on it, and its statistics."""
    line = data.draw(lines_of(name, made))
    direction = None if way is None else direction_of(made, way)
    return line, direction, statistics_of(made, line, direction=direction)


@pytest.mark.parametrize(("name", "way"), CASES)
@few_each
@given(data=st.data())
def test_statistics_are_those_of_the_decoder(
    libraries: Libraries, name: str, way: Direction | None, data: st.DataObject
) -> None:
    made = libraries[name]
    line, direction, found = _measured(made, name, way, data)
    rows = joined(rows_of_decoder(made, line, direction))
    messages = [row for row in rows if row.table not in ("noise", "unknown")]
    assert {each.name: each.count for each in found.messages} == Counter(
        row.table for row in messages
    )
    assert {each.name: each.size for each in found.messages} == _sizes(messages, "table")
    noise = [row for row in rows if row.table == "noise"]
    assert {each.reason.value: each.count for each in found.noise} == Counter(
        row.reason for row in noise
    )
    assert {each.reason.value: each.size for each in found.noise} == _sizes(noise, "reason")
    unknown = [row for row in rows if row.table == "unknown"]
    assert sum(each.count for each in found.unknown) == len(unknown)
    assert found.size == len(line)
    assert sum(found.sent.values()) == len(line)
    assert (found.span, found.silences) == (None, [])


def _sizes(rows: list[Any], by: str) -> dict[str, int]:
    sizes: Counter[str] = Counter()
    for row in rows:
        sizes[getattr(row, by)] += row.size
    return sizes


@pytest.mark.parametrize(("name", "way"), CASES)
@few_each
@given(data=st.data())
def test_ranges_are_those_of_the_messages(
    libraries: Libraries, name: str, way: Direction | None, data: st.DataObject
) -> None:
    made = libraries[name]
    line, direction, found = _measured(made, name, way, data)
    decoder = made.StreamDecoder(direction)
    values: dict[tuple[str, str], list[float]] = {}
    for event in [*decoder.feed(line), *decoder.flush()]:
        if isinstance(event, made.Message):
            for path, value in _numbers(event):
                values.setdefault((type(event).__name__, path), []).append(value)
    ends: dict[tuple[str, str], list[float]] = {}
    counts: Counter[tuple[str, str]] = Counter()
    slots: dict[tuple[str, str], Any] = {}
    absent: dict[tuple[str, str], list[int]] = {}
    for each in found.ranges:
        key = each.quantity.layout.name, each.quantity.path.rstrip("_")
        counts[key] += each.count
        slots[key], absent[key] = each.quantity.slot, each.quantity.absent
        some = ends.setdefault(key, [])
        some += [end for end in (each.lowest, each.highest) if end is not None]
    for key, some in ends.items():
        there = [each for each in values[key] if math.isfinite(each) and each not in absent[key]]
        assert counts[key] == len(values[key])
        if getattr(slots[key], "signed_as", ""):
            there = [_signed(int(each), slots[key].size) for each in there]
        assert (min(some, default=None), max(some, default=None)) == (
            min(there, default=None),
            max(there, default=None),
        )


def _numbers(message: Any) -> Iterator[tuple[str, float]]:
    """Yield the numbers of a message by the paths that statistics give them."""
    for name, value in message.to_dict().items():
        path = name.rstrip("_")
        for element in value if isinstance(value, list) else [value]:
            if isinstance(element, dict):
                inner = ((f"{path}.{each}".rstrip("_"), element[each]) for each in element)
                yield from ((each, value) for each, value in inner if _is_number(value))
            elif _is_number(element):
                yield path, element


def _signed(value: int, size: int) -> int:
    return int.from_bytes(value.to_bytes(size, "big"), "big", signed=True)


def _is_number(value: object) -> bool:
    return isinstance(value, int | float)


@pytest.mark.parametrize("name", ["everything", "ubx", "sbus"])
@few_each
@given(data=st.data())
def test_statistics_can_be_shown_and_drawn(
    libraries: Libraries, name: str, data: st.DataObject
) -> None:
    made = libraries[name]
    line = data.draw(lines_of(name, made))
    traces = traces_of(made)
    found = statistics_of(made, line, traces=traces)
    sheet = statistics_sheet
    link = handed_by(made.__name__).link
    assert f'"bytes": {len(line)}' in sheet.as_json(found, 9600, link)
    sheet.show(found, "line.bin", 9600, link)
    for quantity, lines in traces.panels():
        for trace in lines.values():
            at, value = trace.points()
            assert len(at) == len(value) >= 1, quantity.name


def test_what_is_drawn_is_in_the_larger_unit(libraries: Libraries) -> None:
    made = libraries["crsf"]
    (place,) = (kind for kind in made.MESSAGES if "altitude" in kind.__match_args__)
    given = dict.fromkeys(place.__match_args__, 1) | {"altitude": 1234, "heading": 9050}
    traces = traces_of(made)
    line = place(**given).encode()
    found = statistics_of(made, line, traces=traces)
    drawn = {
        quantity.path: trace.points()[1].tolist()
        for quantity, lines in traces.panels()
        for trace in lines.values()
    }
    assert (drawn["altitude"], drawn["heading"]) == ([234.0], [pytest.approx(90.5)])
    # As whole numbers, values are those on the wire.
    (altitude,) = (each for each in found.ranges if each.quantity.path == "altitude")
    assert (altitude.lowest, altitude.highest) == (1234, 1234)
    assert scaled(altitude.quantity.slot.scale, 1234) == 234


def test_where_nothing_is_measured_other_numbers_are_drawn_first_those_of_the_device() -> None:
    asked, told = busservo.ActionGroupRun(8, 2), busservo.ActionGroupCompleted(8, 2)
    for messages, drawn in (([asked], asked), ([asked, told], told)):
        line = b"".join(each.encode() for each in messages)
        traces = traces_of(busservo)
        statistics_of(busservo, line, traces=traces)
        kinds = {quantity.layout.kind for quantity, _ in traces.panels()}
        assert kinds == {type(drawn)}
