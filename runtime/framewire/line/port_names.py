"""Port names: those that cannot exist are refused before anything is opened."""

from __future__ import annotations

import re
from urllib.parse import urlsplit

from .link_errors import PortAddressError, TransportError

NAMED = "name a port, such as /dev/ttyUSB0 or COM7, or a URL, such as socket://host:port"
_NETWORK = ("socket", "rfc2217")
_LOGGING = r"logging=(?:debug|info|warning|error)"
# The addresses that pyserial opens: their options, the character before the first (the others
# follow an &), and how they are recognised.
ADDRESSES = {
    "hwgrep": (r"n=0*(?:[2-9]|[1-9][0-9]+)|skip_busy", "&", "n=2 for the second, and skip_busy"),
    "loop": (_LOGGING, "?", "logging=debug"),
    "socket": (_LOGGING, "?", "logging=debug"),
    "rfc2217": (
        rf"{_LOGGING}|(?:ign_set_control|poll_modem)(?:=[^&]*)?|timeout=[0-9]{{1,9}}(?:\.[0-9]*)?",
        "?",
        "ign_set_control, poll_modem, timeout=5 and logging=debug",
    ),
}
_HIGHEST_TCP_PORT = 65535


def refused_name(port: object) -> TransportError | None:
    """Return the error for a name that no port can have; None if a port may have it."""
    if not isinstance(port, str):
        return PortAddressError(repr(port), "a port is named by text", NAMED)
    if not port.strip():
        return PortAddressError(repr(port), "this is no name", NAMED)
    scheme, separator, rest = port.partition("://")
    scheme = scheme.lower()
    if not separator:
        return None
    if scheme == "spy":
        happened = "pyserial would write to any file that such an address names"
        return PortAddressError(port, happened, "name the port alone, and record it by `trace`")
    refused = None
    if scheme in _NETWORK:
        refused = _refused_address(port, scheme)
    elif scheme == "hwgrep":
        refused = _refused_pattern(port, rest.partition("&")[0])
    if refused is None and scheme in ADDRESSES:
        refused = _refused_option(port, scheme, rest)
    return refused


def _refused_pattern(port: str, pattern: str) -> TransportError | None:
    advice = "write what its description holds, such as hwgrep://CH340"
    if not pattern:
        return PortAddressError(port, "it does not say what to look for", advice)
    try:
        re.compile(pattern)
    except re.error as error:
        happened = f"{pattern!r} is no regular expression ({error})"
        return PortAddressError(port, happened, advice)
    return None


def _refused_option(port: str, scheme: str, rest: str) -> TransportError | None:
    known, begin, options = ADDRESSES[scheme]
    for option in filter(None, rest.partition(begin)[2].split("&")):
        if re.fullmatch(known, option) is None:
            happened = f"{option!r} is no option of {scheme}://"
            return PortAddressError(port, happened, f"its options are {options}")
    return None


def _refused_address(port: str, scheme: str) -> TransportError | None:
    advice = f"write {scheme}://HOST:PORT, such as {scheme}://device.local:4000"
    try:
        parts = urlsplit(port)
    except ValueError as error:
        return PortAddressError(port, f"it is no address ({error})", advice)
    happened = _wrong_host(parts.hostname) or _wrong_tcp_port(parts.netloc.rpartition("@")[2])
    return PortAddressError(port, happened, advice) if happened else None


def _wrong_host(host: str | None) -> str:
    if not host:
        return "it names no host"
    try:
        host.encode("idna")
    except UnicodeError:
        return f"{host[:40]!r} is no host name"
    return ""


def _wrong_tcp_port(address: str) -> str:
    _, colon, number = address.rpartition("]")[2].rpartition(":")
    if not colon or not number:
        return "it names no TCP port"
    if not (number.isascii() and number.isdigit()):
        return f"{number!r} is no TCP port, which is a number"
    # Python refuses to convert a number of thousands of digits.
    if len(number) > len(str(_HIGHEST_TCP_PORT)) or not 1 <= int(number) <= _HIGHEST_TCP_PORT:
        return f"{number} is no TCP port, which is 1 to {_HIGHEST_TCP_PORT}"
    return ""
