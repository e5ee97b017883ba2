"""Check: whether a device is plugged in that has no serial port at all."""

from __future__ import annotations

from ...line.hid_devices import UNSEEN
from .check import Check
from .result import passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    boards = diagnosis.library.link.hid_devices
    known = ", ".join(f"{vendor:04X}:{product:04X}" for vendor, product, _ in boards)
    if not known:
        return passed("no device of this protocol is known to be reached by USB HID")
    if diagnosis.hid_devices is None:
        return unknown(
            f"without hidapi nothing shows whether a USB HID device ({known}) is plugged in",
            "pip install hidapi; such a device has no serial port at all",
        )
    if not diagnosis.hid_devices:
        return passed(f"no USB HID device ({known}) is plugged in")
    seen = ", ".join(f"{each.ids} {each.product}".rstrip() for each in diagnosis.hid_devices)
    if diagnosis.port is not None and diagnosis.port.lower().startswith("hid:"):
        return passed(f"{seen} is plugged in")
    return unknown(
        f"{seen} is plugged in, a device without a serial port ({UNSEEN})",
        "if that is the device you mean: pip install hidapi, and --port hid://",
    )


CHECK = Check("hid", "which devices have no serial port", (), _look)
