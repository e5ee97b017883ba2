"""One direction of a line: when bytes come out of it, and in which pieces."""

from __future__ import annotations

from framewire.simulator.channel import Channel


def test_a_wire_carries_a_byte_in_ten_bits() -> None:
    wire = Channel(10 / 9600)
    wire.put(b"abc", 1.0)
    wire.put(b"d", 1.0)
    assert wire.take(1.0 + 10 / 9600) == [b"a"]
    assert wire.held == 3
    assert wire.take(1.0 + 40 / 9600) == [b"bcd"]
    assert wire.next_event is None


def test_a_wire_without_a_rate_keeps_pieces_apart() -> None:
    wire = Channel()
    wire.put(b"abc", 1.0)
    wire.put(b"d", 1.0)
    assert wire.take(0.9) == []
    assert wire.take(1.0) == [b"abc", b"d"]


def test_nothing_takes_no_time() -> None:
    wire = Channel(10 / 9600)
    wire.put(b"", 1.0)
    assert (wire.next_event, wire.held) == (None, 0)
