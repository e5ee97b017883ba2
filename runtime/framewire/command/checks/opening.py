"""Check: the port can be opened."""

from __future__ import annotations

from .check import Check
from .result import failed, passed

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    error = diagnosis.error
    if error is None:
        return passed(f"{diagnosis.port} is open, at {diagnosis.stated}")
    return failed(f"{error.port}: {error.happened}", error.advice)


CHECK = Check("opening", "the port can be opened", ("busy",), _look)
