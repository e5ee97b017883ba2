"""A codec in C conforms; and others, each wrong as public code really is, are found out."""

from collections.abc import Iterator
from functools import cache
from itertools import islice
from pathlib import Path

import pytest
from framegen.conformance import comparison
from framegen.conformance.further import further
from framegen.conformance.language import Question, answer
from framegen.conformance.program import Program
from framegen.conformance.questions import questions
from framegen.conformance.trial import Trial, hold
from framegen.model.model import Model

from tests.contract.conformance.c_codecs import SOURCE, WRONG, compile_codec, needs_compiler
from tests.factories import first_model
from tests.rows import some

MODEL = first_model()
FURTHER = 100

pytestmark = needs_compiler


@cache
def titled_questions(more: int) -> list[tuple[str, Question]]:
    """Return all published questions, and some more."""
    return [*questions(MODEL), *islice(further(MODEL, seed=1), more)]


@pytest.fixture(scope="module", autouse=True)
def _the_reference_answers_each_question_once() -> Iterator[None]:
    """Remember the reference's answers: all codecs get the same questions."""
    answers: dict[str, list[str]] = {}

    def known(model: Model, question: Question) -> list[str]:
        assert model is MODEL
        if question.line not in answers:
            answers[question.line] = answer(model, question)
        return answers[question.line]

    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(comparison, "answer", known)
        yield


def held(program: str, more: int = FURTHER) -> Trial:
    """Hold a codec to all questions, and return the result."""
    codec = Program([program], timeout=10)
    try:
        return hold(MODEL, codec, titled_questions(more))
    finally:
        codec.close()


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> str:
    return compile_codec(tmp_path_factory.mktemp("right"))


def test_eighty_lines_of_c_conform(right: str) -> None:
    trial = held(right, more=500)
    assert (trial.differences, dict(trial.unsupported), trial.stopped) == ([], {}, "")
    assert trial.agreed == trial.questions > 1_000
    lines = SOURCE.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 80
    assert max(map(len, lines)) <= 100


# Those that are found as others are.
ALIKE = {
    "a false header costs two bytes, so that a stray 55 costs a frame",
    "a frame of unknown command is noise",
    "what does not fit into 64 bytes is dropped",
    "numbers are read with their high byte first",
}


@pytest.mark.parametrize("name", some(WRONG, lambda name: name not in ALIKE))
def test_a_wrong_codec_is_found_out_by_a_small_case(name: str, tmp_path: Path) -> None:
    wrong = WRONG[name]
    trial = held(compile_codec(tmp_path, wrong.old, wrong.new))
    assert not trial.conforms
    assert {found.question.verb for found in trial.differences} == wrong.caught_by
    assert trial.smallest is not None
    assert trial.smallest.alone
    found = trial.smallest.difference
    assert found.question.line == wrong.smallest
    assert (found.expected[found.at], found.answered[found.at]) == wrong.parted
