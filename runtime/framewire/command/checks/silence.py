"""Check: nothing but reports comes without a question."""

from __future__ import annotations

from ..plain_text import plain_text
from .check import Check
from .likely_cause import OTHER_DEVICE
from .result import failed, passed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result

_LISTENING = 0.3


def _look(diagnosis: Diagnosis) -> Result:
    diagnosis.unsolicited = heard = diagnosis.connected().listen(_LISTENING)
    noise = [each.data for run in heard.runs for each in run]
    if noise:
        count = sum(map(len, noise))
        text = plain_text(b"".join(noise))
        if text:
            return failed(f"{count} bytes of text came unsolicited: {text}", OTHER_DEVICE, *noise)
        return failed(
            f"{count} bytes that are no frame came unsolicited",
            "see that the rate is right, that the grounds are joined, and that the plug is the "
            "device's",
            *noise,
        )
    if heard.messages:
        reports = ", ".join(map(repr, heard.messages[:3]))
        frames = (each.encode() for each in heard.messages)
        return passed(f"unsolicited reports came, as they may: {reports}", *frames)
    return passed(f"nothing came within {_LISTENING:g} s")


CHECK = Check("silence", "a line that is not asked is silent", ("opening",), _look)
