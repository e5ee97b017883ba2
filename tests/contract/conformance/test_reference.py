"""The reference stream decoder: held to the oracle, which shares nothing with it; and the library,
questioned through the line language, to the reference."""

from collections.abc import Callable, Iterator
from contextlib import ExitStack
from functools import cache
from typing import TypeAlias

import pytest
from busservo import Direction
from framegen.conformance.language import Stream, answer, joined
from framegen.language.values import Direction as Way
from framegen.model.codec import values_of
from framegen.model.model import Model
from framegen.model.stream import Event, ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests import oracle
from tests.contract.conformance.strategies import lines_of, parts_of
from tests.factories import BUSSERVO, DEMO, compiled_file, data_of, files_of, layout_of, library
from tests.few_each import few_each
from tests.handed import answers_of
from tests.strategies import directions, lines, oracles

SERVO = compiled_file(BUSSERVO).model


def line(direction: Direction | None) -> ReferenceDecoder:
    ways = SERVO.directions
    return ReferenceDecoder(
        SERVO, ways if direction is None else [Way(direction.sender, direction.receiver)]
    )


def scanned(events: list[Event]) -> list[object]:
    """Return the events as the oracle has them: unknown frames are noise, all noise is joined."""
    found: list[object] = []
    for event in events:
        if event.message is not None:
            found.append((event.message.name, values_of(event.message, event.data)))
        elif found and isinstance(found[-1], bytes):
            found[-1] += event.data
        else:
            found.append(event.data)
    return found


@given(lines, directions)
def test_the_reference_finds_what_the_oracle_does(data: bytes, direction: Direction | None) -> None:
    assert scanned(line(direction).decode(data)) == oracle.scan(data, oracles(direction))


@given(lines, directions)
def test_the_reference_reports_as_early_as_the_oracle(
    data: bytes, direction: Direction | None
) -> None:
    reported = [
        event for event in scanned(line(direction).decode_so_far(data)) if type(event) is tuple
    ]
    early = oracle.scan(data, oracles(direction), quiet=False)
    assert reported == [event for event in early if not isinstance(event, bytes)]


# By spec, a library as a function from questions to answers.
Answers: TypeAlias = dict[str, Callable[[str], list[str]]]

OTHERS = ["demo", "blinds", "lamp", "weather"]


@pytest.fixture(scope="module")
def answers() -> Iterator[Answers]:
    found: Answers = {"busservo": answers_of("busservo")}
    with ExitStack() as libraries:
        for name in OTHERS:
            files = files_of(data_of(DEMO.with_name(f"{name}.yaml")))
            module = libraries.enter_context(library(files))
            found[name] = answers_of(module.__name__)
        yield found


@cache
def model_of(name: str) -> Model:
    return SERVO if name == "busservo" else layout_of(data_of(DEMO.with_name(f"{name}.yaml")))


@pytest.mark.parametrize("name", ["busservo", *OTHERS])
@few_each
@given(data=st.data())
def test_a_library_answers_as_the_reference_does(
    name: str, answers: Answers, data: st.DataObject
) -> None:
    model = model_of(name)
    way = data.draw(st.sampled_from(model.directions))
    parts = data.draw(parts_of(lines_of(model, way)))
    least, largest = model.frame.least, model.largest([way])
    max_frame = data.draw(st.just(largest) | st.just(64) | st.integers(least, largest))
    question = Stream(way, max_frame, (*parts, None))
    assert joined(answers[name](question.line)) == joined(answer(model, question))
    # Noise may be reported later, and no message.
    question = Stream(way, max_frame, tuple(parts))
    early = [line for line in answers[name](question.line) if line.startswith("message")]
    assert early == [line for line in answer(model, question) if line.startswith("message")]
