"""Recognition of look-alikes: frames of protocols that are easily taken for this one."""

from __future__ import annotations

from dataclasses import dataclass

from .protocol import lay_out

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .protocol import Envelope, Lookalike, Placed, Protocol


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
        parts = _parts(lookalike.frame, data)
        # With neither a frame nor ids of its own, there is nothing to tell it by.
        if parts is None or not ("frame" in lookalike.said or lookalike.commands):
            continue
        if lookalike.frame.id is None:
            continue
        placed = parts[lookalike.frame.id.name]
        command = placed.slot.read(placed.of(data))
        if command in lookalike.commands or not lookalike.commands:
            return Recognised(name, lookalike, tuple(parts.values()), command)
    return None


def _parts(frame: Envelope, data: bytes) -> dict[str, Placed] | None:
    """Cut `data` into the parts of `frame`; None where a part shows that it is no such frame."""
    if len(data) < frame.least:
        return None
    parts = {placed.path: placed for placed in lay_out(frame.slots, len(data))}
    # Of ids that are not sent, nothing is known: a checksum that covers them tells nothing.
    is_proven = frame.unsent or frame.sealed(data) == data
    return (
        parts
        if is_proven and all(_fits(placed, parts, data) for placed in parts.values())
        else None
    )


def _fits(placed: Placed, parts: dict[str, Placed], data: bytes) -> bool:
    slot, found = placed.slot, placed.of(data)
    if slot.role == "constant":
        return found == slot.data
    if slot.role == "length":
        return slot.read(found) == sum(parts[name].size for name in slot.of)
    if slot.role == "address":
        named = [value["value"] for value in slot.said.get("values", {}).values()]
        return slot.low <= slot.read(found) <= slot.high or slot.read(found) in named
    return True
