"""Check: the line echoes what is sent only if it is said to."""

from __future__ import annotations

from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    trips = diagnosis.trips
    if not trips:
        return unknown("nothing could be asked")
    echoed = [trip.question.encode() for trip in trips if trip.echoed]
    if diagnosis.local_echo:
        if len(echoed) == len(trips):
            return passed("what is sent comes back, as you said", *echoed)
        seen = f"what is sent came back {len(echoed)} of {len(trips)} times"
        return failed(seen, "leave out --local-echo, if the adapter has none", *echoed)
    if echoed:
        return failed(
            f"what is sent came back {len(echoed)} of {len(trips)} times: a local echo, as of an "
            "adapter with one wire for both ways",
            "say --local-echo (local_echo=True in Python), or wire both ways apart",
            *echoed,
        )
    return passed("nothing of what is sent comes back")


CHECK = Check("echo", "there is no local echo, or one that is known", ("opening",), _look)
