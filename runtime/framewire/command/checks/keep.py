"""What of a diagnosis is worth keeping as settings."""

from __future__ import annotations

import sys
from pathlib import Path

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ..settings import Settings
    from ..settings_save import Value
    from .diagnosis import Diagnosis


def worth_keeping(diagnosis: Diagnosis, before: Settings) -> dict[str, Value]:
    """Return port and numbers, and of the line what differs from what holds already.

    Empty if nothing has answered, though something was asked.
    """
    if diagnosis.port is None or (
        diagnosis.trips and not any(each.replies for each in diagnosis.trips)
    ):
        return {}
    port = diagnosis.port
    # Settings may be used in another folder than this one.
    if port != before.port and sys.platform != "win32" and "://" not in port:
        port = str(Path(port).absolute()) if Path(port).exists() else port
    link = diagnosis.library.link
    values: dict[str, Value] = {"port": port}
    if diagnosis.baud != (before.baud or link.baud):
        values["baud"] = diagnosis.baud
    echo = link.local_echo if before.local_echo is None else before.local_echo
    if diagnosis.local_echo is not echo:
        values["local_echo"] = diagnosis.local_echo
    if diagnosis.present:
        values["ids"] = [*diagnosis.present]
    return values
