"""A wrong checksum in an example that is refused for something else, which it had to prove."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framewire.explain.refusals import BAD_CHECKSUM, Refused

from framegen.model.codec import NotAFrame, decode
from framegen.model.slots import Constant

if TYPE_CHECKING:
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


def wrong_checksum(model: Model, message: MessageLayout, data: bytes) -> str:
    """Return why bytes are no frame of a message by its first checksum; "" where that is right.

    It tells nothing of bytes that are no such frame at all: with other constants or another size.
    """
    frame = message.frame
    if not _is_framed(message, data):
        return ""
    for checksum in sorted(frame.checksums, key=lambda each: each.at % len(data)):
        at = checksum.at % len(data)
        if data[at : at + checksum.size] != message.checksum(checksum, data):
            plain = model.protocol
            refused = Refused(
                plain,
                plain.envelopes[frame.name],
                [message.direction],
                data,
                BAD_CHECKSUM,
                at,
                plain.messages[message.name],
                len(data),
            )
            return f"{BAD_CHECKSUM} at byte {at}: {refused.expected()}"
    return ""


def other_id(model: Model, message: MessageLayout, data: bytes) -> str:
    """Hint at the ids of a message, where all else is right with them."""
    for part in message.frame.sent_ids:
        ours = message.id_of(part)
        mended = data[: part.at] + part.write(ours) + data[part.at + part.size :]
        if mended != data and _is_frame_of(model, message, mended):
            found = part.read_in(data)
            return f"{part.name} is {found}, and {message.name} has {ours}: with that, it is one"
    return ""


def _is_frame_of(model: Model, message: MessageLayout, data: bytes) -> bool:
    try:
        return decode(model, message.direction, data).layout is message
    except NotAFrame:
        return False


def _is_framed(message: MessageLayout, data: bytes) -> bool:
    """Tell whether bytes have the constants and the size of a frame of a message."""
    frame, part = message.frame, message.frame.length_part
    length = len(data) - frame.uncounted
    if len(data) < frame.least or length not in message.lengths:
        return False
    if part is not None and part.read_in(data) != length:
        return False
    return all(
        placed.of(data) == placed.slot.data
        for placed in frame.lay_out(len(data))
        if isinstance(placed.slot, Constant) and placed.slot.role == "constant"
    )
