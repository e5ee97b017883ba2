"""Check, for those who ask for it: a servo goes where it is sent, and back."""

from __future__ import annotations

from typing import TYPE_CHECKING

from .. import exchanges
from .check import Check
from .result import failed, passed, unknown

if TYPE_CHECKING:
    from typing import Any

    from .diagnosis import Diagnosis
    from .result import Result

_POSE: Any = getattr(exchanges, "POSE", None)
_LIMITS: Any = getattr(exchanges, "LIMITS", None)
# How far, how long that may take, and how long a servo may take besides.
STEP = 20
_MILLISECONDS = 500
_AFTER = 0.5


def move_check(servo: int) -> Check:
    """The check that moves this servo a little, and back to where it was."""
    return Check("move", f"servo {servo} moves", ("opening",), lambda each: _look(each, servo))


def _look(diagnosis: Diagnosis, servo: int) -> Result:
    if _POSE is None:
        return unknown("the protocol does not say how servos are moved")
    began = _position(diagnosis, servo)
    if began is None:
        return failed(f"servo {servo} tells no position, so it was not moved", "see `servos`")
    bounds = None if _LIMITS is None else _LIMITS.usual
    if bounds is not None and not bounds[0] <= began <= bounds[1]:
        told = f"servo {servo} is at {began}, outside {bounds[0]}..{bounds[1]}: it was not moved"
        return unknown(told, "turn it by hand into its range")
    step = STEP if bounds is None or began + STEP <= bounds[1] else -STEP
    reached = _moved(diagnosis, servo, began + step)
    ended = _moved(diagnosis, servo, began)
    told = f"servo {servo} was at {began}, was sent to {began + step}, and was then at {reached}"
    if reached is None or abs(reached - began - step) > STEP // 2:
        advice = "see to the supply of the servos, which USB is not, and that nothing holds it"
        return failed(told, advice)
    if ended is None or abs(ended - began) > STEP // 2:
        return failed(f"{told}; sent back, it is at {ended}", "see that nothing holds it")
    return passed(f"{told}; sent back, it is at {ended}")


def _moved(diagnosis: Diagnosis, servo: int, position: int) -> int | None:
    """Where a servo is after it was sent somewhere."""
    probe = diagnosis.connected()
    probe.tell(_POSE.move(**{_POSE.time: _MILLISECONDS, _POSE.moved: [(servo, position)]}))
    probe.listen(_MILLISECONDS / 1000 + _AFTER)
    return _position(diagnosis, servo)


def _position(diagnosis: Diagnosis, servo: int) -> int | None:
    """Where a servo is; None where it does not say."""
    for _ in range(3):
        trip = diagnosis.connected().ask(_POSE.read(**{_POSE.asked: [servo]}))
        for _, reply in trip.replies[:1]:
            for each in _POSE.there([reply]):
                position: int = getattr(each, _POSE.position)
                return position
    return None
