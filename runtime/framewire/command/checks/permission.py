"""Check: the port may be used."""

from __future__ import annotations

from ...line.link_errors import PortPermissionError, TransportError
from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    # The port is opened here: other errors of that are for the checks that follow.
    try:
        diagnosis.connect()
    except PortPermissionError as error:
        diagnosis.error = error
        return failed(f"{error.port}: {error.happened}", error.advice)
    except TransportError as error:
        diagnosis.error = error
        return unknown("the port could not be opened, for another reason")
    return passed("the system lets you use it")


CHECK = Check("permission", "the port may be used", ("port",), _look)
