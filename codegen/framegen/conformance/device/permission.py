"""Permission to send frames to a device: queries always, commands only if the user names them.

A query is what a device only tells something for. What it does something for is a command, even if
it is acknowledged by a reply.
Whatever is sent is checked here first, together with the bytes in front of it: a device receives
bytes, not frames, and may have lost some of them.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.model.verdict import weigh
from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


@dataclass(frozen=True)
class Permission:
    """What may be sent: every query of the client, and the messages that the user named."""

    model: Model
    named: tuple[str, ...] = ()

    @cached_property
    def queries(self) -> list[str]:
        """The messages of the client whose reply tells something that they do not say."""
        return [each.request.name for each in self.model.exchanges if self._only_tells(each)]

    @cached_property
    def commands(self) -> list[str]:
        """The client's other messages: a device acts on them."""
        return [each.request.name for each in self.model.exchanges if not self._only_tells(each)]

    def _only_tells(self, exchange: Exchange) -> bool:
        """Tell whether a reply is certain to be more than an acknowledgement.

        It has a field that the request has not; and it answers nothing else, or the method returns
        that field.
        """
        if exchange.reply is None:
            return False
        said = {
            *exchange.request.message.fields,
            *(slot.name for slot in exchange.request.arguments),
        }
        told = {slot.name for slot in exchange.reply.arguments}
        told -= {exchange.reply.message.failure, *said}
        alone = len(self.model.answers[exchange.reply.name]) == 1
        return exchange.method.result in told or (alone and bool(told))

    @cached_property
    def frame(self) -> Envelope:
        """The one kind of frame that the client sends. Raises Unusable."""
        kinds = self.model.candidates(self._ways)
        if len(kinds) == 1 and kinds[0].frame.id_part is not None:
            return kinds[0].frame
        why = "has several kinds" if len(kinds) > 1 else "has no id"
        name = self.model.spec.protocol.name
        raise Unusable(
            f"what a device of {name} would take for a command cannot be told: what is sent {why}",
            hint="test its codec: `framegen conform SPEC -- PROGRAM`",
        )

    @cached_property
    def allowed(self) -> list[str]:
        """The messages that may be sent."""
        named = [name for name in self.commands if name in self.named]
        return [*self.queries, *named]

    @cached_property
    def refused(self) -> list[str]:
        """The messages of the client that may not be sent."""
        return [name for name in self.commands if name not in self.named]

    def objection(self, data: bytes) -> str:
        """Return why `data` must not be sent; empty if it may.

        A device that goes by header and id, and tests neither length nor count, must find only
        allowed messages in it. If any one byte is lost on the way, there must still be no legal
        frame in it that is not allowed.
        """
        head = self.frame.id.at + self.frame.id.size
        for at in self._headers(data, range(len(data))):
            found = self._dangerous.get(self._id(data, at))
            if found is not None:
                return f"it holds {to_hex(data[at : at + head])}, which begins {found}"
        begun = self._begun(data, range(len(data)))
        if name := self._holds(data, begun):
            return f"it holds a frame of {name}"
        for lost in range(len(data)):
            left = data[:lost] + data[lost + 1 :]
            # Frames that end before it, or begin behind it, are as they were.
            before = [at for at in begun if lost - self._largest <= at <= lost - head]
            across = self._begun(left, range(max(0, lost - head + 1), lost + 1))
            if name := self._holds(left, [*before, *across]):
                byte, front = to_hex(data[lost : lost + 1]), to_hex(data[max(0, lost - 4) : lost])
                return f"it holds a frame of {name} if the {byte} behind {front} is lost"
        return ""

    def _holds(self, data: bytes, places: Iterable[int]) -> str:
        """Return the first forbidden message that begins at one of these places."""
        for at in places:
            for way in self._ways:
                message = weigh(self.model, [way], data[at : at + self._largest]).message
                if message is not None and message.name not in self.allowed:
                    return message.name
        return ""

    def _begun(self, data: bytes, places: range) -> list[int]:
        """Return where the header and the id of a forbidden message stand."""
        return [at for at in self._headers(data, places) if self._id(data, at) in self._forbidden]

    def _headers(self, data: bytes, places: range) -> Iterator[int]:
        header = self.frame.header
        at = data.find(header, places.start)
        while 0 <= at < places.stop:
            yield at
            at = data.find(header, at + 1)

    def _id(self, data: bytes, at: int) -> int:
        """Return the id of what begins at `at`; -1 where there is none yet."""
        place, begun = self.frame.id, data[at : at + self.frame.body_at]
        return place.read_in(begun) if place.is_in(begun) else -1

    @cached_property
    def _ways(self) -> list[Direction]:
        """The directions of the client's bytes: to every end but itself."""
        client = self.model.roles.client
        return [way for way in self.model.directions if way.receiver != client]

    @cached_property
    def _largest(self) -> int:
        return self.model.largest(self._ways)

    @cached_property
    def _forbidden(self) -> dict[int, MessageLayout]:
        """By id, every message that a device may receive and that is not allowed."""
        return {
            message.id: message
            for way in self._ways
            for message in self.model.sent(way)
            if message.name not in self.allowed
        }

    @cached_property
    def _dangerous(self) -> dict[int, str]:
        """By id, what a device might do that no query does."""
        spec = self.model.spec
        received = self.model.roles.received
        found = {
            code: f"a frame of id {code}, as in {lookalike.title}"
            for lookalike in spec.lookalikes.values()
            for code in lookalike.commands
        }
        found |= {
            each.id.one: f"a frame of the reserved id {each.id}"
            for each in spec.reserved
            if each.id is not None and each.id.one is not None and each.direction != received
        }
        found |= {code: f"a frame of {message.name}" for code, message in self._forbidden.items()}
        harmless = {self.model.messages[name].id for name in self.allowed}
        return {code: what for code, what in found.items() if code not in harmless}

    @cached_property
    def unknown_id(self) -> int | None:
        """An id that no message and no look-alike uses; None where there is none."""
        place = self.frame.id
        messages = self.model.messages.values()
        known = {message.id for message in messages if message.frame.id_part is not None}
        # A header byte there could begin a header.
        taken = known | self._dangerous.keys() | set(self.frame.header)
        free = (code for code in range(place.high, -1, -1) if code not in taken)
        return next(free, None)


def permit(model: Model, names: Iterable[str]) -> Permission:
    """Allow all queries, and the named messages. Raises Unusable for names of no use."""
    permission = Permission(model, tuple(names))
    can = [each.request.name for each in model.exchanges]
    for name in permission.named:
        if name in can:
            continue
        message = model.messages.get(name)
        if message is not None:
            way = message.direction
            raise Unusable(
                f"{name} cannot be allowed: it goes {way}, and what is sent goes "
                f"{model.roles.sent}",
                hint=did_you_mean("", permission.commands),
            )
        raise Unusable(
            f"there is no message `{name}` to be allowed",
            hint=did_you_mean(name, permission.commands, otherwise=_choices(permission)),
        )
    if not can or not permission.allowed:
        raise Unusable(
            f"{model.spec.protocol.name} has no query",
            hint=f"name what may be sent, as by --allow {can[0]}" if can else "",
        )
    _ = permission.frame  # Refused before anything is sent.
    return permission


def _choices(permission: Permission) -> str:
    if permission.commands:
        return ""
    return "all that can be sent is a query, and needs no permission"
