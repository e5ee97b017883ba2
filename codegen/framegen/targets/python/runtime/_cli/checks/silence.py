"""Check: nothing but reports comes without a question."""

from __future__ import annotations

from ..._codec.noise import Noise
from .check import Check
from .result import failed, passed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result

_LISTENING = 0.3


def _look(diagnosis: Diagnosis) -> Result:
    diagnosis.unsolicited = diagnosis.connected().listen(_LISTENING)
    noise = [each.data for each in diagnosis.unsolicited if isinstance(each, Noise)]
    if noise:
        return failed(
            f"{sum(map(len, noise))} bytes that are no frame came unsolicited",
            "see that the rate is right, that the grounds are joined, and that the plug is the "
            "device's",
            *noise,
        )
    reports = [repr(each) for each in diagnosis.unsolicited if not isinstance(each, Noise)]
    if reports:
        frames = (each.encode() for each in diagnosis.unsolicited if not isinstance(each, Noise))
        return passed(f"unsolicited reports came, as they may: {', '.join(reports[:3])}", *frames)
    return passed(f"nothing came within {_LISTENING:g} s")


CHECK = Check("silence", "a line that is not asked is silent", ("opening",), _look)
