"""A board on the line of a page, in a real browser: asked, answered, and recorded."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

from busservo import BatteryVoltage, BatteryVoltageRead, recordings
from busservo_simulator import VirtualController

from tests.unit.site.browser import Visit, launched, needs_chromium, site_on_disk
from tests.unit.site.serial_host import LiveTab, SerialHost, VirtualEnd

if TYPE_CHECKING:
    from pathlib import Path

# Press a button twice before anything else can happen, and return what is said of it.
TWICE = """(send) => {
    send.click();
    send.click();
    return document.querySelector("#line-reply").textContent;
}"""


@needs_chromium
def test_a_page_asks_a_board_and_records_the_answer(tmp_path: Path) -> None:
    folder = site_on_disk(tmp_path / "the reference")
    with launched() as browser, VirtualController(battery_mv=7123) as board:
        context = browser.new_context()
        host = SerialHost(context, VirtualEnd(board))
        visit = Visit(context, folder)
        live = LiveTab(visit.open("decoder.html"))
        live.connect()
        live.send("BatteryVoltageRead")
        assert "after BatteryVoltageRead was sent" in live.reply(
            "BatteryVoltage voltage_mv=7123 mV, "
        )
        # What is pressed before the reply has come is sent behind it, and says so.
        said = live.tab.locator("#line-send").evaluate(TWICE)
        assert said.startswith("BatteryVoltageRead is sent once the question before it is ")
        live.count("frames", 3)
        entries = [*recordings.read(io.BytesIO(live.recording()))]
        assert [(entry.sender, entry.event) for entry in entries] == [
            ("host", BatteryVoltageRead()),
            ("controller", BatteryVoltage(7123)),
        ] * 3
        live.close()
        assert host.opened == [{"baudRate": 9600, "dataBits": 8, "parity": "none", "stopBits": 1}]
        assert not host.is_open
        visit.end()
