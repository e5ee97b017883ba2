"""A codec in C conforms; and others, each wrong as public code really is, are found out."""

from itertools import chain, islice
from pathlib import Path

import pytest
from framegen.conformance.further import further
from framegen.conformance.program import Program
from framegen.conformance.questions import questions
from framegen.conformance.trial import Trial, hold

from tests.conformance.c_codecs import SOURCE, WRONG, Wrong, compile_codec, needs_compiler
from tests.specimens import BUSSERVO, data_of, layout_of

MODEL = layout_of(data_of(BUSSERVO))
FURTHER = 100

pytestmark = needs_compiler


def held(program: str, more: int = FURTHER) -> Trial:
    """What becomes of all that is published, and of some further questions."""
    asked = Program([program], timeout=10)
    try:
        return hold(MODEL, asked, chain(questions(MODEL), islice(further(MODEL, seed=1), more)))
    finally:
        asked.close()


@pytest.fixture(scope="module")
def right(tmp_path_factory: pytest.TempPathFactory) -> str:
    return compile_codec(tmp_path_factory.mktemp("right"))


def test_eighty_lines_of_c_conform(right: str) -> None:
    trial = held(right, more=500)
    assert (trial.differences, dict(trial.unsupported), trial.stopped) == ([], {}, "")
    assert trial.agreed == trial.asked > 1_000
    lines = SOURCE.read_text(encoding="utf-8").splitlines()
    assert len(lines) <= 80
    assert max(map(len, lines)) <= 100


@pytest.mark.parametrize("wrong", WRONG.values(), ids=list(WRONG))
def test_a_wrong_codec_is_found_out_by_a_small_case(wrong: Wrong, tmp_path: Path) -> None:
    trial = held(compile_codec(tmp_path, wrong.old, wrong.new))
    assert not trial.conforms
    assert {found.question.verb for found in trial.differences} == wrong.caught_by
    assert trial.smallest is not None
    assert trial.smallest.alone
    found = trial.smallest.difference
    assert found.question.line == wrong.smallest
    assert (found.expected[found.at], found.answered[found.at]) == wrong.parted
