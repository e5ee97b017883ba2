"""Check: each question is answered in time by one reply that is complete."""

from __future__ import annotations

from ...explain.explanation import rows_of
from ...explain.slot_bytes import legal_length
from .check import Check
from .rate import EXTRA_TIME
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...client.library import Library
    from ...frame.message import Message
    from .diagnosis import Diagnosis
    from .result import Result
    from .trip import Trip

_REQUESTS = 10
# After so many questions without a reply, the next would not be answered either.
_SILENCES = 3

# What may be wrong, and what to do; the first explains those behind it.
_ADVICE = {
    "answered too late": "give the device more time: --timeout 2 (reply_timeout=2 in Python)",
    "answered more than once": "see that no other program or computer asks on the same line; the "
    "library returns one of such replies, and counts the others",
    "answered by bytes that are no reply": "see to loose plugs and the grounds, and compare the "
    "bytes with the reference: the device may be another, or speak another edition",
    "not answered": "check the supply of the device and its plugs; retries=2 asks again",
    "answered with noise around it": "check the grounds, the supply and the length of cables",
}


def _look(diagnosis: Diagnosis) -> Result:
    if not any(trip.replies for trip in diagnosis.trips):
        return unknown("there was no reply to look at: see the check `rate`")
    probe, question = diagnosis.connected(), diagnosis.trips[0].question
    silences = 0
    for _ in range(_REQUESTS):
        trip = probe.ask(question, extra=EXTRA_TIME)
        diagnosis.trips.append(trip)
        silences = 0 if trip.replies else silences + 1
        if silences == _SILENCES:
            break
    troubles: dict[str, list[Trip]] = {}
    for trip in diagnosis.trips:
        trouble = _trouble(trip, _longest(diagnosis, trip))
        if trouble:
            troubles.setdefault(trouble, []).append(trip)
    count = len(diagnosis.trips)
    if not troubles:
        last = diagnosis.trips[-1].replies[0][1]
        seen = f"{count} of {count} questions were answered, each by one whole reply: {last!r}"
        return passed(seen, last.encode(), note=_open_questions(last, diagnosis.library))
    seen = ", ".join(f"{len(trips)} {what}" for what, trips in troubles.items())
    worst = next(what for what in _ADVICE if what in troubles)
    shown = [trip.received for trips in troubles.values() for trip in trips if trip.received]
    return failed(f"of {count} questions {seen}", _ADVICE[worst], *shown)


def _longest(diagnosis: Diagnosis, trip: Trip) -> float:
    """Return how many seconds a program would wait for the reply."""
    probe = diagnosis.connected()
    size = len(trip.question.encode()) + max((len(m.encode()) for _, m in trip.replies), default=0)
    return probe.wire_time.seconds(size) + probe.reply_timeout


def _trouble(trip: Trip, longest: float) -> str:
    """Return what is wrong with the answer to a question; empty for nothing."""
    if not trip.replies:
        if trip.noise:
            return "answered by bytes that are no reply"
        return "not answered"
    if len(trip.replies) > 1:
        return "answered more than once"
    if trip.replies[0][0] > longest:
        return "answered too late"
    return "answered with noise around it" if trip.noise else ""


def _open_questions(reply: Message, library: Library) -> str:
    """Return the values of a reply that no source tells how to judge, and what is not known."""
    model, data = library.protocol(), reply.encode()
    names = {called: name for name, called in model.classes.items()}
    message = model.messages[names[type(reply).__name__]]
    unknown = {each.concerns: each.what for each in model.unknowns if each.message == message.name}
    rows = rows_of(data, message.lay_out(legal_length(message, data) or 0), message)
    return "; ".join(
        f"{row.path} is {row.text}. Not known: {unknown[row.path]}"
        for row in rows
        if row.path in unknown
    )


CHECK = Check("reply", "each question is answered by one whole reply", ("opening",), _look)
