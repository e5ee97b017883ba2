"""The facts of a protocol as data, and back."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from framewire.protocol.form import data_of, message_data, protocol_of
from framewire.protocol.slots import Body, Constant, List, Number, Packed, Text

from tests.factories import BUSSERVO, compiled_file
from tests.in_turn import in_turn
from tests.protocols.specs import FILES

if TYPE_CHECKING:
    from framewire.protocol.protocol import Protocol


def facts_of(name: str) -> Protocol:
    return compiled_file(FILES.get(name, BUSSERVO)).model.protocol


@in_turn("name", lambda: ["busservo", *FILES])
def test_what_is_written_is_read_again(name: str) -> None:
    facts = facts_of(name)
    data = json.loads(json.dumps(data_of(facts)))
    assert protocol_of(data) == facts
    assert data_of(protocol_of(data)) == data
    assert protocol_of(with_one_more(data)) == facts


def with_one_more(data: Any) -> Any:
    """Return data with a key more wherever keys are those of the form, not names."""
    if isinstance(data, list):
        return [with_one_more(each) for each in data]
    if not isinstance(data, dict):
        return data
    more = {key: with_one_more(each) for key, each in data.items()}
    return more | {"of_tomorrow": [1]} if {"role", "title", "text", "summary"} & {*data} else more


AT: Any = {"name": "x", "at": 3, "size": 4}
RANGE: Any = {"low": 0, "high": 9}
# What is written of a slot beside its name and place, and the record that it is.
SLOTS = [
    ({"bytes": "55 AA"}, Constant(role="constant", **AT, data=b"\x55\xaa", order="big")),
    ({"type": "f32"}, Number(role="field", **AT, type="f32", order="big")),
    (
        {"type": "u8", **RANGE, "byte_order": "little"},
        Number(role="id", **AT, type="u8", **RANGE, order="little"),
    ),
    ({"charset": "ascii"}, Text(**AT, charset="ascii")),
    (
        {"packed": "u12", "count": 2, **RANGE},
        Packed(**AT, packed="u12", count=2, **RANGE, order="big"),
    ),
    ({**RANGE, "fixed": True, "fields": []}, List(**AT, **RANGE, is_fixed=True, fields=())),
    ({}, Body(**AT)),
]


@in_turn("more, slot", lambda: SLOTS)
def test_a_slot_is_a_record_by_its_role(more: Any, slot: Any) -> None:
    facts, said = facts_of("tfmini"), {"role": slot.role, **AT, **more}
    assert facts.byte_order == "little"
    facts = replace(facts, byte_order="big", envelopes={"frame": replace(facts.frame, slots=())})
    (found,) = protocol_of(data_of(facts) | {"frame": [said]}).frame.slots
    assert (type(found), found) == (type(slot), slot)
    written = replace(facts, envelopes={"frame": replace(facts.frame, slots=(slot,))})
    assert data_of(written)["frame"] == [said]


def test_a_number_says_its_byte_order_where_that_is_not_the_protocols() -> None:
    message = facts_of("busservo").messages["BatteryVoltage"]
    (said,), (other,) = (message_data(message, order)["fields"] for order in ("little", "big"))
    assert other == said | {"byte_order": "little"}
