"""Check: which servos are there."""

from __future__ import annotations

from .. import exchanges
from ..exchanges import EXCHANGES
from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..message import Message
    from .diagnosis import Diagnosis
    from .probe import Probe
    from .result import Result

_POSE: Any = getattr(exchanges, "POSE", None)
# Where a board does not say more at once, or lets a servo take its time.
_FEWER = 16


def _look(diagnosis: Diagnosis) -> Result:
    if _POSE is None:
        return unknown("the protocol does not say how positions are read")
    if not any(trip.replies for trip in diagnosis.trips):
        return unknown("there is no reply to anything: see the check `rate`")
    replies: list[Message] = []
    asked = 0
    for request in _requests(diagnosis.connected()):
        asked += 1
        trip = diagnosis.connected().ask(request)
        diagnosis.trips.append(trip)
        replies += [reply for _, reply in trip.replies[:1]]
    frames = [reply.encode() for reply in replies]
    if not replies:
        return failed(
            f"{_POSE.read.__name__} was not answered, {asked} times",
            "the board answers other questions, so it may be of a kind that does not know this one",
        )
    there = _POSE.there(replies)
    absent = sum(len(getattr(reply, _POSE.told)) for reply in replies) - len(there)
    ids = ", ".join(str(each[0]) for each in there) or "none"
    told = f"servos that are there: {ids}" + (f"; told to be absent: {absent}" * bool(absent))
    if len(replies) < asked:
        missing = f"{asked - len(replies)} of {asked} requests were not answered"
        return failed(f"{missing}; {told}", "run this again, and see the check `reply`", *frames)
    if not there:
        advice = "see to the supply of the servos, which USB is not, and to their cables"
        return failed(told, advice, *frames)
    return passed(told, *frames)


def _requests(probe: Probe) -> list[Message]:
    """Questions about every servo that there can be, in parts that this line carries."""
    most = EXCHANGES[_POSE.read].most or len(_POSE.ids)
    if probe.largest_frame is not None:
        most = min(most, _FEWER)
    ids = [*_POSE.ids]
    return [_POSE.read(**{_POSE.asked: ids[at : at + most]}) for at in range(0, len(ids), most)]


CHECK = Check("servos", "there are servos", ("opening",), _look)
