"""Every codec of this project is held to the published vectors, and shown to be able to fail."""

from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.contract.conformance.answerers import ANSWERERS
from tests.factories import BUSSERVO, DEMO, compiled_file, vectors_of
from tests.protocols.specs import FILES
from tests.unit.conformance.harness import cases_of, differences, joined
from tests.unit.site.reference import NODE

SPECS = [
    BUSSERVO,
    DEMO,
    *(DEMO.with_name(f"{name}.yaml") for name in ("blinds", "lamp", "taken_names", "weather")),
    *FILES.values(),
]


@cache
def published(spec: Path) -> dict[str, Any]:
    """Return the vectors of a spec."""
    return vectors_of(compiled_file(spec))


@pytest.mark.each_protocol
@pytest.mark.parametrize("spec", SPECS, ids=lambda spec: spec.stem)
@pytest.mark.parametrize("language", ANSWERERS)
def test_a_codec_says_what_the_vectors_say(language: str, spec: Path, tmp_path: Path) -> None:
    if language != "python" and NODE is None:
        pytest.skip("node is not installed")
    questions = [*cases_of(published(spec))]
    answers = ANSWERERS[language](
        compiled_file(spec), tmp_path, [each.question for each in questions]
    )
    assert differences(questions, answers) == []


def test_every_vector_becomes_a_question() -> None:
    document = published(BUSSERVO)
    questions = [each.question.split()[0] for each in cases_of(document)]
    assert questions.count("encode") == len(document["valid"]) + len(document["unencodable"])
    assert questions.count("decode") == len(document["valid"]) + len(document["invalid"])
    assert questions.count("stream") == len(document["streams"])


@pytest.mark.parametrize("spoilt", ["", "refused once", "frame 55", "message Nothing 55"])
def test_a_wrong_answer_to_any_question_is_seen(spoilt: str) -> None:
    questions = [*cases_of(published(DEMO))]
    right = [each.answer for each in questions]
    assert differences(questions, right) == []
    wrong = [[*answer[:-1], spoilt] for answer in right]
    assert len(differences(questions, wrong)) == len(questions)


def test_noise_may_come_in_pieces_and_nothing_else_may() -> None:
    pieces = ["noise bad-header 00", "noise bad-header 01", "noise too-short 55", "quiet"]
    assert joined(pieces) == ["noise bad-header 0001", "noise too-short 55", "quiet"]
    whole = ["unknown 55", "unknown 55", "quiet", "quiet"]
    assert joined(whole) == whole
