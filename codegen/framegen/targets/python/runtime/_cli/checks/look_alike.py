"""Check: what comes is this protocol, and none that is easily taken for it."""

from __future__ import annotations

from ..._codec.lookalikes import recognise
from ..._codec.noise import Noise, UnknownFrame
from ..._frame.direction import RECEIVED
from ..._frame.errors import Reason
from ..._frame.heads import HEAD, claimed, has_ids
from ...messages import MESSAGES
from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    answers = [event for trip in diagnosis.trips for _, event in trip.events]
    came = [*answers, *diagnosis.unsolicited, *diagnosis.strange]
    if not came:
        return unknown("nothing came that could be looked at")
    noise = [each for each in came if isinstance(each, Noise)]
    streams = [trip.received for trip in diagnosis.trips if trip.noise]
    for data in [*streams, *(each.data for each in noise)]:
        title = recognise(data)
        if title is not None:
            return failed(
                f"frames of another protocol came: {title}",
                "the page on look-alikes in the reference tells them apart: another device or plug",
                data,
            )
    for each in noise:
        likeness = _likeness(each)
        if likeness:
            advice = "an unknown edition of the device, or bytes that were lost: send a report in"
            return failed(likeness, advice, each.data)
    return passed("what came is this protocol")


def _likeness(noise: Noise) -> str:
    """Return what a piece of noise has in common with a frame; empty for nothing."""
    if isinstance(noise, UnknownFrame):
        return f"a frame of command {noise.command} came, which is none of this protocol's"
    data = noise.data
    if noise.reason is not Reason.LENGTH_MISMATCH or len(data) < (claimed(data) or HEAD):
        return ""
    kinds = [kind for kind in MESSAGES if kind.DIRECTION is RECEIVED and has_ids(kind, data)]
    if not kinds:
        return ""
    return f"a frame of {kinds[0].__name__} came with {claimed(data)} bytes, which none has"


CHECK = Check("look-alike", "what comes is this protocol", ("opening",), _look)
