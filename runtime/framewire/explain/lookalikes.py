"""Recognition of look-alikes: frames of protocols that are easily taken for this one."""

from __future__ import annotations

from dataclasses import dataclass

from ..protocol.places import lay_out
from ..protocol.slots import Constant, Number
from .checksum import sealed
from .slot_bytes import holds, piece, read, read_in

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..protocol.envelope import Envelope
    from ..protocol.places import Placed
    from ..protocol.protocol import Lookalike, Protocol


@dataclass(frozen=True)
class Recognised:
    """A frame of a look-alike: which one, the places of its parts, and its id."""

    name: str
    lookalike: Lookalike
    parts: tuple[Placed, ...]
    command: int

    @property
    def meaning(self) -> str:
        """The meaning of the id there; empty where the spec does not say."""
        return self.lookalike.commands.get(self.command, "")


def recognise(protocol: Protocol, data: bytes) -> Recognised | None:
    """Find the look-alike of which `data` is exactly one frame."""
    for name, lookalike in protocol.lookalikes.items():
        frame = protocol.frame_of(lookalike)
        parts = _parts(frame, data)
        # With neither a frame nor ids of its own, there is nothing to tell it by.
        if parts is None or not (lookalike.envelope or lookalike.commands):
            continue
        if frame.id is None:
            continue
        command = read_in(frame.id, data)
        if command in lookalike.commands or not lookalike.commands:
            return Recognised(name, lookalike, tuple(parts.values()), command)
    return None


def _parts(frame: Envelope, data: bytes) -> dict[str, Placed] | None:
    """Cut `data` into the parts of `frame`; None where a part shows that it is no such frame."""
    if len(data) < frame.least:
        return None
    parts = {placed.path: placed for placed in lay_out(frame.slots, len(data))}
    # Of ids that are not sent, nothing is known: a checksum that covers them tells nothing.
    is_proven = frame.unsent or sealed(frame, data) == data
    return (
        parts
        if is_proven and all(_fits(placed, parts, data) for placed in parts.values())
        else None
    )


def _fits(placed: Placed, parts: dict[str, Placed], data: bytes) -> bool:
    slot, found = placed.slot, piece(placed, data)
    if isinstance(slot, Constant):
        return slot.role == "reserved" or found == slot.data
    if not isinstance(slot, Number):
        return True
    if slot.role == "length":
        return read(slot, found) == sum(parts[name].size for name in slot.of)
    return slot.role != "address" or holds(slot, found)
