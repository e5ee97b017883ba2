"""vectors.json: cases for implementations in any language, true of the oracle.

That the library answers as they say is held by tests/contract/conformance/test_answerers.py.
"""

import json
from importlib.resources import files
from typing import Any

import pytest
from busservo import (
    Reason,
)
from framegen.cases.streams import senders_of
from framegen.cases.valid import range_ends

from tests import oracle
from tests.cases import CASES
from tests.factories import BUSSERVO, DEMO, compiled_file, compiled_of, data_of
from tests.in_turn import in_turn

VECTORS: dict[str, Any] = json.loads(
    files("busservo").joinpath("vectors.json").read_text(encoding="utf-8")
)
VALID: list[dict[str, Any]] = VECTORS["valid"]
UNENCODABLE: list[dict[str, Any]] = VECTORS["unencodable"]
INVALID: list[dict[str, Any]] = VECTORS["invalid"]
STREAMS: list[dict[str, Any]] = VECTORS["streams"]


@in_turn("vector", lambda: VALID, ids=lambda vector: f"{vector['message']}: {vector['title']}")
def test_the_oracle_agrees_with_a_valid_vector(vector: dict[str, Any]) -> None:
    frame = bytes.fromhex(vector["hex"])
    assert oracle.build(vector["message"], vector["fields"]) == frame
    assert oracle.parse(frame, vector["direction"]) == (vector["message"], vector["fields"])


@in_turn("vector", lambda: UNENCODABLE, ids=lambda vector: str(vector["title"]))
def test_the_oracle_refuses_values_that_no_frame_carries(vector: dict[str, Any]) -> None:
    with pytest.raises(oracle.OracleError):
        oracle.build(vector["message"], vector["fields"])


@in_turn("vector", lambda: INVALID, ids=lambda vector: f"{vector['direction']}: {vector['hex']}")
def test_the_oracle_refuses_an_invalid_vector(vector: dict[str, Any]) -> None:
    with pytest.raises(oracle.OracleError):
        oracle.parse(bytes.fromhex(vector["hex"]), vector["direction"])


def test_every_bound_is_overstepped() -> None:
    assert [each["title"] for each in UNENCODABLE if each["message"] == "ServoUnload"] == [
        "ServoUnload: 0 servo_ids",
        "ServoUnload: 253 servo_ids",
        "ServoUnload: a servo_ids of -1",
        "ServoUnload: a servo_ids of 256",
    ]


def scanned_events(vector: dict[str, Any]) -> list[list[object]]:
    """Return the oracle's events of a stream up to each quiet: noise as bytes, and joined."""
    stretches: list[list[object]] = [[]]
    for event in vector["events"]:
        found = stretches[-1]
        if event["event"] == "quiet":
            stretches.append([])
        elif event["event"] == "message":
            found.append((event["message"], event["fields"]))
        elif found and isinstance(found[-1], bytes):
            found[-1] += bytes.fromhex(event["hex"])
        else:
            found.append(bytes.fromhex(event["hex"]))
    return stretches


@in_turn("vector", lambda: [each for each in STREAMS if each["max_frame"] is None])
def test_the_oracle_agrees_with_a_stream(vector: dict[str, Any]) -> None:
    *stretches, last = map(bytes.fromhex, " ".join(vector["parts"]).split("quiet"))
    way = vector["direction"]
    *found, begun = scanned_events(vector)

    assert [oracle.scan(data, way) for data in stretches] == found
    # What else has been reported already depends on what is waited for.
    early = oracle.scan(last, way, quiet=False)
    assert oracle.messages_of(early) == oracle.messages_of(begun)


def test_the_vectors_cover_every_message() -> None:
    model = compiled_file(BUSSERVO).model
    assert {vector["message"] for vector in VALID} == {*model.messages}
    assert {vector["title"].split(":")[0] for vector in INVALID} == {*model.messages}
    senders = [each for way in model.directions for each in senders_of(model, way)]
    events = [event for vector in STREAMS for event in vector["events"]]
    assert {event["message"] for event in events if event["event"] == "message"} == {
        name for sender in senders for name in sender.small_frames
    }


def test_the_vectors_cover_every_reason_that_this_protocol_has() -> None:
    # No field has a range of its own here, narrower than its type, and nothing stands behind the
    # fields.
    absent = {Reason.OUT_OF_RANGE, Reason.BAD_CHECKSUM, Reason.BAD_TRAILER}
    reasons = {reason.value for reason in {*Reason} - absent}

    assert {vector["reason"] for vector in INVALID} == reasons
    seen = {event.get("reason") for vector in STREAMS for event in vector["events"]}
    assert seen == {*reasons, None} - {Reason.TRAILING_BYTES.value}


def test_the_vectors_cover_the_table_of_truth() -> None:
    covered = {(vector["direction"], vector["hex"]) for vector in VALID}
    published = [case for case in CASES if case.source[0].isdigit() or "captured" in case.source]

    assert published
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
