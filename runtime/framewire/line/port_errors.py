"""Errors for a port that could not be opened, in words that say what to do about it."""

from __future__ import annotations

import errno
import os
import re
import sys

from .link_errors import (
    PortAddressError,
    PortBusyError,
    PortNotFoundError,
    PortPermissionError,
    TransportError,
    errno_of,
)
from .port_names import ADDRESSES, NAMED

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

_PERMITTED = (
    "add yourself to the group that owns it (dialout on most systems, uucp on some), as by "
    "`sudo usermod -aG dialout $USER`, then log in again"
)
# pyserial's texts, for errors without an errno.
_ABSENT = ("filenotfounderror", "no ports found")
# Where the system's words stand in pyserial's: `[Errno 5] ...`, or `(5, '...')` and the like.
_SYSTEM_WORDS = (
    re.compile(r"\[(?:Errno|WinError) -?[0-9]+\] (?P<words>.+)$"),
    re.compile(r"\(-?[0-9]+, (?P<quote>['\"])(?P<words>.+?)(?P=quote)[,)]"),
    re.compile(r"^Could not open port \S+: (?P<words>.+)$"),
)
# How each system names its ports, and what sys.platform begins with there.
_NAMES = (
    (re.compile(r"(?i)(?:\\\\\.\\)?com[0-9]+:?"), "Windows", ("win32", "cygwin")),
    (re.compile(r"/dev/(?:cu|tty)\..*"), "macOS", ("darwin",)),
    (re.compile(r"/dev/(?:tty(?:USB|ACM|AMA|S|THS)[0-9]+|serial.*|rfcomm.*)"), "Linux", ("linux",)),
)
_SYSTEMS = {"win32": "Windows", "darwin": "macOS", "linux": "Linux"}


def not_opened(
    port: str,
    error: Exception,
    listed: Callable[[], str],
    *,
    baud: float,
    platform: str = sys.platform,
) -> TransportError:
    """Return why a port could not be opened, and what to do.

    `listed` returns all ports, and `baud` is the rate of the protocol.
    """
    code, low = errno_of(error), str(error).lower()
    # On Windows pyserial gives the system's words instead of an errno.
    denied = code in (errno.EACCES, errno.EPERM) or "permissionerror" in low
    busy = code in (errno.EBUSY, errno.EAGAIN) or "exclusively lock" in low
    if busy or (denied and platform == "win32"):
        advice = "close the other program, or the other client, that has it"
        return PortBusyError(port, "it is in use", advice, code)
    if denied:
        return PortPermissionError(port, "permission is denied", _PERMITTED, code)
    absent = isinstance(error, (StopIteration, LookupError)) or any(each in low for each in _ABSENT)
    if absent or code in (errno.ENOENT, errno.ENXIO, errno.ENODEV):
        return PortNotFoundError(port, _why_absent(port, platform), listed(), code)
    if isinstance(error, OSError) and "expected a string in the form" not in low:
        return _unlike_a_port(port, error, listed)
    return _no_port(port, error, baud)


def _no_port(port: str, error: Exception, baud: float) -> TransportError:
    """Return the error for a name that pyserial does not know."""
    low = str(error).lower()
    if "baud rate" in low:
        happened = f"it cannot be set to that rate ({_words_of(error)})"
        return TransportError(port, happened, f"the protocol's is {baud}; see what the adapter has")
    if low.startswith("invalid url"):
        scheme = port.partition("://")[0]
        return PortAddressError(port, f"nothing is known that begins with {scheme}://", NAMED)
    return PortAddressError(port, f"it is no port ({error})", NAMED)


def _unlike_a_port(port: str, error: OSError, listed: Callable[[], str]) -> TransportError:
    """Return the error for something that does not open as a port does."""
    # pyserial has this number in its text alone.
    if error.errno == errno.EISDIR or f"({errno.ENOTTY}," in str(error):
        happened = "it is there, and is no serial port"
        return PortAddressError(port, happened, listed(), error.errno)
    why = _words_of(error)
    if "://" in port:
        advice = "see that the other end is there and listening"
        return PortNotFoundError(port, f"it cannot be reached ({why})", advice, error.errno)
    return TransportError(port, f"it cannot be opened ({why})", listed(), error.errno)


def _words_of(error: Exception) -> str:
    """Return what the system said, without what pyserial has put around it."""
    if isinstance(error, OSError) and error.errno:
        return os.strerror(error.errno)
    text = str(error)
    for pattern in _SYSTEM_WORDS:
        found = pattern.search(text)
        if found is not None:
            return found["words"]
    return text


def _why_absent(port: str, platform: str) -> str:
    scheme, separator, rest = port.partition(":")
    if scheme.lower() == "hwgrep" and rest.startswith("//"):
        wanted, _, options = rest[2:].partition("&")
        happened = f"no port that is plugged in has {wanted!r} in its description"
        return f"{happened}, or none that {options!r} leaves" if options else happened
    if separator and scheme.lower() in ADDRESSES and not rest.startswith("//"):
        return f"there is no such port, and an address begins with {scheme.lower()}://"
    if port != port.strip():
        return "there is no such port: its name begins or ends with a blank"
    here = _SYSTEMS.get(platform, platform)
    for pattern, system, platforms in _NAMES:
        if pattern.fullmatch(port) and platform not in platforms:
            return f"that is how {system} names ports, and this is {here}"
    return "there is no such port"
