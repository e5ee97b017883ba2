"""Check: no other program has the port."""

from __future__ import annotations

from ...line.link_errors import PortBusyError
from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    error = diagnosis.error
    if error is None:
        return passed("no other program has it")
    if isinstance(error, PortBusyError):
        more = "; a serial monitor, or on Linux ModemManager, may be it"
        return failed(f"{error.port}: {error.happened}", f"{error.advice}{more}")
    return unknown("the port could not be opened, for another reason")


CHECK = Check("busy", "no other program has the port", ("permission",), _look)
