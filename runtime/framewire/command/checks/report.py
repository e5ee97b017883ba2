"""The report of a diagnosis: a recording, with facts about both ends and the line between.

It is made to be sent to others: it holds no serial number, no user's name, no path of a home.
"""

from __future__ import annotations

import platform
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from ...recording.file import NOISE, RecordingFile

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable
    from os import PathLike

    from .check import Check
    from .diagnosis import Diagnosis
    from .result import Result

_PORT = "PORT"


class Report:
    """A report in progress. Raises OSError: FileExistsError for a file that holds anything."""

    def __init__(self, path: str | PathLike[str]) -> None:
        self._file = RecordingFile(path)

    def write(
        self, diagnosis: Diagnosis, findings: Iterable[tuple[Check, Result]], model: str
    ) -> None:
        """Write the report, and close the file. `model` is what its user calls the device."""
        for line in _about(diagnosis, model):
            self._file.note(line)
        for check, result in findings:
            self._file.note(f"{result.state} {check.id}: {_blinded(result.seen, diagnosis)}")
        self._file.begin(_kind_of(diagnosis.port))
        began = diagnosis.log[0][0] if diagnosis.log else 0.0
        for at, sender, data, what in diagnosis.log:
            if data:
                self._file.write(data, at - began, sender or NOISE, what)
            else:
                self._file.note(what)
        self._file.close()


def _about(diagnosis: Diagnosis, model: str) -> list[str]:
    try:
        pyserial = version("pyserial")
    except PackageNotFoundError:
        pyserial = "unknown"
    library = diagnosis.library
    system = f"{platform.system()} {platform.release()} {platform.machine()}"
    return [
        f"doctor of {library.package} {library.versions}",
        f"device: {model or 'not stated'}",
        f"adapter: {_blinded(diagnosis.adapter, diagnosis) or 'not known'}",
        f"computer: {system}, Python {platform.python_version()}, pyserial {pyserial}",
        f"line: {_kind_of(diagnosis.port)}, {diagnosis.stated}",
    ]


def _kind_of(port: str | None) -> str:
    """Return the kind of a port: its name may hold a serial number, or the name of a machine."""
    if port is None:
        return "no port"
    scheme, separator, _ = port.partition("://")
    return f"{scheme}://" if separator else "a serial port"


def _blinded(text: str, diagnosis: Diagnosis) -> str:
    """Return a text without the names of ports, serial numbers and the path of the user's home."""
    hidden = {each.name: _PORT for each in diagnosis.ports}
    hidden |= {each.serial: "SERIAL" for each in diagnosis.ports}
    hidden |= {each.path: _PORT for each in diagnosis.hid_devices or []}
    hidden |= {diagnosis.port or "": _PORT, diagnosis.device: _PORT, str(Path.home()): "~"}
    # The longest first, of which others may be parts; a lone slash would be in every path.
    for each in sorted(hidden, key=len, reverse=True):
        if len(each) > 1:
            text = text.replace(each, hidden[each])
    return text
