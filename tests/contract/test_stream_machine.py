"""StreamDecoder on a line where anything may happen next, compared with the oracle at each step."""

from collections.abc import Sequence
from typing import Any

from busservo import Direction, Message, Noise, StreamDecoder, strategies
from hypothesis import strategies as st
from hypothesis.stateful import RuleBasedStateMachine, initialize, invariant, rule

from tests import oracle
from tests.strategies import HEADS, bytes_of, directions, messages_in, oracles, said, unknown_frames

frames = strategies.messages().map(Message.encode)


class Line(RuleBasedStateMachine):
    """A line, its decoder, and the model: the bytes that the oracle has not read to their end.

    The oracle never takes back what it has read, so that it may go on from where it stopped.
    """

    def __init__(self) -> None:
        super().__init__()
        self.direction: Direction | None = None
        self.decoder = StreamDecoder(None)
        self.sent = b""
        self.held = b""
        self.events: list[Message | Noise] = []

    @initialize(direction=directions)
    def begin(self, direction: Direction | None) -> None:
        self.direction = direction
        self.decoder = StreamDecoder(direction)

    @rule(frame=frames)
    def send_message(self, frame: bytes) -> None:
        self.arrives(frame)

    @rule(frame=frames, size=st.integers(1, 40))
    def send_message_in_chunks(self, frame: bytes, size: int) -> None:
        for at in range(0, len(frame), size):
            self.arrives(frame[at : at + size])

    @rule(frame=frames, data=st.data())
    def send_truncated_message(self, frame: bytes, data: st.DataObject) -> None:
        self.arrives(frame[: data.draw(st.integers(1, len(frame) - 1))])

    @rule(frame=frames, data=st.data(), bit=st.integers(0, 7))
    def send_message_with_flipped_bit(self, frame: bytes, data: st.DataObject, bit: int) -> None:
        at = data.draw(st.integers(0, min(5, len(frame) - 1)) | st.integers(0, len(frame) - 1))
        self.arrives(frame[:at] + bytes([frame[at] ^ 1 << bit]) + frame[at + 1 :])

    @rule(noise=strategies.noise(max_size=8) | st.sampled_from(HEADS) | unknown_frames())
    def make_noise(self, noise: bytes) -> None:
        self.arrives(noise)

    @rule()
    def send_nothing(self) -> None:
        assert self.decoder.feed(b"") == []

    @rule()
    def fall_silent(self) -> None:
        self.agree(self.decoder.flush(), oracle.scan(self.held, oracles(self.direction)))
        self.held = b""
        assert self.decoder.pending == 0
        assert bytes_of(self.events) == self.sent

    def arrives(self, data: bytes) -> None:
        """Feed the decoder, and let the oracle read on as far as it can."""
        self.sent += data
        self.held += data
        events = oracle.scan(self.held, oracles(self.direction), quiet=False)
        self.agree(self.decoder.feed(data), events)
        self.held = self.held[sum(map(size_of, events)) :]

    def agree(self, events: Sequence[Message | Noise], expected: list[Any]) -> None:
        """Check that both have found the same messages. The decoder may hold noise longer."""
        self.events += events
        assert [said(message) for message in messages_in(events)] == [
            event for event in expected if not isinstance(event, bytes)
        ]

    @invariant()
    def nothing_is_lost(self) -> None:
        assert bytes_of(self.events) == self.sent[: len(self.sent) - self.decoder.pending]

    @invariant()
    def no_more_is_held_than_the_largest_frame(self) -> None:
        assert len(self.held) <= self.decoder.pending < 257

    @invariant()
    def counters_add_up(self) -> None:
        counters = self.decoder.counters
        assert counters.fed == len(self.sent)
        assert counters.messages == len(messages_in(self.events))
        assert counters.noise == len(bytes_of(self.events)) - len(
            bytes_of(messages_in(self.events))
        )


def size_of(event: Any) -> int:
    """Return how many bytes the oracle read for an event."""
    return len(event if isinstance(event, bytes) else oracle.build(*event))


TestLine = Line.TestCase
