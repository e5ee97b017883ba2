"""In which order a spec has its messages is for people alone: frames are read alike.

A frame that is legal in several directions is read in the client's, where none is given.
"""

from typing import Any

import pytest
from framegen.cases.valid import valid_frames
from framegen.language.values import Direction
from framegen.model.codec import NotAFrame, decode
from framegen.model.model import Model
from framegen.model.stream import ReferenceDecoder
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO, DEMO, Data, compiled_of, data_of, library, library_files
from tests.few_each import few_each
from tests.protocols.specs import FILES

# Of the simplest kind and of others; with frames that are legal both ways, and without.
SPECS: dict[str, Data] = {
    "busservo": data_of(BUSSERVO),
    "lxservo": data_of(BUSSERVO.with_name("lxservo.yaml")),
    "greenhouse": data_of(DEMO),
    "modbus": data_of(FILES["modbus"]),
    "dynamixel1": data_of(FILES["dynamixel1"]),
}


def in_order(data: Data, order: list[str]) -> Data:
    return {**data, "messages": {name: data["messages"][name] for name in order}}


def client_last(data: Data) -> list[str]:
    client, messages = next(iter(data["endpoints"])), data["messages"]
    return sorted(messages, key=lambda name: messages[name]["direction"].startswith(client))


def read_as(model: Model, way: Direction | None, frame: bytes) -> str | None:
    try:
        return decode(model, way, frame).layout.name
    except NotAFrame:
        return None


def assert_read_alike(data: Data, order: list[str]) -> int:
    """Hold a library to the client's reading of each frame, in this order of messages.

    Return how many frames are legal in several directions.
    """
    compiled = compiled_of(in_order(data, order))
    model = compiled.model
    frames = list(dict.fromkeys(valid.data for valid in valid_frames(model)))
    readings = [[read_as(model, way, each) for way in model.directions] for each in frames]
    clients = [next(name for name in reading if name) for reading in readings]
    assert [read_as(model, None, each) for each in frames] == clients
    with library(library_files(compiled)) as made:
        assert [type(made.decode(each, None)).__name__ for each in frames] == clients
        assert streamed(made, frames) == [
            event.message.name
            for event in ReferenceDecoder(model, model.directions).follow([*frames, None])
            if event is not None and event.message is not None
        ]
    return sum(len(reading) - reading.count(None) > 1 for reading in readings)


def streamed(made: Any, frames: list[bytes]) -> list[str]:
    decoder = made.StreamDecoder(None)
    events = [event for each in frames for event in decoder.feed(each)] + decoder.flush()
    return [type(event).__name__ for event in events if isinstance(event, made.Message)]


@pytest.mark.parametrize(
    ("name", "both_ways"),
    [
        ("busservo", True),
        ("lxservo", False),
        ("greenhouse", False),
        ("modbus", True),
        ("dynamixel1", True),
    ],
)
def test_the_client_is_preferred_where_its_messages_stand_last(name: str, both_ways: bool) -> None:
    order = client_last(SPECS[name])
    assert order != [*SPECS[name]["messages"]]
    assert (assert_read_alike(SPECS[name], order) > 0) is both_ways


@few_each
@given(st.permutations([*SPECS["busservo"]["messages"]]))
def test_messages_may_stand_in_any_order(order: list[str]) -> None:
    assert assert_read_alike(SPECS["busservo"], order) > 0
