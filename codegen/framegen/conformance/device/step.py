"""One step of a run on a device: what is sent, and which replies are due."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import count
from typing import TYPE_CHECKING, Any, TypeAlias

from framegen.conformance.language import fields
from framegen.model.codec import encode

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Mapping

    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout


@dataclass(frozen=True)
class Request:
    """A frame of an allowed message. `about` says where its values are from."""

    exchange: Exchange
    values: Mapping[str, Any]
    frame: bytes
    about: str

    def numbered(self, number: int) -> Request:
        """Return it with a running number, where its frame has one."""
        part = self.exchange.counter
        if part is None:
            return self
        values = {**self.values, part.name: number % (part.high + 1)}
        return replace(self, values=values, frame=encode(self.message, values))

    @property
    def message(self) -> MessageLayout:
        """The message."""
        return self.exchange.request

    @property
    def reply(self) -> MessageLayout | None:
        """The message that is due as its reply; None where nobody answers its address."""
        return None if self.is_silent else self.exchange.reply

    @property
    def is_silent(self) -> bool:
        """Whether it goes to an address that nobody answers."""
        part = self.exchange.address
        return part is not None and self.values[part.name] in part.silent

    @property
    def answers(self) -> list[MessageLayout]:
        """What may come back: the reply, or the refusal."""
        return [] if self.reply is None else self.exchange.answers

    @property
    def text(self) -> str:
        """The message with its values."""
        return " ".join([self.message.name, *fields(self.message, self.values)])

    def answered_by(self, message: MessageLayout, values: Mapping[str, Any]) -> bool:
        """Tell whether a message can answer it: its device reports only what was requested."""
        if message not in self.answers or self.other_device(message, values) is not None:
            return False
        if message != self.reply:
            return True
        return not self.exchange.miscounts(self.values, values) and not any(
            excess(self, path, reported, values) for path, reported in self.exchange.echoed
        )

    def other_device(self, message: MessageLayout, values: Mapping[str, Any]) -> int | None:
        """Return the address that a message comes from, where another one was asked."""
        asked, part = self.exchange.address, message.frame.address
        if asked is None or part is None or values[part.name] == self.values[asked.name]:
            return None
        address: int = values[part.name]
        return address

    @property
    def reply_size(self) -> int:
        """The size of the largest reply that it can have; 0 where none is due."""
        if self.reply is None:
            return 0
        items = self.reply.items
        if items is not None and self.exchange.counted is not None:
            return self.reply.size_at(self.exchange.asked(self.values))
        for requested, reported in self.exchange.echoed:
            if items is not None and reported.partition(".")[0] == items.name:
                count = len(column(self.values, requested))
                if count in self.reply.counts:
                    return self.reply.size_at(count)
        return self.reply.largest


@dataclass(frozen=True, slots=True)
class Malformed:
    """Bytes that are no frame, and the reason; `about` says in which way."""

    frame: bytes
    reason: str
    about: str


Piece: TypeAlias = Request | Malformed
# What is sent at once.
Burst: TypeAlias = tuple[Piece, ...]


@dataclass(frozen=True, slots=True)
class Step:
    """Bursts to send, each once the replies to the one before it have arrived.

    Where nothing is sent, the line is listened to for so many `seconds`.
    """

    title: str
    bursts: tuple[Burst, ...]
    seconds: float = 0

    @property
    def is_malformed(self) -> bool:
        """Whether any of it is malformed."""
        return any(isinstance(piece, Malformed) for burst in self.bursts for piece in burst)


def numbered(steps: Iterable[Step]) -> Iterator[Step]:
    """Yield steps whose requests are numbered in turn, as by a client."""
    number = count()
    for step in steps:
        bursts = (
            tuple(
                piece.numbered(next(number)) if isinstance(piece, Request) else piece
                for piece in burst
            )
            for burst in step.bursts
        )
        yield replace(step, bursts=tuple(bursts))


def data_of(burst: Burst) -> bytes:
    """Return the bytes of a burst."""
    return b"".join(piece.frame for piece in burst)


def requests_of(burst: Burst) -> list[Request]:
    """Return the requests of a burst that a device must answer or carry out."""
    return [piece for piece in burst if isinstance(piece, Request)]


def column(values: Mapping[str, Any], path: str) -> list[int]:
    """Return the values of a field, by path: one number, or one for each element of a list."""
    name, _, inner = path.partition(".")
    value = values[name]
    if inner:
        return [item[inner] for item in value]
    return list(value) if isinstance(value, list) else [value]


def excess(request: Request, requested: str, reported: str, values: Mapping[str, Any]) -> list[int]:
    """Return what a reply with these values reports beyond the request, with how often.

    What it omits does not count: a device may have nothing to report of it.
    """
    left = column(request.values, requested)
    found = []
    for value in column(values, reported):
        if value in left:
            left.remove(value)
        else:
            found.append(value)
    return found
