"""A navigator.serial for a page under test, whose ports lead to boards in this process."""

from __future__ import annotations

from collections import deque
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

if TYPE_CHECKING:
    from playwright.sync_api import BrowserContext
    from playwright.sync_api import Page as Tab

FAKE_SERIAL = Path(__file__).parent / "fake_serial.js"
_HOST = """
(() => {
  const call = (name) => (...given) => window[`serial_${name}`](...given);
  const names = ["choose", "open", "write", "read", "close"];
  const fake = makeFakeSerial(Object.fromEntries(names.map((name) => [name, call(name)])));
  Object.defineProperty(navigator, "serial", { value: fake, configurable: true });
})();
"""
# An adapter with the CH340, which is on many boards.
ADAPTER = {"usbVendorId": 0x1A86, "usbProductId": 0x7523}


class End(Protocol):
    """What is behind a port: a board at its line."""

    def read(self) -> bytes:
        """Return the bytes that have come."""

    def write(self, data: bytes) -> None:
        """Take the bytes that were sent."""


class SerialHost:
    """One port, which a page may open, with a board behind it; and what can go wrong with it."""

    def __init__(self, context: BrowserContext, end: End) -> None:
        self.end = end
        self.number = 1
        # What the user chooses is this port, or none.
        self.chosen = True
        self.refused = False
        self.write_error = ""
        self.one_by_one = False
        self.opened: list[dict[str, Any]] = []
        self.closed = 0
        self.written = b""
        # What the line says besides: {"bytes": […]}, or {"error": name, "fatal": bool}.
        self.said: deque[dict[str, Any]] = deque()
        for name in ("choose", "open", "write", "read", "close"):
            context.expose_function(f"serial_{name}", getattr(self, f"_{name}"))
        context.add_init_script(FAKE_SERIAL.read_text("utf-8") + _HOST)

    def unplug(self, tab: Tab) -> None:
        """Pull the cable."""
        tab.evaluate("(id) => navigator.serial.unplug(id)", self._id)

    def plug_in(self, tab: Tab) -> None:
        """Plug it in again; the browser sees a new port of the same adapter."""
        self.number += 1
        tab.evaluate("(given) => navigator.serial.plugIn(given)", self._port)

    @property
    def is_open(self) -> bool:
        return len(self.opened) > self.closed

    @property
    def _id(self) -> str:
        return f"port {self.number}"

    @property
    def _port(self) -> dict[str, Any]:
        return {"id": self._id, "info": ADAPTER}

    def _choose(self) -> dict[str, Any] | None:
        return self._port if self.chosen else None

    def _open(self, _id: str, settings: dict[str, Any]) -> bool:
        if not self.refused:
            self.opened.append(settings)
        return self.refused

    def _write(self, _id: str, data: list[int]) -> str:
        if not self.write_error:
            self.written += bytes(data)
            self.end.write(bytes(data))
        return self.write_error

    def _read(self, _id: str) -> list[dict[str, Any]]:
        data = self.end.read()
        pieces = [data[at : at + 1] for at in range(len(data))] if self.one_by_one else [data]
        said = [{"bytes": [*piece]} for piece in pieces if piece]
        while self.said:
            said.append(self.said.popleft())
        return said

    def _close(self, _id: str) -> None:
        self.closed += 1
