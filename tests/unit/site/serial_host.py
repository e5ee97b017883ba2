"""A navigator.serial for a page under test, whose ports lead to boards in this process."""

import time
from collections import deque
from pathlib import Path
from typing import Any, Protocol

from framewire.simulator.virtual_line import VirtualLine
from playwright.sync_api import BrowserContext
from playwright.sync_api import Page as Tab

from tests.contract.independent.board import Board
from tests.timeouts import GENEROUS

FAKE_SERIAL = Path(__file__).parent / "fake_serial.js"
_HOST = """
(() => {
  const call = (name) => (...given) => window[`serial_${name}`](...given);
  const names = ["choose", "open", "write", "close"];
  const host = Object.fromEntries(names.map((name) => [name, call(name)]));
  // Bytes come as hex, which takes less of the time of both ends than a list of numbers.
  host.read = async (id) => (await call("read")(id)).map(({ hex, ...rest }) => (
    hex ? { bytes: hex.match(/../g).map((digits) => parseInt(digits, 16)) } : rest));
  const fake = makeFakeSerial(host);
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


class VirtualEnd:
    """A board of the simulator."""

    def __init__(self, line: VirtualLine) -> None:
        self._transport = line.transport

    def read(self) -> bytes:
        return self._transport.read(0)

    def write(self, data: bytes) -> None:
        self._transport.write(data)


class IndependentEnd:
    """The board that shares no code with the library."""

    def __init__(self, board: Board) -> None:
        self._board = board

    def read(self) -> bytes:
        return self._board.read(time.monotonic())

    def write(self, data: bytes) -> None:
        self._board.write(data, time.monotonic())


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
        # What the page was given of what the board said.
        self.given = b""
        # What the line says besides: {"hex": digits}, or {"error": name, "fatal": bool}.
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
        refused = self.refused or self.is_open
        if not refused:
            self.opened.append(settings)
        return refused

    def _write(self, _id: str, data: list[int]) -> str:
        if not self.write_error:
            self.written += bytes(data)
            self.end.write(bytes(data))
        return self.write_error

    def _read(self, _id: str) -> list[dict[str, Any]]:
        data = self.end.read()
        self.given += data
        pieces = [data[at : at + 1] for at in range(len(data))] if self.one_by_one else [data]
        events = [{"hex": piece.hex()} for piece in pieces if piece] + [*self.said]
        self.said.clear()
        return events

    def _close(self, _id: str) -> None:
        self.closed += 1


class LiveTab:
    """A page that is connected to a port, or may be; what is done in it, and what it shows."""

    def __init__(self, tab: Tab) -> None:
        self.tab = tab

    def connect(self, timeout: int = 1000 * int(GENEROUS)) -> None:
        """Press the button, and wait until the port is open; replies have so many milliseconds."""
        self.settings()
        self.tab.locator("#line-timeout").fill(str(timeout))
        self.tab.get_by_role("button", name="Connect your board").click()
        self.status("Connected to")

    def settings(self) -> None:
        """Show the settings of the line."""
        self.tab.locator(".line-settings").evaluate("(details) => { details.open = true; }")

    def send(self, name: str, **values: str) -> None:
        """Choose a message in the encoder, and press Send."""
        self.tab.locator("#message").select_option(name)
        words = " ".join(f"{field}={value}" for field, value in values.items())
        if words:
            self.tab.locator("#words").fill(words)
        self.tab.locator("#line-send").click()

    def status(self, begins: str) -> None:
        """Wait for a status that begins so."""
        self._shows("#line-status", begins)

    def reply(self, begins: str) -> str:
        """Wait for what is said beside Send, and return all of it."""
        self._shows("#line-reply", begins)
        return self.tab.locator("#line-reply").inner_text()

    def count(self, name: str, value: int) -> None:
        """Wait until a counter has a value."""
        self._shows(f"#line-{name}", f"{value:,}", whole=True)

    def advice(self) -> str:
        return self.tab.locator("#line-advice").inner_text()

    def drawn(self) -> None:
        """Wait until the list shows all that has come: it draws many rows together."""
        self.tab.locator("#line-log:not([aria-busy])").wait_for()

    def rows(self) -> list[str]:
        """Return what the last entries say, received and sent."""
        self.drawn()
        return self.tab.locator("#line-log .says").all_inner_texts()

    def comments(self) -> list[str]:
        """Return what has happened to the line, without the time."""
        self.drawn()
        texts = self.tab.locator("#line-log .comment").all_inner_texts()
        return [text.partition(" s: ")[2] for text in texts]

    def recording(self) -> bytes:
        """Download the recording, and return what is in the file."""
        with self.tab.expect_download() as download:
            self.tab.get_by_role("button", name="Download the recording").click()
        return Path(download.value.path()).read_bytes()

    def close(self) -> None:
        """Press Disconnect, and wait until the port is closed."""
        self.tab.get_by_role("button", name="Disconnect").click()
        self.status("Not connected.")

    def _shows(self, selector: str, text: str, *, whole: bool = False) -> None:
        self.tab.wait_for_function(
            """([selector, text, whole]) => {
                const shown = document.querySelector(selector).textContent;
                return whole ? shown === text : shown.startsWith(text);
            }""",
            arg=[selector, text, whole],
        )
