"""The codec of a protocol, as the runtime sees it: directions, messages, and what reads frames."""

from __future__ import annotations

from functools import cached_property

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any

    from .._explanation.protocol import Protocol
    from .._frame.direction import Direction
    from .._frame.heads import Heads
    from .._frame.message import Message
    from .._frame.table import Table
    from .careful_decoder import CarefulDecoder
    from .decoder import StreamDecoder
    from .noise import UnknownFrame
    from .noise_lane import NoiseLane


class ProtocolCodec:
    """What a generated library hands to whatever reads frames.

    `package` is its import name. `directions` are all there are, and `received` is that of the
    messages that come to the end that a client is at. What takes time to import is imported when it
    is first asked for.
    """

    def __init__(self, package: str, *, directions: type[Direction], received: Direction) -> None:
        self.package = package
        self.directions = directions
        self.received = received

    @cached_property
    def senders(self) -> list[str]:
        """The names of both ends, of the first to send first."""
        return list(dict.fromkeys(way.sender for way in self.directions))

    @cached_property
    def named(self) -> dict[str, Direction]:
        """The directions as they are asked for: by the sender alone where that is enough."""
        every = [way.sender for way in self.directions]
        return {
            way.sender if every.count(way.sender) == 1 else way.value: way
            for way in self.directions
        }

    @cached_property
    def messages(self) -> tuple[type[Message], ...]:
        """All messages, in the order in which they are declared."""
        return tuple(self._part("messages").MESSAGES)

    @cached_property
    def decode(self) -> Callable[[bytes | bytearray | memoryview, Direction | None], Message]:
        """The function that decodes one frame."""
        decode: Callable[[bytes | bytearray | memoryview, Direction | None], Message]
        decode = self._part("_codec.codec").decode
        return decode

    @cached_property
    def twins(self) -> Callable[[Message], list[type[Message]]]:
        """The function that returns what else a frame may be, if its sender is unknown."""
        twins: Callable[[Message], list[type[Message]]] = self._part("_codec.codec").twins
        return twins

    @cached_property
    def table_for(self) -> Callable[[Direction | None], Table]:
        """The function that returns the messages of one direction, of all for None."""
        table_for: Callable[[Direction | None], Table] = self._part("_codec.codec").table_for
        return table_for

    @cached_property
    def heads(self) -> Heads:
        """The beginnings of all frames: the envelopes, and what follows from them."""
        heads: Heads = self._part("_frame.envelopes").HEADS
        return heads

    @property
    def claimed(self) -> Callable[[bytes], int]:
        """The function that returns how large the frame would be that bytes begin; 0 for none."""
        return self.heads.claimed

    @staticmethod
    def size_of(kind: type[Message], length: int) -> int:
        """Return the size of the frames of a message that have this length."""
        return kind.FRAME.size(length)

    @cached_property
    def decoder(self) -> type[StreamDecoder]:
        """What decodes a stream of bytes."""
        decoder: type[StreamDecoder] = self._part("_codec.decoder").StreamDecoder
        return decoder

    @cached_property
    def careful_decoder(self) -> type[CarefulDecoder]:
        """What decodes a stream of bytes for those who can wait for what decides."""
        decoder: type[CarefulDecoder] = self._part("_codec.careful_decoder").CarefulDecoder
        return decoder

    @cached_property
    def unknown_frame(self) -> type[UnknownFrame]:
        """The class of frames with a command that the protocol does not know."""
        unknown: type[UnknownFrame] = self._part("_codec.unknown_frame").UnknownFrame
        return unknown

    @cached_property
    def noise_lane(self) -> type[NoiseLane]:
        """What tells frames of unknown command from other noise, among some messages."""
        lane: type[NoiseLane] = self._part("_codec.noise_lane").NoiseLane
        return lane

    @cached_property
    def recognise(self) -> Callable[..., str | None]:
        """The function that recognises protocols that are easily taken for this one."""
        recognise: Callable[..., str | None] = self._part("_codec.lookalikes").recognise
        return recognise

    def protocol(self) -> Protocol:
        """Read all that is known of the protocol, for whoever explains it."""
        from .._explanation.carried_model import protocol

        return protocol(self.package)

    def _part(self, name: str) -> Any:
        # Not importlib, which would have to be imported first.
        return __import__(f"{self.package}.{name}", fromlist=[name])
