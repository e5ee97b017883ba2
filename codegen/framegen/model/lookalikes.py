"""Tells the frames of protocols that are easily taken for this one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.spec import BodyPart, ChecksumPart, ConstantPart, IdPart, LengthPart
from framegen.model.layout import part_size

if TYPE_CHECKING:
    from framegen.language.spec import FramePart, Lookalike, Spec


@dataclass(frozen=True, slots=True)
class Recognised:
    """A frame of a look-alike: whose it is, and the bytes of each of its parts."""

    name: str
    lookalike: Lookalike
    parts: dict[str, bytes]
    command: int

    @property
    def meaning(self) -> str:
        """What the code means there; empty where the spec does not say."""
        return self.lookalike.commands.get(self.command, "")


def recognise(spec: Spec, data: bytes) -> Recognised | None:
    """Find the look-alike of which `data` is exactly one frame."""
    for name, lookalike in spec.lookalikes.items():
        frame = spec.frame if lookalike.frame is None else lookalike.frame
        parts = _parts(spec, frame, data)
        # With neither a frame nor codes of its own, there is nothing to tell it by.
        if parts is None or not (lookalike.frame or lookalike.commands):
            continue
        id_ = next(key for key, part in frame.items() if isinstance(part, IdPart))
        command = int.from_bytes(parts[id_], spec.byte_order)
        if command in lookalike.commands or not lookalike.commands:
            return Recognised(name, lookalike, parts, command)
    return None


def _parts(spec: Spec, frame: dict[str, FramePart], data: bytes) -> dict[str, bytes] | None:
    """Cut `data` into the parts of `frame`; None where a part says that it is no such frame."""
    body = len(data) - sum(part_size(part) for part in frame.values())
    if body < 0:
        return None
    parts: dict[str, bytes] = {}
    at = 0
    for name, part in frame.items():
        size = body if isinstance(part, BodyPart) else part_size(part)
        parts[name] = data[at : at + size]
        at += size
    fits = all(_fits(spec, part, parts[name], parts) for name, part in frame.items())
    return parts if fits else None


def _fits(spec: Spec, part: FramePart, found: bytes, parts: dict[str, bytes]) -> bool:
    if isinstance(part, ConstantPart):
        return found == part.bytes_
    number = int.from_bytes(found, spec.byte_order)
    if isinstance(part, LengthPart):
        return number == sum(len(parts[name]) for name in part.counts)
    if isinstance(part, ChecksumPart):
        total = sum(sum(parts[name]) for name in part.covers)
        return number == ~total & ((1 << 8 * len(found)) - 1)
    return True
