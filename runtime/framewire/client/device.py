"""The other end of the line: bytes in, a handler for each message, messages out."""

from __future__ import annotations

from ..codec.noise import Noise
from ..codec.protocol_codec import ProtocolCodec
from ..codec.rejects import Rejects
from ..frame.direction import Direction
from ..frame.message import Message
from .counted import Counted

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Iterable

    import typing_extensions as typing
else:
    from ..frame.typing_later import typing


class Device:
    """The end that a client is not at: what simulators, gateways and tests of firmware stand on.

    A library's own says which handler each message has.
    """

    _codec: typing.ClassVar[ProtocolCodec]
    # The direction of what it receives, and the name of the handler of each message.
    _incoming: typing.ClassVar[Direction]
    _handlers: typing.ClassVar[tuple[tuple[type[Message], str], ...]]
    # What compares a reply with what was asked for, where that says how many items there are.
    _counted: typing.ClassVar[tuple[tuple[type[Message], Counted], ...]] = ()

    def __init__(self) -> None:
        self._decoder = self._codec.decoder(self._incoming)
        self._queue: list[typing.Any] = []
        self._handler_of = dict(self._handlers)
        self._counted_by = dict(self._counted)
        self.rejects = Rejects(self._codec.heads.begins)

    def receive(self, data: bytes | bytearray | memoryview) -> bytes:
        """Take in bytes, in pieces of any size, and return the bytes of all that is to be sent."""
        self.accept(data)
        return b"".join(report.encode() for report in self.take())

    def accept(self, data: bytes | bytearray | memoryview) -> None:
        """Take in bytes; the messages to send wait for `take`. Never raises on input."""
        self._receive(self._decoder.feed(data))

    def quiet(self) -> None:
        """End the frame in progress: the line has been quiet for too long to wait for its rest."""
        self._receive(self._decoder.flush())

    def restart(self) -> None:
        """Discard half a frame and all messages to be sent: the device was switched off."""
        self._decoder = self._codec.decoder(self._incoming)
        self._queue = []

    # Which messages there are to send is said by each library's own.
    def send(self, report: typing.Any) -> None:
        """Queue a message to be sent. Raises TypeError for one of the other end, or protocol."""
        name = type(report).__name__
        if report.DIRECTION is self._incoming:
            raise TypeError(f"{name} is sent to this end, never by it")
        if not isinstance(report.DIRECTION, self._codec.directions):
            raise TypeError(f"{name} is a message of {report.__module__}, another protocol")
        self._queue.append(report)

    def take(self) -> list[typing.Any]:
        """Return the messages that wait to be sent, in order, and empty the queue."""
        pending, self._queue = self._queue, []
        return pending

    def accepted(self, message: Message) -> None:
        """Handle any message, before its own handler; override it to see them all."""

    def rejected(self, noise: Noise) -> None:
        """Handle a piece of noise that is counted in `rejects`; override it to see them."""

    def _receive(self, events: Iterable[Message | Noise]) -> None:
        for event in events:
            if isinstance(event, Noise):
                if self.rejects.add(event):
                    self.rejected(event)
                continue
            self.rejects.end()
            self._handle_message(event)

    def _handle_message(self, message: Message) -> None:
        self.accepted(message)
        reply = self._reply_to(message)
        if reply is None:
            return
        kind = type(message)
        if kind in self._counted_by:
            self._counted_by[kind].check(message, reply)
        self._send_reply(message, reply)

    def _reply_to(self, message: Message) -> Message | None:
        """Return what the handler of a message says."""
        reply: Message | None = getattr(self, self._handler_of[type(message)])(message)
        return reply

    def _send_reply(self, _message: Message, reply: Message) -> None:
        """Send the reply to a message."""
        self.send(reply)


class AddressedDevice(Device):
    """One of several on a line: what is for others is none of its business."""

    # The names of the address in what it receives, and the addresses that nobody answers.
    _addresses: typing.ClassVar[tuple[str, ...]]
    _silent: typing.ClassVar[frozenset[int]] = frozenset()

    def __init__(self, *addresses: int) -> None:
        super().__init__()
        self.addresses = frozenset(addresses)

    def _handle_message(self, message: Message) -> None:
        address = self._address_of(message)
        is_for_all = address is None or address in self._silent
        if is_for_all or not self.addresses or address in self.addresses:
            super()._handle_message(message)

    def _send_reply(self, message: Message, reply: Message) -> None:
        if self._address_of(message) not in self._silent:
            super()._send_reply(message, reply)

    def _address_of(self, message: Message) -> int | None:
        names = [name for name in self._addresses if name in message.__match_args__]
        return getattr(message, names[0]) if names else None
