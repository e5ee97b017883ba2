"""Remark: what one end sends could also be taken for what the other sends."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.checks.pasted import lowest
from framegen.checks.rule import ModelRule, Problem
from framegen.language.values import to_hex
from framegen.model.codec import NotAFrame, Unencodable, decode, encode

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def _look(model: Model) -> Iterator[Problem]:
    # Both ends hear the same wire where there are many on it.
    shared = any(envelope.address is not None for envelope in model.envelopes.values())
    if not shared or model.spec.link.local_echo:
        return
    sent = model.sent(model.roles.sent)
    found = [twin for message in sent if (twin := _twin(model, message)) is not None]
    if not found:
        return
    message, other, frame = found[0]
    which = f"{len(found)} of {pluralize(len(sent), 'message')} {model.roles.sent} have frames"
    yield Problem(
        ("messages", message.name),
        f"{which} that are legal {model.roles.received} as well, such as {message.name}, "
        f"{to_hex(frame)}, which is {other.name} there",
        "where an adapter hears itself, a client must drop its own echo: write "
        "`link: {local_echo: true}`, or open it so",
        on_key=True,
    )


def _twin(
    model: Model, message: MessageLayout
) -> tuple[MessageLayout, MessageLayout, bytes] | None:
    """Return the first frame of a message that is also one of the other direction."""
    for frame in _frames(message):
        try:
            other = decode(model, model.roles.received, frame).layout
        except NotAFrame:
            continue
        return message, other, frame
    return None


def _frames(message: MessageLayout) -> Iterator[bytes]:
    for example in message.message.examples:
        yield example.hex
    try:
        yield encode(message, lowest(message))
    except Unencodable:
        return


RULE = ModelRule(
    id="twin",
    title="What one end sends is not legal the other way",
    why="On a wire that many share, an adapter may hear what it sends: where that is also a legal "
    "answer, a client that does not drop its echo takes its own question for the answer. That is "
    "how many protocols are, so this is a remark.",
    bad="Ping: {hex: FF FF 01 02 01 FB}  # which is also a status of the device 1",
    good="link: {local_echo: true}",
    look=_look,
)
