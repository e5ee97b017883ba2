"""Check: there is a port to examine."""

from __future__ import annotations

from ..link import only_port, plugged_in
from .check import Check
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result

_NONE = "no serial port is plugged in"
_PLUG_IN = (
    "plug in the device or its adapter, by a cable that carries data; where that changes nothing, "
    "see the check `hid`: USB HID devices have no serial port at all"
)


def _look(diagnosis: Diagnosis) -> Result:
    result = _listed(diagnosis)
    if not diagnosis.named_by:
        return result
    return result._replace(seen=f"{result.seen}; named by {diagnosis.named_by}")


def _listed(diagnosis: Diagnosis) -> Result:
    found = ", ".join(str(each) for each in diagnosis.ports)
    if diagnosis.port is None:
        return _choose(diagnosis, found)
    if "://" in diagnosis.port:
        return passed(f"{diagnosis.port} is an address, which nothing lists")
    device = diagnosis.device
    for each in diagnosis.ports:
        if each.name in (diagnosis.port, device):
            link = "" if each.name == diagnosis.port else f"{diagnosis.port} is "
            return passed(f"{link}{each}")
    if diagnosis.is_pseudo_terminal:
        what = f"{'' if device == diagnosis.port else f'{device}, '}a pseudo terminal"
        return passed(f"{diagnosis.port} is {what}, which nothing lists: a program is behind it")
    seen = f"{diagnosis.port} is not among the ports that are listed ({found or 'none'})"
    return unknown(seen, "go on if it is a name of your own for a port")


def _choose(diagnosis: Diagnosis, found: str) -> Result:
    """Choose the only port there is; or a device without any."""
    by_usb = plugged_in(diagnosis.ports)
    devices = diagnosis.hid_devices or []
    diagnosis.port = only_port(diagnosis.ports, devices)
    if not by_usb and devices:
        seen = f"{_NONE}, but a USB HID device is, which has none"
        return passed(f"{seen}: {devices[0].ids} {devices[0].product}".rstrip())
    if not by_usb and len(diagnosis.ports) == 1:
        diagnosis.port = diagnosis.ports[0].name
        return unknown(f"no port is plugged in by USB; {found} is taken", _PLUG_IN)
    if not by_usb:
        return failed(
            f"no port is plugged in by USB: {found} are there" if found else _NONE,
            f"{_PLUG_IN}; or name another port: --port NAME",
        )
    if len(by_usb) > 1:
        file = diagnosis.program.settings_file
        return failed(
            f"{len(by_usb)} ports are plugged in: {', '.join(str(each) for each in by_usb)}",
            "name the device's: --port NAME, with --save also for later, in "
            f"{file}; it is the one that goes when you unplug the device",
        )
    return passed(f"the one that is plugged in is taken: {by_usb[0]}")


CHECK = Check("port", "there is a port", (), _look)
