"""The rate of a pseudo terminal, in baud: it has no effect, yet programs that open one set it.

Not for Windows.
"""

from __future__ import annotations

import contextlib
import sys
from array import array

# Windows has no terminals of this kind; where modules are only imported, this one may be, too.
_STANDARD: dict[int, int] = {}
if sys.platform != "win32":
    import fcntl
    import termios

    _STANDARD |= {
        getattr(termios, name): int(name[1:])
        for name in dir(termios)
        if name[0] == "B" and name[1:].isdecimal()
    }
_CONSTANTS = {rate: constant for constant, rate in _STANDARD.items()}
_INPUT, _OUTPUT = 4, 5

# Linux keeps any other rate as a number, at these places of a longer structure.
_TCGETS2, _TCSETS2, _BOTHER, _CBAUD = 0x802C542A, 0x402C542B, 0o10000, 0o10017
_FLAGS_AT, _INPUT_AT, _OUTPUT_AT, _LENGTH = 2, 9, 10, 64


def read_rate(end: int) -> int | None:
    """Return the rate at which a terminal sends; None if the system does not say."""
    speed: int = termios.tcgetattr(end)[_OUTPUT]
    if speed in _STANDARD:
        return _STANDARD[speed]
    if sys.platform != "linux" or speed != _BOTHER:
        return speed
    with contextlib.suppress(OSError):
        return _structure(end)[_OUTPUT_AT]
    return None


def set_rate(end: int, rate: int) -> None:
    """Set both rates of a terminal, as well as the system can."""
    attributes = termios.tcgetattr(end)
    if rate in _CONSTANTS or sys.platform != "linux":
        attributes[_INPUT] = attributes[_OUTPUT] = _CONSTANTS.get(rate, rate)
        with contextlib.suppress(termios.error, OverflowError):
            termios.tcsetattr(end, termios.TCSANOW, attributes)
        return
    with contextlib.suppress(OSError, OverflowError):
        structure = _structure(end)
        structure[_FLAGS_AT] = structure[_FLAGS_AT] & ~_CBAUD | _BOTHER
        structure[_INPUT_AT] = structure[_OUTPUT_AT] = rate
        fcntl.ioctl(end, _TCSETS2, structure)


def _structure(end: int) -> array[int]:
    structure = array("I", bytes(4 * _LENGTH))
    fcntl.ioctl(end, _TCGETS2, structure)
    return structure
