"""vectors.json: cases for implementations in any language, true of this one and of the oracle."""

import json
from importlib.resources import files
from typing import Any

import busservo
import pytest
from busservo import MESSAGES, DecodeError, Direction, Reason
from framegen.cases.valid import range_ends

from tests import oracle
from tests.cases import CASES
from tests.lines import said
from tests.specimens import DEMO, compiled_of, data_of

VECTORS: dict[str, Any] = json.loads(
    files("busservo").joinpath("vectors.json").read_text(encoding="utf-8")
)
VALID: list[dict[str, Any]] = VECTORS["valid"]
INVALID: list[dict[str, Any]] = VECTORS["invalid"]
CLASSES: dict[str, Any] = {kind.__name__: kind for kind in MESSAGES}

each_valid = pytest.mark.parametrize(
    "vector", VALID, ids=lambda vector: f"{vector['message']}: {vector['title']}"
)
each_invalid = pytest.mark.parametrize(
    "vector", INVALID, ids=lambda vector: f"{vector['direction']}: {vector['hex']}"
)


def arguments(fields: dict[str, Any]) -> dict[str, Any]:
    """The fields of a vector as a message takes them: pairs instead of objects."""
    return {
        name: [tuple(item.values()) if isinstance(item, dict) else item for item in value]
        if isinstance(value, list)
        else value
        for name, value in fields.items()
    }


@each_valid
def test_a_valid_vector_is_encoded(vector: dict[str, Any]) -> None:
    message = CLASSES[vector["message"]](**arguments(vector["fields"]))

    assert message.encode() == bytes.fromhex(vector["hex"])
    assert message.DIRECTION is Direction(vector["direction"])


@each_valid
def test_a_valid_vector_is_decoded(vector: dict[str, Any]) -> None:
    message = busservo.decode(bytes.fromhex(vector["hex"]), Direction(vector["direction"]))

    assert said(message) == (vector["message"], vector["fields"])


@each_valid
def test_the_oracle_agrees_with_a_valid_vector(vector: dict[str, Any]) -> None:
    frame = bytes.fromhex(vector["hex"])

    assert oracle.build(vector["message"], vector["fields"]) == frame
    assert oracle.parse(frame, vector["direction"]) == (vector["message"], vector["fields"])


@each_invalid
def test_an_invalid_vector_is_refused(vector: dict[str, Any]) -> None:
    with pytest.raises(DecodeError) as caught:
        busservo.decode(bytes.fromhex(vector["hex"]), Direction(vector["direction"]))

    assert caught.value.reason is Reason(vector["reason"])
    assert caught.value.offset == vector["offset"]


@each_invalid
def test_the_oracle_refuses_an_invalid_vector(vector: dict[str, Any]) -> None:
    with pytest.raises(oracle.OracleError):
        oracle.parse(bytes.fromhex(vector["hex"]), vector["direction"])


def test_the_vectors_cover_every_message() -> None:
    assert {vector["message"] for vector in VALID} == set(CLASSES)
    assert {vector["title"].split(":")[0] for vector in INVALID} == set(CLASSES)


def test_the_vectors_cover_every_reason_that_this_protocol_has() -> None:
    # No field has a range of its own here, narrower than its type.
    reasons = {reason.value for reason in Reason if reason is not Reason.OUT_OF_RANGE}

    assert {vector["reason"] for vector in INVALID} == reasons


def test_the_vectors_cover_the_table_of_truth() -> None:
    covered = {(vector["direction"], vector["hex"]) for vector in VALID}
    published = [case for case in CASES if case.source[0].isdigit() or "captured" in case.source]

    assert len(published) == 15
    assert covered.issuperset({(case.direction.value, case.hex) for case in published})


def test_no_vector_is_there_twice() -> None:
    for vectors in (VALID, INVALID):
        frames = [(vector["direction"], vector["hex"]) for vector in vectors]
        assert len(frames) == len(set(frames))


@pytest.mark.parametrize(
    ("counter", "count", "items", "title"),
    [
        ("u8", "0..", 255, "every value at its highest"),
        ("u8", "0..8", 8, "every value at its highest"),
        ("u16", "0..256", 256, "every value at its highest"),
        ("u16", "0..257", 256, "every value at its highest, 256 items of up to 257"),
        ("u16", "0..", 256, "every value at its highest, 256 items of up to 32764"),
        ("u16", "300..", 300, "every value at its highest"),
        ("u32", "0..32763", 256, "every value at its highest, 256 items of up to 32763"),
    ],
)
def test_a_list_is_no_longer_than_to_need_two_bytes_of_its_count(
    counter: str, count: str, items: int, title: str
) -> None:
    data = data_of(DEMO)
    fields = data["messages"]["StationState"]["fields"]
    fields["reading_count"]["type"] = counter
    fields["readings"]["count"] = count
    model = compiled_of(data).derived
    assert model is not None
    ends = dict(range_ends(model.messages["StationState"]))
    assert [*ends] == ["every value at its lowest", title]
    assert len(ends[title]["readings"]) == items
