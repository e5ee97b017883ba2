"""The stream decoder of a client: each frame proves by its checksum that it is one."""

from __future__ import annotations

from .decoder import StreamDecoder

# How many seconds of silence end a frame that has begun: longer than the latency of any adapter,
# which gathers bytes for up to 16 ms.
GAP = 0.05

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .._frame.message import Message


class CarefulDecoder(StreamDecoder):
    """A decoder that turns bytes into messages and noise, and doubts none of the messages."""

    __slots__ = ()

    @property
    def doubted(self) -> Message | None:
        """The message that is held back: there never is one."""
        return None
