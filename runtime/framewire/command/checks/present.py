"""Check: something is connected behind the device, and reports its position."""

from __future__ import annotations

from .check import Check
from .rate import EXTRA_TIME
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...client.pose import Pose
    from ...frame.message import Message
    from .diagnosis import Diagnosis
    from .result import Result

# One reply may be lost on any line: whether each comes is for another check to find out.
_TRIES = 3
# How many are requested at once on a line that carries no long frames.
_FEW = 16


def present_check(pose: Pose) -> Check:
    """Return the check that reads the positions of all that can be connected."""
    title = "something is there behind the device"
    return Check("present", title, ("opening",), lambda each: _look(each, pose))


def _look(diagnosis: Diagnosis, pose: Pose) -> Result:
    advice = "the device may be of a kind that does not know this question"
    if diagnosis.trips:
        if not any(trip.replies for trip in diagnosis.trips):
            return unknown("there is no reply to anything: see the check `rate`")
        advice = f"see the check `reply`; if that has passed, {advice}"
    replies: list[Message] = []
    for request in _requests(diagnosis, pose):
        reply = ask_repeatedly(diagnosis, request)
        if reply is None:
            ids = getattr(request, pose.requested)
            return failed(
                f"the question about {pose.noun}s {ids[0]} to {ids[-1]} was not answered, though "
                f"asked {_TRIES} times",
                advice,
                *(trip.received for trip in diagnosis.trips[-_TRIES:] if trip.received),
            )
        replies.append(reply)
    frames = [reply.encode() for reply in replies]
    there = diagnosis.present = pose.present_in(replies)
    absent = sum(len(getattr(reply, pose.reported)) for reply in replies) - len(there)
    seen = f"{pose.noun}s that are there: {', '.join(map(str, there)) or 'none'}"
    seen += f"; reported absent: {absent}" if absent else ""
    if not there:
        advice = f"check the supply of the {pose.noun}s, which USB is not, and their cables"
        return failed(seen, advice, *frames)
    return passed(seen, *frames)


def ask_repeatedly(diagnosis: Diagnosis, request: Message) -> Message | None:
    """Return the first reply to a question, sent a few times; None if none comes."""
    for _ in range(_TRIES):
        trip = diagnosis.connected().ask(request, extra=EXTRA_TIME)
        diagnosis.trips.append(trip)
        if trip.replies:
            return trip.replies[0][1]
    return None


def _requests(diagnosis: Diagnosis, pose: Pose) -> list[Message]:
    """Return requests for all that can be connected, in parts that this line carries."""
    most = diagnosis.library.exchanges[pose.read].most or len(pose.ids)
    if diagnosis.connected().largest_frame is not None:
        most = min(most, _FEW)
    parts = (pose.ids[at : at + most] for at in range(0, len(pose.ids), most))
    return [pose.read(**{pose.requested: [*part]}) for part in parts]
