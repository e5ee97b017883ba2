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

from framegen.conformance.device.danger import Danger
from framegen.language.values import to_hex
from framegen.model.verdict import weigh
from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.language.values import Direction
    from framegen.model.exchanges import Exchange
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Number


@dataclass(frozen=True)
class Permission:
    """What may be sent: every query of the client, and the messages that the user named.

    `device` is the address of the device, where it is not that of the examples; with `echo`, the
    line gives back what is sent.
    """

    model: Model
    named: tuple[str, ...] = ()
    device: int | None = None
    echo: bool = False

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
        told -= {exchange.failure and exchange.failure.name, *said}
        alone = len(self.model.answers[exchange.reply.name]) == 1
        return exchange.method.result in told or (alone and bool(told))

    @cached_property
    def reports(self) -> list[str]:
        """The messages that a device sends without being asked."""
        model = self.model
        sent = [message.name for message in model.sent(model.roles.received)]
        return [each for each in sent if model.kind(each) == "report" and each not in model.refuses]

    @cached_property
    def address(self) -> Number | None:
        """The part of what the client sends that says for which device it is."""
        found = (each.frame.address for each in self.model.candidates(self._ways))
        return next((part for part in found if part is not None), None)

    @cached_property
    def is_shared(self) -> bool:
        """Whether the line carries one thing at a time: a bus, or frames divided by silence."""
        frames = [each.frame for each in self.model.candidates(self._ways)]
        return self.echo or any(frame.address is not None or not frame.header for frame in frames)

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

        A device that goes by constants and ids alone, and tests nothing else, must find only
        allowed messages in it. If any one byte is lost on the way, there must still be no legal
        frame in it that is not allowed.
        """
        for danger in self._dangers:
            if begun := danger.begun(data):
                return f"it holds {begun}"
        begun_at = [(danger, danger.places(data, range(len(data)))) for danger in self._dangers]
        if name := self._holds(data, (at for _, places in begun_at for at in places)):
            return f"it holds a frame of {name}"
        for lost in range(len(data)):
            left = data[:lost] + data[lost + 1 :]
            places = [at for each in begun_at for at in self._affected(*each, left, lost)]
            if name := self._holds(left, places):
                byte, front = to_hex(data[lost : lost + 1]), to_hex(data[max(0, lost - 4) : lost])
                return f"it holds a frame of {name} if the {byte} behind {front} is lost"
        return ""

    def _affected(self, danger: Danger, begun: list[int], left: bytes, lost: int) -> Iterator[int]:
        """Yield where a frame may begin that a lost byte changes.

        Those that end before it, or begin behind it, are as they were.
        """
        yield from (at for at in begun if lost - self._largest <= at <= lost - danger.head)
        yield from danger.places(left, range(max(0, lost - danger.head + 1), lost + 1))

    def _holds(self, data: bytes, places: Iterable[int]) -> str:
        """Return the first forbidden message that begins at one of these places."""
        for at in places:
            for way in self._ways:
                message = weigh(self.model, [way], data[at : at + self._largest]).message
                if message is not None and message.name not in self.allowed:
                    return message.name
        return ""

    def unknown_id(self, message: MessageLayout) -> int | None:
        """Return a last id that makes those of a message unknown, to look-alikes as well."""
        of_it = (each for each in self._dangers if each.frame is message.frame)
        return next((danger.unknown(message) for danger in of_it), None)

    @cached_property
    def _dangers(self) -> list[Danger]:
        allowed = self.allowed
        return [
            Danger(self.model, candidates, allowed)
            for candidates in self.model.candidates(self._ways)
        ]

    @cached_property
    def _ways(self) -> list[Direction]:
        """The directions of the client's bytes: to every end but itself."""
        client = self.model.roles.client
        return [way for way in self.model.directions if way.receiver != client]

    @cached_property
    def _largest(self) -> int:
        return self.model.largest(self._ways)


def permit(
    model: Model, names: Iterable[str], device: int | None = None, *, echo: bool = False
) -> Permission:
    """Allow all queries, and the named messages. Raises Unusable for names of no use."""
    permission = Permission(model, tuple(names), device, echo or model.spec.link.local_echo)
    can = [each.request.name for each in model.exchanges]
    if device is not None:
        _check_address(permission, device)
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
    if not permission.allowed and not permission.reports:
        raise Unusable(
            f"{model.spec.protocol.name} has no query",
            hint=f"name what may be sent, as by --allow {can[0]}" if can else "",
        )
    return permission


def _check_address(permission: Permission, device: int) -> None:
    part, name = permission.address, permission.model.spec.protocol.name
    if part is None:
        raise Unusable(f"devices of {name} have no address", hint="leave --address out")
    if not part.holds(device):
        bounds = f"{part.low}..{part.high}"
        raise Unusable(
            f"no device of {name} has the address {device}", hint=f"write one of {bounds}"
        )
    if device in part.silent:
        raise Unusable(
            f"{device} is no device's own address: nobody answers what is sent there",
            hint="write the address of the device that is at the port",
        )


def _choices(permission: Permission) -> str:
    if permission.commands:
        return ""
    return "all that can be sent is a query, and needs no permission"
