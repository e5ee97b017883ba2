"""Check: replies take as long as their bytes take on the wire."""

from __future__ import annotations

import math
from statistics import median

from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    answered = [trip for trip in diagnosis.trips if trip.replies]
    if not answered:
        return unknown("there was no reply to measure: see the check `rate`")
    probe = diagnosis.connected()
    taken: list[float] = []
    early: list[bytes] = []
    for trip in answered:
        seconds, reply = trip.replies[0]
        taken.append(seconds)
        if seconds < probe.wire_time.least(len(trip.question.encode()) + len(reply.encode())):
            early.append(reply.encode())
    if math.isinf(probe.baud):
        return passed(f"the median of {len(taken)} is {median(taken) * 1000:.2f} ms")
    sizes = len(answered[0].question.encode()) + len(answered[0].replies[0][1].encode())
    wire_ms = probe.wire_time.seconds(sizes) * 1000
    wire = f"{wire_ms:.2f} ms, which {sizes} bytes take at {probe.baud:g}"
    seen = (
        f"the median of {len(taken)} is {median(taken) * 1000:.2f} ms; the wire needs {wire} baud"
    )
    if not early:
        return passed(seen)
    # If a reply to an earlier question was taken for another's, one reply is left over.
    if all(len(trip.replies) == 1 for trip in answered):
        return unknown(
            f"{seen}: this is no line of that rate, but one such as TCP, a pseudo terminal or USB",
            "say so: --baud inf, or baud=math.inf in Python; then no reply can come too soon",
            *early,
        )
    return failed(
        f"{len(early)} of {len(answered)} replies were there before the line could have carried "
        f"question and reply ({seen})",
        "these answer an earlier question: replies come late, or twice; see the check `reply`",
        *early,
    )


CHECK = Check("round-trip", "replies take their time on the wire", ("opening",), _look)
