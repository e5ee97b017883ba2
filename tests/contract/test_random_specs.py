"""Any spec that the language can say: the reference codec and decoder, and a second reading."""

import json
from collections.abc import Sequence
from typing import Any

import pytest
from framegen.cases.invalid import invalid_frames
from framegen.cases.streams import streams
from framegen.cases.unencodable import unencodable
from framegen.cases.valid import valid_frames
from framegen.explain import explain
from framegen.language.spec import Spec
from framegen.language.values import Direction
from framegen.model.codec import Unencodable, decode, encode
from framegen.model.layout import MessageLayout
from framegen.model.model import Model, derive
from framegen.model.stream import Event, ReferenceDecoder
from framegen.model.verdict import weigh_whole
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.factories import Data, compiled_of
from tests.random_specs import WAYS, lines, specs, values_of, with_examples
from tests.second_reader import Reader


def model_of(data: Data) -> Model:
    return derive(Spec.model_validate(json.loads(json.dumps(data))))


@given(specs())
def test_a_spec_that_keeps_to_the_language_has_no_finding(spec: Data) -> None:
    findings = compiled_of(with_examples(spec)).findings
    # Which bytes two kinds of frames can share is not for a strategy to know.
    assume({"duplicate-id", "frame-prefix"}.isdisjoint(finding.rule for finding in findings))
    assert [finding.message for finding in findings] == []


@given(specs(), st.data())
def test_values_become_a_frame_that_has_them_again(spec: Data, data: st.DataObject) -> None:
    model, reader = model_of(spec), Reader(spec)
    name = data.draw(st.sampled_from([*model.messages]))
    values = data.draw(values_of(spec, name))
    message = model.messages[name]
    frame = encode(message, values)
    assert plain(reader.read(name, frame)) == plain(values)
    # Another message may be meant by the same bytes; by some of them, it makes no difference.
    begun = reader.begins([str(message.direction)], frame)
    found = decode(model, message.direction, frame)
    assert begun == (found.layout.name, len(frame))
    if found.layout is message:
        assert plain(found.values) == plain(values)
        assert encode(message, found.values, like=frame) == frame


@given(specs(), st.data())
def test_what_is_no_frame_is_explained_as_it_was_refused(spec: Data, data: st.DataObject) -> None:
    """The explanation knows the reason and the offset alone, and the verdict much more."""
    model = model_of(spec)
    way = Direction.parse(data.draw(directions_of(spec))[0])
    line = data.draw(lines_of(spec, model, [str(way)]))
    assume(line)
    bytes_ = line[: data.draw(st.integers(1, len(line)))]
    verdict = weigh_whole(model, [way], bytes_)
    (refused,) = explain(model, bytes_, [way]).refusals or (None,)
    assert (refused is None) == (verdict.message is not None)
    if refused is not None:
        assert (refused.reason, refused.offset) == (verdict.reason, verdict.offset)
        assert verdict.expected in refused.expected
        assert bytes_.startswith(b"".join(row.data for row in refused.rows))


def plain(values: Any) -> str:
    """Return values as text in which equal ones are equal, floating-point numbers among them."""
    return json.dumps(values, sort_keys=True)


@st.composite
def lines_of(draw: st.DrawFn, spec: Data, model: Model, ways: Sequence[str]) -> bytes:
    """Draw a line of some directions."""
    names = [name for name, each in spec["messages"].items() if each["direction"] in ways]
    drawn = draw(st.lists(st.sampled_from(names), min_size=1, max_size=3))
    frames = [encode(model.messages[name], draw(values_of(spec, name))) for name in drawn]
    for frame, name in zip([*frames], drawn, strict=True):
        frames.append(draw(changed(model.messages[name], frame)))
    return draw(lines(frames))


@st.composite
def changed(draw: st.DrawFn, message: MessageLayout, frame: bytes) -> bytes:
    """Draw a frame of which a byte is another, but the checksum right."""
    at = draw(st.integers(0, len(frame) - 1))
    other = bytes([draw(st.integers(0, 255))])
    return message.sealed(frame[:at] + other + frame[at + 1 :])


@st.composite
def directions_of(draw: st.DrawFn, spec: Data) -> list[str]:
    """Draw one direction of a protocol, or all of them."""
    ways = [way for way in WAYS if way in {m["direction"] for m in spec["messages"].values()}]
    return draw(st.sampled_from([*([way] for way in ways), ways]))


def decoder_of(model: Model, ways: Sequence[str], max_frame: int | None = None) -> ReferenceDecoder:
    return ReferenceDecoder(model, [Direction.parse(way) for way in ways], max_frame)


@given(specs(), st.data())
def test_a_line_is_read_as_by_trying_everything(spec: Data, data: st.DataObject) -> None:
    model = model_of(spec)
    ways = data.draw(directions_of(spec))
    line = data.draw(lines_of(spec, model, ways))
    decoder = decoder_of(model, ways)
    expected = Reader(spec).scan(ways, line)
    assert scanned(decoder, line) == expected
    assert b"".join(piece for _, piece in expected) == line
    # What is reported early stays, and little is held.
    cut = data.draw(st.integers(0, len(line)))
    early, late = split(decoder.decode_so_far(line[:cut])), split(decoder.decode(line))
    assert late[: len(early)] == early
    held = cut - sum(len(piece) for _, piece in early)
    assert held <= model.largest(decoder.directions)


def scanned(decoder: ReferenceDecoder, line: bytes) -> list[tuple[str, bytes]]:
    """Return the events as the second reading has them: what is guessed is noise, and joined."""
    found: list[tuple[str, bytes]] = []
    for event in decoder.decode(line):
        kind: str = event.kind
        if event.message is not None:
            kind = event.message.name
        elif kind == "unknown" and not decoder.weigh(line[event.at :]).proven:
            kind = "noise"
        if found and kind == found[-1][0] == "noise":
            found[-1] = ("noise", found[-1][1] + event.data)
        else:
            found.append((kind, event.data))
    return found


def split(events: Sequence[Event]) -> list[tuple[str, bytes]]:
    """Return the events with noise as single bytes."""
    return [
        piece
        for event in events
        for piece in (
            [("noise", bytes([byte])) for byte in event.data]
            if event.kind == "noise"
            else [(event.kind, event.data)]
        )
    ]


@given(specs())
def test_vectors_are_read_or_refused_as_they_say(spec: Data) -> None:
    model, reader = model_of(spec), Reader(spec)
    frames = [*valid_frames(model)]
    assert {each.message.name for each in frames} == set(model.messages)
    for frame in frames:
        assert plain(reader.read(frame.message.name, frame.data)) == plain(frame.values)
    for unfit in unencodable(model):
        with pytest.raises(Unencodable):
            encode(unfit.message, unfit.values)
    for wrong in invalid_frames(model):
        names = reader.names([str(wrong.direction)])
        assert [name for name in names if reader.read(name, wrong.data) is not None] == []
        assert wrong.offset <= len(wrong.data)


@given(specs(), st.data())
def test_stream_vectors_are_read_as_by_trying_everything(spec: Data, data: st.DataObject) -> None:
    model = model_of(spec)
    cases = [case for case in streams(model) if case.max_frame is None]
    # Each of them would take its time.
    for case in data.draw(st.lists(st.sampled_from(cases), max_size=3)):
        way = str(case.direction)
        line = b"".join(part for part in case.parts if part is not None)
        if len(line) < 200:
            assert scanned(decoder_of(model, [way]), line) == Reader(spec).scan([way], line)
        events = [*decoder_of(model, [way]).follow(case.parts)]
        assert line.startswith(b"".join(event.data for event in events if event is not None))
