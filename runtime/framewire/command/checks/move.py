"""Check, an optional one: a target is reached, and the way back as well."""

from __future__ import annotations

from .check import Check
from .present import ask_repeatedly
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...client.pose import Pose
    from .diagnosis import Diagnosis
    from .result import Result

# How far, how long that may take, and how long to wait beyond that.
STEP = 20
_MILLISECONDS = 500
_AFTER = 0.5


def move_check(number: int, pose: Pose) -> Check:
    """Return the check that moves one of them a little, and back to where it was."""
    title = f"{pose.noun} {number} moves"
    return Check("move", title, ("opening",), lambda each: _Motion(each, number, pose).look())


class _Motion:
    """The motion there and back, with the position read before, between and after."""

    def __init__(self, diagnosis: Diagnosis, number: int, pose: Pose) -> None:
        self._diagnosis = diagnosis
        self._number = number
        self._pose = pose
        self._name = f"{pose.noun} {number}"

    def look(self) -> Result:
        """Move it, if it reports its position and that is within the limits."""
        began = self._position()
        if began is None:
            seen = f"{self._name} reports no position, so it was not moved"
            return failed(seen, "see the check `present`")
        limits = self._diagnosis.library.limits
        low, high = limits.usual or (self._pose.place.low, self._pose.place.high)
        if not low <= began <= high:
            seen = f"{self._name} is at {began}, outside {low}..{high}, so it was not moved"
            return unknown(seen, "turn it into that range by hand")
        target = began + STEP if began + STEP <= high else began - STEP
        reached, ended = self._moved(target), self._moved(began)
        seen = f"{self._name} was at {began}, was sent to {target}, and was then at {reached}"
        if reached is None or abs(reached - target) > STEP // 2:
            advice = "check its supply, which USB is not, and that nothing holds it"
            return failed(seen, advice)
        seen += f"; sent back, it is at {ended}"
        if ended is None or abs(ended - began) > STEP // 2:
            return failed(seen, "see that nothing holds it")
        return passed(seen)

    def _moved(self, target: int) -> int | None:
        """Send it to a target, and return its position afterwards."""
        probe = self._diagnosis.connected()
        probe.tell(self._pose.motion([(self._number, target)], _MILLISECONDS))
        probe.listen(_MILLISECONDS / 1000 + _AFTER)
        return self._position()

    def _position(self) -> int | None:
        """Return its position; None if it does not report one."""
        request = self._pose.read(**{self._pose.requested: [self._number]})
        reply = ask_repeatedly(self._diagnosis, request)
        found = [] if reply is None else self._pose.there([reply])
        return int(getattr(found[0], self._pose.position)) if found else None
