"""The libraries of random specs: the same frames, refusals and streams as the reference."""

from collections.abc import Sequence
from itertools import pairwise
from typing import Any

import pytest
from framegen.cases.invalid import invalid_frames
from framegen.cases.streams import streams
from framegen.cases.unencodable import unencodable
from framegen.cases.valid import valid_frames
from framegen.language.values import Direction
from framegen.model.model import Model
from framegen.model.stream import Event, ReferenceDecoder
from hypothesis import assume, given
from hypothesis import strategies as st

from tests.contract.test_random_specs import plain
from tests.factories import Data, compiled_of, library, library_files
from tests.protocols.libraries import direction_of, made_of, values_in
from tests.protocols.streams import Told, joined, reported
from tests.random_specs import lines, specs, with_examples

# Of the streams of a spec, as many are tried; they are like those of others.
STREAMS = 12


@given(specs(), st.data())
def test_a_library_reads_and_writes_as_the_reference_does(spec: Data, data: st.DataObject) -> None:
    compiled = compiled_of(with_examples(spec))
    assume(not compiled.findings)
    with library(library_files(compiled)) as made:
        frames_agree(made, compiled.model)
        streams_agree(made, compiled.model, data)


def frames_agree(made: Any, model: Model) -> None:
    for valid in valid_frames(model):
        message = made_of(made, valid.message, dict(valid.values))
        assert message.encode() == valid.data
        read = made.decode(valid.data, direction_of(made, valid.message.direction))
        if type(read) is type(message):
            assert plain(values_in(valid.message, read)) == plain(valid.values)
    for unfit in unencodable(model):
        with pytest.raises(made.EncodeError):
            made_of(made, unfit.message, dict(unfit.values)).encode()
    for wrong in invalid_frames(model):
        with pytest.raises(made.DecodeError) as raised:
            made.decode(wrong.data, direction_of(made, wrong.direction))
        assert (raised.value.reason.value, raised.value.offset) == (wrong.reason, wrong.offset)


def streams_agree(made: Any, model: Model, data: st.DataObject) -> None:
    cases = [*streams(model)]
    frames = [valid.data for valid in valid_frames(model)]
    for case in data.draw(st.lists(st.sampled_from(cases), max_size=STREAMS)):
        assert_same(made, model, case.direction, case.parts, case.max_frame)
    way = data.draw(st.sampled_from(model.directions))
    line = data.draw(lines(frames))
    cuts = [0, *sorted(data.draw(st.lists(st.integers(0, len(line)), max_size=5))), len(line)]
    parts = [line[start:end] for start, end in pairwise(cuts)]
    assert_same(made, model, way, (*parts, None), None)


def assert_same(
    made: Any, model: Model, way: Direction, parts: Sequence[bytes | None], most: int | None
) -> None:
    expected = [*ReferenceDecoder(model, [way], most).follow(parts)]
    decoder = made.StreamDecoder(direction_of(made, way), most)
    found: list[Any] = []
    for part in parts:
        found += [*decoder.flush(), None] if part is None else decoder.feed(part)
    ours = (QUIET if each is None else reported(made, each) for each in found)
    told = joined(map(_told, expected)), joined(ours)
    if parts[-1] is None:
        assert told[1] == told[0]
    else:
        # Noise may be reported later, and no message.
        one, other = ([each for each in events if each[2] == ""] for events in told)
        assert one == other


QUIET: Told = ("quiet", b"", "")


def _told(event: Event | None) -> Told:
    if event is None:
        return QUIET
    if event.message is not None:
        return event.message.name, event.data, ""
    return event.kind, event.data, event.reason
