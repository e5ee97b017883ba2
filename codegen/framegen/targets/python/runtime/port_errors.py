"""Why a port could not be opened: what is wrong with its name, or with what has that name."""

from __future__ import annotations

import errno
import re
import sys
from urllib.parse import urlsplit

from .link_errors import (
    PortAddressError,
    PortBusyError,
    PortNotFoundError,
    PortPermissionError,
    TransportError,
)

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Callable

NAMED = "name a port, such as /dev/ttyUSB0 or COM7, or a URL, such as socket://host:port"
_PERMITTED = (
    "add yourself to the group that owns it (dialout on most systems, uucp on some), as by "
    "`sudo usermod -aG dialout $USER`, then log in again"
)
# What pyserial says, where there is no errno to go by.
_ABSENT = ("filenotfounderror", "no ports found")
_NETWORK = ("socket", "rfc2217")
_HIGHEST_TCP_PORT = 65535
# How each system names its ports, and what sys.platform begins with there.
_NAMES = (
    (re.compile(r"(?i)(?:\\\\\.\\)?com[0-9]+:?"), "Windows", ("win32", "cygwin")),
    (re.compile(r"/dev/(?:cu|tty)\..*"), "macOS", ("darwin",)),
    (re.compile(r"/dev/(?:tty(?:USB|ACM|AMA|S|THS)[0-9]+|serial.*|rfcomm.*)"), "Linux", ("linux",)),
)
_SYSTEMS = {"win32": "Windows", "darwin": "macOS", "linux": "Linux"}


def refused_name(port: object) -> TransportError | None:
    """Why nothing can have this name, whatever is plugged in; None where something may."""
    if not isinstance(port, str):
        return PortAddressError(repr(port), "a port is named by text", NAMED)
    if not port.strip():
        return PortAddressError(repr(port), "this is no name", NAMED)
    scheme, separator, _ = port.partition("://")
    if separator and scheme.lower() == "spy":
        happened = "pyserial would write to any file that such an address names"
        return PortAddressError(port, happened, "name the port alone, and record it by `trace`")
    if separator and scheme.lower() in _NETWORK:
        return _refused_address(port, scheme)
    if separator and scheme.lower() == "hwgrep":
        pattern = port.partition("://")[2].partition("&")[0]
        try:
            re.compile(pattern)
        except re.error as error:
            happened = f"{pattern!r} is no regular expression ({error})"
            return PortAddressError(port, happened, f"such as {scheme}://CH340")
    return None


def _refused_address(port: str, scheme: str) -> TransportError | None:
    advice = f"write {scheme}://HOST:PORT, such as {scheme}://device.local:4000"
    try:
        parts = urlsplit(port)
    except ValueError as error:
        return PortAddressError(port, f"it is no address ({error})", advice)
    number = parts.netloc.rpartition("@")[2].rpartition("]")[2].rpartition(":")[2]
    if not parts.hostname:
        return PortAddressError(port, "it names no host", advice)
    if ":" not in parts.netloc.rpartition("]")[2] or not number:
        return PortAddressError(port, "it names no TCP port", advice)
    if not (number.isascii() and number.isdigit()):
        return PortAddressError(port, f"{number!r} is no TCP port, which is a number", advice)
    # A number of thousands of digits is none that Python would convert.
    if len(number) > len(str(_HIGHEST_TCP_PORT)) or not 1 <= int(number) <= _HIGHEST_TCP_PORT:
        happened = f"{number} is no TCP port, which is 1 to {_HIGHEST_TCP_PORT}"
        return PortAddressError(port, happened, advice)
    return None


def not_opened(
    port: str, error: Exception, listed: Callable[[], str], *, platform: str = sys.platform
) -> TransportError:
    """Why a port could not be opened, and what to do about it; `listed` tells what there is."""
    code, text = getattr(error, "errno", None), str(error)
    low = text.lower()
    # On Windows pyserial gives the system's words instead of an errno.
    denied = code in (errno.EACCES, errno.EPERM) or "permissionerror" in low
    busy = code in (errno.EBUSY, errno.EAGAIN) or "exclusively lock" in low
    if busy or (denied and platform == "win32"):
        advice = "close the other program, or the other client, that has it"
        return PortBusyError(port, "it is in use", advice)
    if denied:
        return PortPermissionError(port, "permission is denied", _PERMITTED)
    absent = isinstance(error, (StopIteration, LookupError)) or any(each in low for each in _ABSENT)
    if absent or code in (errno.ENOENT, errno.ENXIO, errno.ENODEV):
        return PortNotFoundError(port, _why_absent(port, platform), listed())
    if not isinstance(error, OSError) or "expected a string in the form" in low:
        return PortAddressError(port, f"it is no port ({text})", NAMED)
    return _unlike_a_port(port, error, text, listed)


def _unlike_a_port(
    port: str, error: OSError, text: str, listed: Callable[[], str]
) -> TransportError:
    """Why what is there does not open as a port does."""
    # pyserial keeps this number in its text alone.
    if error.errno == errno.EISDIR or f"({errno.ENOTTY}," in text:
        return PortAddressError(port, "it is there, and is no serial port", listed())
    if "://" in port:
        why = text.removeprefix(f"Could not open port {port}: ")
        advice = "see that the other end is there and listening"
        return PortNotFoundError(port, f"it cannot be reached ({why})", advice)
    return TransportError(port, f"it cannot be opened ({text})", listed())


def _why_absent(port: str, platform: str) -> str:
    scheme, separator, rest = port.partition("://")
    if separator and scheme.lower() == "hwgrep":
        return f"no port that is plugged in has {rest.partition('&')[0]!r} in its description"
    here = _SYSTEMS.get(platform, platform)
    for pattern, system, platforms in _NAMES:
        if pattern.fullmatch(port) and platform not in platforms:
            return f"that is how {system} names ports, and this is {here}"
    return "there is no such port"
