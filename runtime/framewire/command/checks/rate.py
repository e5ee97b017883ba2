"""Check: the device answers at the rate of the protocol, or else at which one it does."""

from __future__ import annotations

import math

from ...line.link_errors import ClosedError, DisconnectedError, TransportError
from ..plain_text import plain_text
from .check import Check
from .likely_cause import OTHER_DEVICE
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...frame.message import Message
    from .diagnosis import Diagnosis
    from .result import Result
    from .trip import Trip

# The rates that devices and adapters mostly use, the likeliest first.
_RATES = (115200, 57600, 38400, 19200, 9600, 4800)
# How much longer than a program waits, so that a late reply is recognised as late.
EXTRA_TIME = 1.0
_NO_RATE = ("socket", "loop", "hid")
_SILENT = (
    "see that TX goes to RX and RX to TX, that the grounds are joined, that the device is "
    "supplied, and that it is the device's port: unplug it, and see which one goes"
)


def _look(diagnosis: Diagnosis, question: Message) -> Result:
    probe = diagnosis.connected()
    for _ in range(2):
        diagnosis.trips.append(probe.ask(question, extra=EXTRA_TIME))
        if diagnosis.trips[-1].replies:
            return _answered(diagnosis, question)
    return _searched(diagnosis, question)


def _answered(diagnosis: Diagnosis, question: Message) -> Result:
    """Return the result for a device that answers: whether the stated rate is its rate."""
    stated = diagnosis.stated
    port = diagnosis.port or ""
    reply = diagnosis.trips[-1].replies[0][1].encode()
    if math.isinf(diagnosis.baud):
        return passed("it answers, on a line that you say has no rate", reply)
    if _has_no_rate(port):
        return passed(f"it answers, over a line on which no rate is set from here ({port})", reply)
    if not diagnosis.is_pseudo_terminal:
        return passed(f"it answers at {stated}", reply)
    other = next(rate for rate in _RATES if rate != diagnosis.baud)
    trip = diagnosis.connect(other).ask(question)
    diagnosis.connect()
    if trip.replies:
        seen = f"it answers at {stated} and at {other} baud alike: a pseudo terminal without a rate"
        return unknown(seen, "", reply)
    return passed(f"it answers at {stated}", reply)


def _searched(diagnosis: Diagnosis, question: Message) -> Result:
    """Return the result for a device that does not answer: whether it does at another rate."""
    unanswered = f"{type(question).__name__} was not answered"
    found = [trip.received for trip in diagnosis.trips if trip.received]
    tried: list[str] = []
    for rate in _RATES:
        if rate == diagnosis.baud or _has_no_rate(diagnosis.port or ""):
            continue
        trip = _tried(diagnosis, question, rate)
        if trip is None:
            continue
        if trip.replies:
            diagnosis.strange += [(diagnosis.baud, each.heard) for each in diagnosis.trips]
            diagnosis.trips = [trip]
            return failed(
                f"{unanswered} at {diagnosis.stated}, but is at {rate}",
                f"set the device to {diagnosis.stated}, or say --baud {rate} "
                f"(baud={rate} in Python)",
                trip.replies[0][1].encode(),
            )
        tried.append(str(rate))
        diagnosis.strange.append((rate, trip.heard))
    diagnosis.connect()
    if tried:
        unanswered += f", nor at {', '.join(tried)} baud"
    if not found:
        return failed(f"{unanswered}: nothing came at all", _SILENT)
    seen = f"{unanswered}: {sum(map(len, found))} bytes came"
    if all(trip.echoed and not trip.noise for trip in diagnosis.trips if trip.received):
        return failed(f"{seen}, which are the question itself", _SILENT, *found)
    noise = [each.data for trip in diagnosis.trips for each in trip.noise]
    text = plain_text(b"".join(noise))
    if text:
        return failed(f"{seen}, and they are text: {text}", OTHER_DEVICE, *noise)
    advice = (
        "see at which rate the device is set, that the grounds are joined, and the checks below"
    )
    return failed(f"{seen} that are no reply", advice, *found)


def _tried(diagnosis: Diagnosis, question: Message, rate: int) -> Trip | None:
    """Return the round trip at another rate; None if the port cannot be set to it."""
    try:
        probe = diagnosis.connect(rate)
    except (DisconnectedError, ClosedError):
        raise
    except TransportError:
        return None
    trip = probe.ask(question)
    # Sent once more, so that no late reply is taken for one at another rate.
    return probe.ask(question) if trip.replies else trip


def _has_no_rate(port: str) -> bool:
    scheme, separator, _ = port.partition("://")
    return bool(separator) and scheme.lower() in _NO_RATE


def rate_check(question: Message) -> Check:
    """Return the check that asks this question."""
    title = "the device answers at the rate of the protocol"
    return Check("rate", title, ("opening",), lambda each: _look(each, each.question or question))
