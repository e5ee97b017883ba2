"""Open a port, and return a client of the device behind it."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike

from .._frame.protocol import BAUD, LOCAL_ECHO
from .._serial.opening import open_transport
from .base_client import REPLY_TIMEOUT, REPORT_LIMIT
from .controller import Controller
from .exchanges import LIMITS
from .limits import Allowed


def open_controller(
    port: str,
    *,
    baud: float = BAUD,
    exclusive: bool = True,
    reply_timeout: float = REPLY_TIMEOUT,
    retries: int = 0,
    trace: str | PathLike[str] | None = None,
    report_limit: int = REPORT_LIMIT,
    limits: Allowed = LIMITS.usual,
    ids: Iterable[int] = (),
    on_exit: str | None = None,
    local_echo: bool = LOCAL_ECHO,
    settle: float | None = None,
) -> Controller:
    """Open the port of a device, to be used in a `with`.

    `port` is a name or a URL that pyserial knows: `/dev/ttyUSB0`, `COM7`, `hwgrep://CH340`,
    `socket://host:port`, `rfc2217://host:port`, `loop://`; `hid://` is a USB HID device, which
    needs the extra `hid`, and has not been tried on hardware yet. With `exclusive`, no other
    program can have the port meanwhile. The other arguments are explained at Controller. Raises
    TransportError, which names the port, what happened and what to do.
    """
    transport = open_transport(port, baud=baud, exclusive=exclusive)
    try:
        return Controller(
            transport,
            baud=baud,
            reply_timeout=reply_timeout,
            retries=retries,
            trace=trace,
            report_limit=report_limit,
            limits=limits,
            ids=ids,
            on_exit=on_exit,
            local_echo=local_echo,
            settle=settle,
        )
    except BaseException:
        transport.close()
        raise
