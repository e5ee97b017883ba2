"""Every codec of this project is held to the published vectors, and shown to be able to fail."""

from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.contract.conformance.answerers import ANSWERERS
from tests.factories import BUSSERVO, DEMO, compiled_file, vectors_of
from tests.in_turn import in_turn
from tests.protocols.specs import FILES
from tests.rows import Rows
from tests.unit.conformance.harness import cases_of, differences, joined
from tests.unit.site.reference import NODE

SPECS = {
    "busservo": BUSSERVO,
    "demo": DEMO,
    **{
        each: DEMO.with_name(f"{each}.yaml")
        for each in ("blinds", "lamp", "taken_names", "weather")
    },
    **FILES,
}
# All kinds of frames and fields. The libraries of the smallest specs are held to the reference as
# well (test_reference.py), that of ubx in tests/contract/protocols; a page has the module's code.
USUAL = {
    "python": ["busservo", "taken_names", "everything", "lxservo", "modbus", "roboclaw"],
    "page": ["busservo", "taken_names", "everything"],
    "module": ["busservo", "everything", "lxservo", "modbus", "roboclaw", "sbus", "ubx", "visca"],
}
ROWS = Rows(
    [pytest.param(*row, id=f"{row[0]} of the usual") for row in USUAL.items()],
    others=[
        (language, [each for each in SPECS if each not in usual])
        for language, usual in USUAL.items()
    ],
)


@cache
def published(name: str) -> dict[str, Any]:
    return vectors_of(compiled_file(SPECS[name]))


@pytest.mark.parametrize(("language", "names"), ROWS)
def test_a_codec_says_what_the_vectors_say(language: str, names: list[str], tmp_path: Path) -> None:
    if language != "python" and NODE is None:
        pytest.skip("node is not installed")
    cases = {name: [*cases_of(published(name))] for name in names}
    asked = [(compiled_file(SPECS[name]), [c.question for c in cases[name]]) for name in names]
    answers = ANSWERERS[language](asked, tmp_path)
    assert differences([case for name in names for case in cases[name]], answers) == []


def test_every_vector_becomes_a_question() -> None:
    document = published("busservo")
    questions = [each.question.split()[0] for each in cases_of(document)]
    assert questions.count("encode") == len(document["valid"]) + len(document["unencodable"])
    assert questions.count("decode") == len(document["valid"]) + len(document["invalid"])
    assert questions.count("stream") == len(document["streams"])


@in_turn("spoilt", lambda: ["", "refused once", "frame 55", "message Nothing 55"])
def test_a_wrong_answer_to_any_question_is_seen(spoilt: str) -> None:
    questions = [*cases_of(published("demo"))]
    right = [each.answer for each in questions]
    assert differences(questions, right) == []
    wrong = [[*answer[:-1], spoilt] for answer in right]
    assert len(differences(questions, wrong)) == len(questions)


def test_noise_may_come_in_pieces_and_nothing_else_may() -> None:
    pieces = ["noise bad-header 00", "noise bad-header 01", "noise too-short 55", "quiet"]
    assert joined(pieces) == ["noise bad-header 0001", "noise too-short 55", "quiet"]
    whole = ["unknown 55", "unknown 55", "quiet", "quiet"]
    assert joined(whole) == whole
