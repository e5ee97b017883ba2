"""Protocols that others made: each spec holds what they read and write, and uses the language."""

from collections.abc import Iterator
from typing import Any

import pytest
from framegen.language import spec
from framegen.model.codec import Decoded, decode, encode
from hypothesis import given
from hypothesis import strategies as st
from pydantic import BaseModel

from tests.factories import BUSSERVO, compiled_file
from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.actuator_sdk import DynamixelSdk
from tests.protocols.by_hand import BY_HAND
from tests.protocols.peer import Peer
from tests.protocols.receiver_messages import Pyubx2
from tests.protocols.register_messages import Pymodbus
from tests.protocols.servo_clients import LewansoulLx16a, Pylx16a
from tests.protocols.specs import FILES, SPOKEN, messages_of, model_of, values_of

# What others wrote for the same protocols, from the package index. A peer is asked for as many
# messages as it knows, on a line that ends in this process; what it cannot say is narrowed.
PEERS: list[type[Peer]] = [LewansoulLx16a, Pylx16a, DynamixelSdk, Pymodbus, Pyubx2]


@pytest.mark.parametrize("name", FILES)
def test_a_spec_has_no_findings(name: str) -> None:
    compiled = compiled_file(FILES[name])
    assert [finding.render(compiled.source) for finding in compiled.findings] == []


@pytest.mark.parametrize("kind", [peer for peer in PEERS if peer.writes])
@in_turn("message", lambda kind: kind.writes)
@few_each
@given(data=st.data())
def test_a_peer_writes_the_same_bytes(kind: type[Peer], message: str, data: st.DataObject) -> None:
    layout = messages_of(kind.protocol)[message]
    values = kind.writes[message](data.draw(values_of(kind.protocol, message)))
    assert kind().write(message, values) == encode(layout, values)


@pytest.mark.parametrize("kind", [peer for peer in PEERS if peer.reads])
@in_turn("message", lambda kind: kind.reads)
@few_each
@given(data=st.data())
def test_a_peer_reads_the_same_values(kind: type[Peer], message: str, data: st.DataObject) -> None:
    layout = messages_of(kind.protocol)[message]
    values = kind.reads[message](data.draw(values_of(kind.protocol, message)))
    assert kind().read(message, encode(layout, values)) == values


@pytest.mark.parametrize("name", BY_HAND)
@in_turn("message", lambda name: BY_HAND[name])
@few_each
@given(data=st.data())
def test_a_frame_made_by_hand_has_these_bytes(name: str, message: str, data: st.DataObject) -> None:
    values, layout = data.draw(values_of(name, message)), messages_of(name)[message]
    frame = BY_HAND[name][message](values)
    assert frame == encode(layout, values)
    assert decode(model_of(name), layout.direction, frame) == Decoded(layout, values)


def test_every_message_is_held_to_what_others_write_or_read() -> None:
    held = {(name, message) for name in BY_HAND for message in BY_HAND[name]}
    held |= {(peer.protocol, name) for peer in PEERS for name in [*peer.writes, *peer.reads]}
    spoken = {(name, message) for name in SPOKEN for message in messages_of(name)}
    assert held == spoken


# A part that is more than a byte or has notes, a citation, and what only a later version has.
UNUSED = {
    ("LengthPart", "byte_order"),
    ("IdPart", "byte_order"),
    ("AddressPart", "byte_order"),
    ("CounterPart", "byte_order"),
    *((kind, "notes") for kind in ("ConstantPart", "ReservedPart", "LengthPart", "IdPart")),
    *((kind, "notes") for kind in ("BodyPart", "AddressPart", "CounterPart", "ChecksumPart")),
    ("NamedAddress", "cite"),
    ("NumberField", "cite"),
    ("ListField", "cite"),
    ("Message", "since"),
    ("Message", "deprecated"),
    ("Reserved", "name"),
    # What earlier editions were like: tests/unit/comparison has editions that say so.
    *((kind, "was") for kind in ("Message", "NumberField", "ListField", "NamedValue", "Bits")),
    *((kind, "was") for kind in ("AddressPart", "CounterPart", "NamedAddress")),
    ("Release", "breaks"),
    # No protocol has a word of its own for whoever commands it: tests/unit/targets has one.
    ("Protocol", "client"),
}


def keys_in(value: Any) -> Iterator[tuple[str, str]]:
    """Yield the keys that a spec uses, each with the name of the mapping that has it."""
    if isinstance(value, BaseModel):
        for key in value.model_fields_set:
            yield type(value).__name__, key
            yield from keys_in(getattr(value, key))
    elif isinstance(value, dict):
        for item in value.values():
            yield from keys_in(item)
    elif isinstance(value, list):
        for item in value:
            yield from keys_in(item)


def test_every_key_of_the_language_is_used() -> None:
    parts = [
        kind
        for kind in vars(spec).values()
        if isinstance(kind, type) and issubclass(kind, spec.Part) and not kind.__subclasses__()
    ]
    keys = {(part.__name__, key) for part in parts for key in part.model_fields}
    files = [BUSSERVO, *(FILES[name] for name in SPOKEN)]
    used = {key for file in files for key in keys_in(compiled_file(file).spec)}
    assert keys - used <= UNUSED
