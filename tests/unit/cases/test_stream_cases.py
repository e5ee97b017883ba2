"""The stream vectors: each shows one thing, all reasons are there, and few change at once."""

from functools import cache
from pathlib import Path

import pytest
from framegen.cases.stream_case import StreamCase, chunks, single_bytes
from framegen.cases.streams import senders_of, streams
from framegen.cases.unknown_id import unknown_id
from framegen.compile import compile_spec
from framegen.language.values import Direction
from framegen.model.model import Model
from framegen.model.stream import Event, ReferenceDecoder
from framewire.explain import refusals

from tests.factories import BUSSERVO, DEMO, compiled_file, compiled_of, data_of, layout_of
from tests.unit.runtime.codec.test_linear import many

OTHERS = [DEMO.with_name(f"{name}.yaml") for name in ("blinds", "lamp", "weather")]
SPECS = [BUSSERVO, DEMO, *OTHERS]
# Bytes of all lines of a protocol.
MOST = 20_000

each_spec = pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.stem)


@cache
def model_of(spec: Path) -> Model:
    return compiled_file(spec).model


@cache
def cases_of(spec: Path) -> list[StreamCase]:
    return [*streams(model_of(spec))]


def events_of(model: Model, case: StreamCase) -> list[Event | None]:
    return [*ReferenceDecoder(model, [case.direction], case.max_frame).follow(case.parts)]


@each_spec
def test_there_are_some_hundreds_and_they_are_short(spec: Path) -> None:
    cases = cases_of(spec)
    # However many messages there are: see Sender.small_frames.
    assert 70 <= len(cases) <= 400
    assert sum(len(part) for case in cases for part in case.parts if part) <= MOST


@each_spec
def test_each_has_a_title_and_bytes_of_its_own(spec: Path) -> None:
    cases = cases_of(spec)
    for what in ("title", "parts"):
        found = [(case.direction, case.max_frame, getattr(case, what)) for case in cases]
        assert len({*found}) == len(found)


@each_spec
def test_no_byte_is_lost_and_all_but_a_few_end_with_quiet(spec: Path) -> None:
    model = model_of(spec)
    for case in cases_of(spec):
        events = events_of(model, case)
        sent = b"".join(part for part in case.parts if part)
        said = b"".join(event.data for event in events if event)
        assert sent.startswith(said)
        assert (said == sent) != (", held " in case.title), case.title
        assert (case.parts[-1] is None) != ("before the line goes quiet" in case.title), case.title


@each_spec
def test_every_kind_of_event_occurs_in_each_direction(spec: Path) -> None:
    model = model_of(spec)
    for direction in model.directions:
        events = [
            event
            for case in cases_of(spec)
            if case.direction == direction
            for event in events_of(model, case)
        ]
        assert {event.kind for event in events if event} == {"message", "unknown", "noise"}
        messages = model.sent(direction)
        reasons = {
            *(refusals.BAD_HEADER, refusals.TOO_SHORT),
            *(refusals.UNKNOWN_COMMAND, refusals.LENGTH_MISMATCH),
        }
        if any(message.items for message in messages):
            reasons.add(refusals.COUNT_MISMATCH)
        if any(slot.narrowed for each in messages for slot in each.numbers_by_path.values()):
            reasons.add(refusals.OUT_OF_RANGE)
        assert {event.reason for event in events if event and event.reason} >= reasons
        names = {event.message.name for event in events if event and event.message}
        senders = senders_of(model, direction)
        assert names == {name for sender in senders for name in sender.small_frames}


@each_spec
def test_what_a_title_says_of_an_unknown_frame_is_so(spec: Path) -> None:
    model = model_of(spec)
    shown = {
        case.title: [event.kind for event in events_of(model, case) if event]
        for case in streams(model)
    }
    for title, kinds in shown.items():
        if title.startswith(("an unknown frame between", "an unknown frame byte by byte")):
            assert kinds.count("unknown") == 1, title
        if title.startswith("an unknown frame that holds an unknown frame"):
            assert kinds[0] == ("noise" if "and a frame" in title else "unknown"), title
        if title.startswith(("an unknown frame without its last", "an unknown frame with a pause")):
            assert "unknown" not in kinds, title


def test_frames_are_as_large_as_the_bound_and_larger() -> None:
    model = model_of(BUSSERVO)
    sizes = {
        len(event.data): event.kind
        for case in streams(model)
        if case.max_frame == 64
        for event in events_of(model, case)
        if event
    }
    assert sizes[64] != "noise"
    assert {kind for size, kind in sizes.items() if size > 64} == {"noise"}


def test_more_messages_make_no_more_lines() -> None:
    few, more = (len([*streams(compile_spec(many(number)).model)]) for number in (16, 64))
    assert few == more


def free_id(model: Model, direction: Direction) -> int | None:
    return unknown_id(model, direction, model.frame, model.frame.id)


def test_an_id_that_is_free_in_both_directions_is_preferred() -> None:
    data = data_of(DEMO)
    model = layout_of(data)
    here, there, *_ = model.directions
    assert free_id(model, here) == free_id(model, there) == 255
    data["messages"][model.sent(there)[0].name]["id"] = 255
    taken = compiled_of(data).derived
    assert taken is not None
    assert free_id(taken, here) == free_id(taken, there) == 254


def test_a_stream_is_cut_into_single_bytes_or_chunks() -> None:
    assert single_bytes(b"abc") == (b"a", b"b", b"c")
    assert chunks(b"abcde", 2) == (b"ab", b"cd", b"e")
