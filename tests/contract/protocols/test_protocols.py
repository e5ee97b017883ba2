"""Protocols that others made: each spec holds what they read and write."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from framegen.model.codec import Decoded, decode, encode
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import compiled_file
from tests.few_each import few_each
from tests.in_turn import in_turn
from tests.protocols.by_hand import BY_HAND
from tests.protocols.peers import PEERS
from tests.protocols.specs import FILES, SPOKEN, messages_of, model_of, values_of

if TYPE_CHECKING:
    from tests.protocols.peer import Peer


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
def test_a_frame_written_by_hand_has_the_same_bytes(
    name: str, message: str, data: st.DataObject
) -> None:
    values, layout = data.draw(values_of(name, message)), messages_of(name)[message]
    frame = BY_HAND[name][message](values)
    assert frame == encode(layout, values)
    assert decode(model_of(name), layout.direction, frame) == Decoded(layout, values)


def test_every_message_is_held_to_what_others_write_or_read() -> None:
    held = {(name, message) for name in BY_HAND for message in BY_HAND[name]}
    held |= {(peer.protocol, name) for peer in PEERS for name in [*peer.writes, *peer.reads]}
    spoken = {(name, message) for name in SPOKEN for message in messages_of(name)}
    assert held == spoken
