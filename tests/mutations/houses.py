"""Editions of the greenhouse: with more messages, with reservations, and with accepted breaks."""

from collections.abc import Sequence
from typing import Any

from tests.factories import DEMO, data_of

_WHOLE = data_of(DEMO)
# One message each way is enough beside those that are added: each is tried in every test.
_KEPT = ("StationRead", "VentJammed", "TextShow")
DATA = {
    **{key: each for key, each in _WHOLE.items() if key not in ("errata", "lookalikes")},
    "messages": {name: _WHOLE["messages"][name] for name in _KEPT},
}
del DATA["messages"]["StationRead"]["reply"]
WAY = "station -> gateway"
ID = {"id": 0x77, "direction": WAY}
DOOR: dict[str, Any] = {
    **ID,
    "summary": "A door is open.",
    "cite": "manual, section 9",
    "length": 1,
    "fields": {"door": {"type": "u8", "about": "Which door."}},
}
ROOM, WHICH = {"type": "u8", "about": "Where."}, {"type": "u16", "about": "Which window."}
WINDOW = DOOR | {"summary": "A window is open.", "length": 3}
WINDOW["fields"] = {"room": ROOM, "window": WHICH}
LIMIT: dict[str, Any] = {**ID, "name": "DoorOpened", "why": "Up to 1.0.0 it was that."}
REASON = "No station has it."


def house(
    messages: dict[str, Any],
    reserved: Sequence[dict[str, Any]] = (),
    breaks: dict[str, str] | None = None,
) -> dict[str, Any]:
    """Return a spec with more messages, more reservations, and accepted breaks."""
    entry = {"version": "9.0.0", "changes": ["It."], "breaks": breaks or {}}
    return {
        **DATA,
        "messages": {**DATA["messages"], **messages},
        "reserved": [*DATA.get("reserved", ()), *reserved],
        "history": [entry] if breaks else [],
    }
