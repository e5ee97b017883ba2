"""What is likely the cause of bytes that are no frames, and what to do about it."""

from __future__ import annotations

from typing import NamedTuple

from ..plain_text import plain_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...frame.heads import Heads

OTHER_DEVICE = (
    "another device may be on this port, such as a GPS receiver, a modem or an Arduino: unplug it, "
    "and see which port goes; a device that restarts prints text, too: see to its supply"
)
_CUT = (
    "bytes are lost on the way, or the device stops within a frame: see to loose plugs, the "
    "grounds and the supply; at another rate, or on an inverted line, bytes may look so, too"
)
_NO_HEADER = (
    "see at which rate the device is set, that the grounds are joined, and that the line is not "
    "inverted, as RS-232 is at a plug for 3.3 V or 5 V; or it is another device"
)
_NO_FRAME = (
    "compare the bytes with the reference: the device may be another, or speak another edition; or "
    "bytes are damaged: check the rate and the grounds"
)


class Cause(NamedTuple):
    """What is seen of bytes that are no frames, in words, and the way out."""

    seen: str
    advice: str


def likely_cause(data: bytes, heads: Heads) -> Cause:
    """Return the likely cause of bytes that came in one go and are no frames."""
    text = plain_text(data)
    if text:
        return Cause(f"they are text: {text}", OTHER_DEVICE)
    places = [at for at in range(len(data)) if heads.begins(data, at) and len(data) - at > 1]
    cut = next((at for at in places if heads.claimed(data[at:]) > len(data) - at), None)
    if cut is not None:
        size, there = heads.claimed(data[cut:]), len(data) - cut
        return Cause(f"one of {size} bytes begins, and ends after {there}", _CUT)
    if not places:
        return Cause("none begins in them", _NO_HEADER)
    return Cause("they begin as a frame does, and are none", _NO_FRAME)
