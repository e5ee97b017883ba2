"""Boards on the line of a page, in a real browser: what they say, and all that can go wrong."""

import io
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import busservo
import pytest
from busservo import BatteryVoltage, BatteryVoltageRead, StreamDecoder, recordings
from busservo._library import CODEC
from busservo_simulator import Faults, VirtualController
from framegen.cli import main
from lxservo_simulator import VirtualBus
from playwright.sync_api import Browser

from tests.contract.independent import faults
from tests.contract.independent.board import Board
from tests.contract.independent.faults import Script
from tests.unit.site.browser import Visit, needs_chromium
from tests.unit.site.reference import ROOT
from tests.unit.site.serial_host import End, IndependentEnd, LiveTab, SerialHost, VirtualEnd

VOLTAGE = BatteryVoltage(7500).encode()

pytestmark = needs_chromium


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a folder with a site for each of two protocols."""
    out = tmp_path_factory.mktemp("stick")
    for name in ("busservo", "lxservo"):
        spec = str(ROOT / "spec" / f"{name}.yaml")
        assert main(["docs", spec, "--out", str(out / name)]) == 0
    return out


class Desk:
    """A page, a port and a board."""

    def __init__(self, browser: Browser, site: Path, end: End, **screen: Any) -> None:
        self.context = browser.new_context(**screen)
        self.host = SerialHost(self.context, end)
        self.site = site
        self.visits: list[Visit] = []

    def open(self, protocol: str = "busservo") -> LiveTab:
        """Open the workbench in a new tab."""
        self.visits.append(Visit(self.context, self.site / protocol / "reference" / protocol))
        return LiveTab(self.visits[-1].open("decoder.html"))

    def end(self) -> None:
        """Close all; fail if a page had errors, or asked for anything."""
        for visit in self.visits:
            visit.end()
        self.context.close()


@contextmanager
def desk(browser: Browser, site: Path, end: End, **screen: Any) -> Iterator[Desk]:
    made = Desk(browser, site, end, **screen)
    yield made
    made.end()


@pytest.fixture
def board() -> Iterator[VirtualController]:
    with VirtualController() as board:
        yield board


@pytest.fixture
def made(browser: Browser, site: Path, board: VirtualController) -> Iterator[Desk]:
    """Return a desk with that board."""
    with desk(browser, site, VirtualEnd(board)) as made:
        yield made


@pytest.fixture
def live(made: Desk) -> LiveTab:
    """Return the workbench at that desk, connected."""
    live = made.open()
    live.connect()
    return live


def events(recording: bytes, sender: str | None = None) -> list[Any]:
    """Return what Python reads in a recording of the page."""
    found = recordings.read(io.BytesIO(recording))
    return [entry.event for entry in found if sender in (None, entry.sender)]


def data_of(found: list[Any]) -> bytes:
    return b"".join(
        event.encode() if isinstance(event, busservo.Message) else event.data for event in found
    )


# ---------------------------------------------------------------------------- what is said

SENT = [
    ("BatteryVoltageRead", {}, "BatteryVoltage voltage_mv=7500 mV, "),
    ("ServoPositionsRead", {"servo_ids": "2,1"}, "ServoPositions positions=2:500,1:500, "),
    ("ServoMove", {"time_ms": "100", "targets": "1:600"}, "ServoMove is sent. Nothing answers it."),
    ("ServoUnload", {"servo_ids": "3"}, "ServoUnload is sent. Nothing answers it."),
    ("ActionGroupStop", {}, "ActionGroupStop is sent. Nothing answers it, though"),
]
# Press a button twice before anything else can happen, and return what is said of it.
TWICE = """(send) => {
    send.click();
    send.click();
    return document.querySelector("#line-reply").textContent;
}"""


def test_what_is_sent_is_answered_or_said_to_have_no_answer(
    board: VirtualController, made: Desk, live: LiveTab
) -> None:
    for name, values, reply in SENT:
        live.send(name, **values)
        live.reply(reply)
    live.count("sent", len(SENT))
    assert not board.servos[3].loaded
    assert [type(event).__name__ for event in events(live.recording(), "host")] == [
        name for name, *_ in SENT
    ]
    assert made.host.opened == [{"baudRate": 9600, "dataBits": 8, "parity": "none", "stopBits": 1}]


def test_what_is_pressed_before_the_reply_has_come_is_sent_behind_it(live: LiveTab) -> None:
    live.send("BatteryVoltageRead")
    assert "after BatteryVoltageRead was sent" in live.reply("BatteryVoltage voltage_mv=7500 mV, ")
    said = live.tab.locator("#line-send").evaluate(TWICE)
    assert said.startswith("BatteryVoltageRead is sent once the question before it is ")
    live.count("frames", 3)
    entries = [*recordings.read(io.BytesIO(live.recording()))]
    asked, answered = ("host", BatteryVoltageRead()), ("controller", BatteryVoltage(7500))
    assert [(entry.sender, entry.event) for entry in entries] == [asked, answered] * 3


def test_what_the_other_end_sends_is_not_sent(made: Desk, live: LiveTab) -> None:
    live.tab.locator("#message").select_option("BatteryVoltage")
    assert live.tab.locator("#line-send").is_disabled()
    expects = live.tab.locator("#line-expects").inner_text()
    assert expects.startswith("BatteryVoltage is what the controller sends")
    live.tab.locator("#message").select_option("BatteryVoltageRead")
    assert live.tab.locator("#line-send").is_enabled()
    assert made.host.written == b""


def test_what_is_beyond_the_limits_is_not_sent(made: Desk, live: LiveTab) -> None:
    """It is refused in the client's words, until somebody chooses other limits."""
    # Whoever only presses Send moves nothing.
    live.tab.locator("#line-send").click()
    live.reply("BatteryVoltage voltage_mv=7500 mV, ")
    asked = made.host.written
    choice = live.tab.get_by_label("Limits of what is sent")
    values = {"time_ms": "100", "targets": "1:500,2:1200"}
    live.send("ServoMove", **values)
    bounds = "targets[1].position: 1200 is outside the limits 0..1000"
    way_out = "limits=(500, 2500) is for PWM servo boards, limits=None for any"
    assert live.reply("ServoMove is not sent.") == f"ServoMove is not sent. {bounds}; {way_out}"
    assert made.host.written == asked
    live.count("sent", 1)
    choice.select_option("(500, 2500): PWM servo boards")
    assert live.tab.locator("#line-reply").inner_text() == ""
    live.send("ServoMove", **values)
    live.reply("ServoMove is sent.")
    live.send("ServoMove", time_ms="100", targets="1:300")
    live.reply("ServoMove is not sent. targets[0].position: 300 is outside the limits 500..2500")
    choice.select_option("None: anything")
    live.send("ServoMove", time_ms="100", targets="1:5000")
    live.reply("ServoMove is sent.")
    moves = [((1, 500), (2, 1200)), ((1, 5000),)]
    live.count("sent", 3)
    sent = b"".join(busservo.ServoMove(100, targets).encode() for targets in moves)
    assert made.host.written == asked + sent


@pytest.mark.parametrize("one_by_one", [False, True])
@pytest.mark.parametrize("seed", range(3))
def test_a_bad_line_loses_nothing(
    browser: Browser, site: Path, seed: int, one_by_one: bool
) -> None:
    """All bytes are shown, in order; and what was whole is recorded as Python decodes it."""
    bad = Faults(seed=seed, noise=0.3, lost_bytes=0.02, bit_flips=0.02, splits=0.3, duplicated=0.2)
    board = VirtualController(baud=115200, faults=bad)
    with board, desk(browser, site, VirtualEnd(board)) as made:
        made.host.one_by_one = one_by_one
        live = made.open()
        # A reply that is lost keeps the next question waiting for no longer.
        live.connect(timeout=20)
        live.tab.locator("#message").select_option("ServoPositionsRead")
        # So many may wait for the replies to those before them.
        for number in range(16):
            board.press_button(number % 3)
            live.tab.locator("#line-send").click()
            live.tab.wait_for_timeout(20)
        live.count("sent", 16)
        # Groups that run report their end.
        live.tab.wait_for_timeout(2000)
        live.count("bytes", len(made.host.given))
        live.close()
        found = events(live.recording(), "controller")
        assert data_of(found) == made.host.given
        assert len(found) > 10
        decoder = StreamDecoder(CODEC.received)
        known = [*decoder.feed(made.host.given), *decoder.flush()]
        whole = [event for event in known if isinstance(event, busservo.Message)]
        # Where a frame was given up after a silence, more may be found than in one piece.
        assert sum(isinstance(event, busservo.Message) for event in found) >= len(whole) - 3


def test_both_ends_are_told_apart_where_they_can_be(made: Desk) -> None:
    live = made.open()
    live.settings()
    live.tab.locator("#line-listen").select_option("any")
    live.connect()
    for message in [BatteryVoltageRead(), busservo.ActionGroupStarted(3, 1)]:
        made.host.said.append({"hex": message.encode().hex()})
        live.tab.wait_for_timeout(100)
    live.count("frames", 2)
    live.drawn()
    ways = live.tab.locator("#line-log .way-of").all_inner_texts()
    assert ways == ["host → controller", "either"]
    assert live.rows()[1] == "ActionGroupRun or ActionGroupStarted group=3 times=1"
    entries = [*recordings.read(io.BytesIO(live.recording()))]
    assert [entry.sender for entry in entries] == ["host", None]


# ---------------------------------------------------------------------------- replies

SCRIPTS: dict[str, tuple[Script, str]] = {
    "whole": (faults.whole, "BatteryVoltage voltage_mv={} mV, "),
    "duplicated": (faults.duplicated(0.02), "BatteryVoltage voltage_mv={} mV, "),
    "dropped": (faults.dropped, "No reply to BatteryVoltageRead within 2010 ms. "),
    "cut": (faults.cut(4), "No reply to BatteryVoltageRead within 2010 ms. "),
    "late": (faults.late(3), "BatteryVoltage came after all, "),
}


@pytest.mark.parametrize("script", SCRIPTS)
def test_a_reply_is_that_to_its_own_question(browser: Browser, site: Path, script: str) -> None:
    """The independent board numbers its replies, so that it shows which question each answers."""
    fault, reply = SCRIPTS[script]
    board = Board(baud=9600, faults=lambda number: fault if number % 2 else faults.whole)
    with desk(browser, site, IndependentEnd(board)) as made:
        live = made.open()
        live.connect(timeout=2000)
        for number in range(1, 5):
            live.send("BatteryVoltageRead")
            expected = reply if number % 2 else "BatteryVoltage voltage_mv={} mV, "
            live.reply(expected.format(number))
            live.tab.wait_for_timeout(100)
        assert board.accepted == board.questions == 4
        live.count("sent", 4)


def test_silence_is_said_in_plain_words(browser: Browser, site: Path) -> None:
    board = VirtualController(faults=Faults(dropped=1.0))
    with board, desk(browser, site, VirtualEnd(board)) as made:
        live = made.open()
        live.connect(timeout=250)
        live.send("BatteryVoltageRead")
        assert "Nothing was ever heard on this line" in live.reply("No reply to ")
        board.send_bytes(VOLTAGE)
        live.count("frames", 1)
        live.send("BatteryVoltageRead")
        live.reply("BatteryVoltageRead is sent; BatteryVoltage is waited for.")
        assert "Something else was heard" in live.reply("No reply to ")
        live.count("errors", 2)
        # Nor does a pulled cable leave anybody waiting.
        live.send("BatteryVoltageRead")
        made.host.unplug(live.tab)
        live.status("The line was lost")
        live.reply("No reply to BatteryVoltageRead")
        live.tab.get_by_role("button", name="Give up").click()
        live.status("Not connected.")
        assert not made.host.is_open


# ---------------------------------------------------------------------------- what goes wrong

FAULTS = {
    "FramingError": "the rate of the line may be wrong",
    "ParityError": "the settings of the line may be wrong",
    "BreakError": "see that both grounds are joined",
    "BufferOverrunError": "Bytes were lost",
}


def test_a_line_goes_on_after_errors(made: Desk, live: LiveTab) -> None:
    for number, name in enumerate(FAULTS, 1):
        made.host.said.append({"error": name})
        live.count("errors", number)
    for said, words in zip(live.comments()[1:], FAULTS.values(), strict=True):
        assert words in said
    made.host.write_error = "UnknownError"
    live.send("ActionGroupStop")
    assert "The write has failed." in live.reply("ActionGroupStop was not sent.")
    made.host.write_error = ""
    live.send("BatteryVoltageRead")
    live.reply("BatteryVoltage voltage_mv=7500 mV, ")


def test_a_cable_is_pulled_in_the_middle_of_a_frame(made: Desk, live: LiveTab) -> None:
    made.host.said.append({"hex": VOLTAGE[:4].hex()})
    live.count("bytes", 4)
    made.host.unplug(live.tab)
    live.status("The line was lost")
    assert "chosen anew" in live.advice()
    assert live.tab.locator("#line-send").is_disabled()
    made.host.plug_in(live.tab)
    live.status("Connected to USB 1A86:7523")
    live.send("BatteryVoltageRead")
    live.reply("BatteryVoltage voltage_mv=7500 mV, ")
    found = events(live.recording(), "controller")
    assert [type(event).__name__ for event in found] == ["Noise", "BatteryVoltage"]
    assert data_of(found) == VOLTAGE[:4] + VOLTAGE
    connected = "connected to USB 1A86:7523"
    assert live.comments() == [connected, "the line was lost", connected]
    live.close()
    assert not made.host.is_open


def test_a_port_that_does_not_open_says_why(made: Desk) -> None:
    live, second = made.open(), made.open()
    connect = live.tab.get_by_role("button", name="Connect your board")
    made.host.refused = True
    connect.click()
    live.status("The port cannot be opened: it is in use, or this user may not open it.")
    assert "dialout" in live.advice()
    made.host.refused = made.host.chosen = False
    connect.click()
    live.status("No port was chosen.")
    assert "driver of the adapter" in live.advice()
    made.host.chosen = True
    live.settings()
    for rate in ["", "0", "-1", "9600.5"]:
        live.tab.locator("#line-baud").fill(rate)
        connect.click()
        live.status("The rate of the line is a whole number")
    live.tab.locator("#line-baud").fill("115200")
    live.connect()
    assert live.advice() == ""
    assert [each["baudRate"] for each in made.host.opened] == [115200]
    # A second tab says that the first has the port.
    second.tab.get_by_role("button", name="Connect your board").click()
    second.status("The port cannot be opened: it is in use")
    assert "another tab of this browser" in second.advice()
    live.close()
    second.connect()


def test_a_port_that_was_allowed_before_needs_no_choice(made: Desk) -> None:
    live = made.open()
    made.host.chosen = False
    made.host.plug_in(live.tab)
    live.tab.get_by_role("button", name="Connect to USB 1A86:7523 again").click()
    live.status("Connected to")


def test_a_page_that_is_left_closes_its_port(made: Desk, live: LiveTab) -> None:
    live.tab.evaluate("() => dispatchEvent(new PageTransitionEvent('pagehide'))")
    live.status("Not connected.")
    assert not made.host.is_open


@pytest.mark.parametrize("said", [True, False])
def test_a_single_wire_gives_back_what_is_sent(browser: Browser, site: Path, said: bool) -> None:
    with VirtualBus(local_echo=True) as bus, desk(browser, site, VirtualEnd(bus)) as made:
        live = made.open("lxservo")
        live.settings()
        live.tab.locator("#line-echo").set_checked(said)
        live.connect()
        live.send("PositionRead", servo_id="1")
        live.reply("P")
        frame = made.host.written
        live.count("noise", 0 if said else len(frame))
        live.count("bytes", len(made.host.given))


# ---------------------------------------------------------------------------- a page that lasts


def test_a_long_session_stays_small(made: Desk, live: LiveTab) -> None:
    block = (VOLTAGE * 2000).hex()
    for _ in range(5):
        made.host.said.append({"hex": block})
    live.count("frames", 10_000)
    assert live.tab.locator("#line-log li").count() <= 300
    assert live.tab.locator("#content *").count() < 3500
    assert len(events(live.recording())) == 10_000


def test_the_list_is_held_and_goes_on(board: VirtualController, live: LiveTab) -> None:
    live.tab.get_by_role("button", name="Hold the list").click()
    board.send_bytes(VOLTAGE)
    live.count("frames", 1)
    assert live.rows() == []
    live.tab.get_by_role("button", name="Hold the list").click()
    live.tab.wait_for_function("() => document.querySelectorAll('#line-log .says').length === 1")
    live.tab.locator("#line-clear").click()
    live.count("frames", 0)
    assert live.rows() == []


def test_the_recording_goes_to_the_list_of_the_page(live: LiveTab) -> None:
    live.send("BatteryVoltageRead")
    live.reply("BatteryVoltage ")
    live.close()
    live.tab.get_by_role("button", name="Load it into the workbench").click()
    live.tab.wait_for_function(
        "() => document.getElementById('decoded').textContent.includes('10 bytes: 2 messages')"
    )


def test_the_keyboard_is_enough(made: Desk) -> None:
    live = made.open()

    def pressed(button: str) -> None:
        live.tab.locator(button).focus()
        live.tab.keyboard.press("Enter")

    pressed("#line-connect")
    live.status("Connected to")
    assert live.tab.evaluate("document.activeElement.id") == "line-close"
    pressed("#line-send")
    live.count("sent", 1)
    assert live.tab.evaluate("document.activeElement.id") == "line-send"
    pressed("#line-close")
    live.status("Not connected.")
    assert live.tab.evaluate("document.activeElement.id") == "line-connect"


@pytest.mark.parametrize("has_serial", [True, False])
def test_a_page_from_the_disk_reaches_the_browsers_own_ports_or_says_that_it_has_none(
    browser: Browser, site: Path, has_serial: bool
) -> None:
    """Chromium counts the disk as secure, and the page's policy does not stand in the way."""
    context = browser.new_context()
    if not has_serial:
        context.add_init_script("delete Navigator.prototype.serial")
    visit = Visit(context, site / "busservo" / "reference" / "busservo")
    tab = visit.open("decoder.html")
    for part in ("#line-connect", "#line-send"):
        assert tab.locator(part).is_visible() == has_serial
    if has_serial:
        ports = "async () => [isSecureContext, (await navigator.serial.getPorts()).length]"
        assert tab.evaluate(ports) == [True, 0]
    else:
        said = tab.locator("#line-unavailable").inner_text()
        assert said.startswith("This browser cannot open a serial port: it has no Web Serial.")
        assert "busservo monitor" in said
    visit.end()
    context.close()


@pytest.mark.parametrize(("width", "height"), [(1440, 900), (1024, 768), (320, 640)])
def test_what_is_sent_and_what_the_line_says_are_seen_together(
    browser: Browser, site: Path, board: VirtualController, width: int, height: int
) -> None:
    screen = {"viewport": {"width": width, "height": height}}
    with desk(browser, site, VirtualEnd(board), **screen) as made:
        live = made.open()
        live.connect()
        live.send("ServoMove", time_ms="100", targets="1:600")
        live.reply("ServoMove is sent.")
        for name in ("#line-send", "#message"):
            live.tab.locator(name).focus()
            live.tab.locator(name).scroll_into_view_if_needed()
            boxes = [live.tab.locator(each).bounding_box() for each in (name, "#line-log")]
            assert all(boxes), name
            (chosen, log) = (box for box in boxes if box is not None)
            # The list stands above what one works with, and covers none of it.
            assert log["y"] >= 0
            assert log["height"] >= 140
            assert log["y"] + log["height"] <= chosen["y"]
            assert chosen["y"] + chosen["height"] <= height + 1
        assert live.tab.evaluate("document.documentElement.scrollWidth") <= width
