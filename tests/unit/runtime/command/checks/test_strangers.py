"""The doctor before devices that are not the board, and a board that stumbles: what it affirms."""

from collections.abc import Callable
from functools import partial
from importlib import import_module
from typing import Any, NamedTuple

import pytest
from framewire.command.checks.checks import checks_of, examine
from framewire.command.checks.diagnosis import Diagnosis
from framewire.command.checks.result import FAILED, PASSED, UNKNOWN, Result
from framewire.command.plain_text import plain_text
from framewire.line.serial_port import SerialPortSeen
from hypothesis import example, given
from hypothesis import strategies as st

from tests.contract.independent.board import Board
from tests.contract.independent.faults import Piece, cut, dropped, followed, lost
from tests.contract.independent.firmware import battery_question, battery_reply
from tests.contract.independent.levels import received
from tests.contract.independent.ports import StrangersPort, VirtualPort
from tests.contract.independent.strangers import BANNER, GPS, MODEM, SKETCH, Print, Stranger
from tests.handed import program_of
from tests.in_turn import in_turn
from tests.lines.patient import LONGEST
from tests.lines.servo_bus import frame
from tests.protocols.libraries import Libraries
from tests.protocols.specs import FILES
from tests.rows import some

SERVO_BUS = bytes.fromhex("55 55 01 07 01 20 03 E8 03 E8")
DIALECT = bytes.fromhex("55 55 05 0A 01 02 03")


def examined(device: Stranger | Board, package: str = "busservo") -> dict[str, Result]:
    """Return the result of each check of a library's doctor."""
    program = program_of(package)
    port = StrangersPort(device) if isinstance(device, Stranger) else VirtualPort(device)

    def opened(_: str, rate: float) -> Any:
        return port.opened(rate) if isinstance(port, StrangersPort) else port.reopen()

    link = program.library.link
    looked = Diagnosis(
        *(program, "COM9"),
        baud=link.baud,
        local_echo=link.local_echo,
        opener=opened,
        ports=lambda: [SerialPortSeen("COM9", "1A86:7523", "USB Serial", "")],
        hid_devices=list,
        clock=port.clock,
    )
    every = checks_of(program.library)
    found = {check.id: result for check, result in examine(looked, every)}
    assert port.now < LONGEST
    return found


def answering(reply: bytes) -> Callable[[bytes], bytes]:
    """Answer the question about the battery, and nothing else."""
    return lambda heard: reply if battery_question() in heard else b""


def stumbling(number: int, script: Any) -> Board:
    """Return a board to the n-th question of which something happens; it is deaf to the next."""
    return Board(baud=9600, faults={number: script, number + 1: dropped}.get)


class Case(NamedTuple):
    """A device, and what the check `look-alike` says of it."""

    device: Callable[[], Stranger | Board]
    state: str
    seen: str
    advice: str = ""
    # What the checks `silence` and `rate` say, where they fail.
    silence: str = ""
    rate: str = ""


REPLY = battery_reply(7500)
NOISE = bytes.fromhex("F8 00 3C 81 1F E0 07 80")
GPS_TEXT = '"$GPGGA,123519,4807.038,N,01131.000'
PORT_GOES = "unplug it, and see which port goes"
AT_WHICH = "see at which rate the device is set"
NO_FRAME = "bytes that are no frame"
NO_REPLY = "bytes came that are no reply"
COMPARE = "compare the bytes with the reference"
RESTARTING = "a device that restarts prints text"
FRAMES = "whole frames (BatteryVoltage)"
WORDS = "bytes came, and no whole frame: they are text:"
NONE_BEGINS = "bytes came, and no whole frame: none begins in them"
ENDS = "bytes came, and no whole frame: one of {} bytes begins, and ends after {}"
OTHER = "frames of another protocol came: "
LEARM = "The dialect of LeArm and uHand boards"
BUS = "LX-16A bus servo protocol"
# What comes once a board has restarted within a reply, and what is said of it.
RESTARTS = {
    "with a banner": (cut(3, Piece(0.1, BANNER)), 'among them text: "ets Jun'),
    "with a banner at once": (cut(3, Piece(0.0, BANNER)), "129 other bytes"),
    # What is left of the reply and the banner together look like a frame of the dialect.
    "with a short banner": (cut(3, Piece(0.1, b"\r\nOK")), 'among them text: "OK"'),
    "with a short banner at once": (cut(3, Piece(0.0, b"\r\nOK")), "7 other bytes"),
    "and noise of its supply": (cut(2, Piece(0.1, b"\xf8\x00")), "4 other bytes"),
}
CASES = {
    "a GPS receiver": Case(
        lambda: Stranger(Print(0.05, GPS, 1.0)),
        *(UNKNOWN, f"not recognised: 411 {WORDS} {GPS_TEXT}", PORT_GOES),
        silence=f"137 bytes of text came unsolicited: {GPS_TEXT}",
        rate=f"274 bytes came, and they are text: {GPS_TEXT}",
    ),
    "a GPS receiver at 4800 baud": Case(
        lambda: Stranger(Print(0.05, GPS, 1.0), rate=4800),
        *(UNKNOWN, f"not recognised: at 4800 baud, text came: {GPS_TEXT}", PORT_GOES),
        silence=f"{NO_FRAME} came unsolicited",
        rate=NO_REPLY,
    ),
    "a modem": Case(
        lambda: Stranger(answer=lambda _: MODEM),
        *(UNKNOWN, f'not recognised: 18 {WORDS} "ERROR"', PORT_GOES),
        rate='18 bytes came, and they are text: "ERROR',
    ),
    "a modem that echoes": Case(
        lambda: Stranger(answer=lambda heard: heard + MODEM),
        *(UNKNOWN, 'they are text: "ERROR"', PORT_GOES),
        rate='they are text: "ERROR',
    ),
    "an Arduino": Case(
        lambda: Stranger(Print(0.1, SKETCH, 0.1)),
        *(UNKNOWN, 'they are text: "distance = 17 cm"', PORT_GOES),
        silence="54 bytes of text came unsolicited",
        rate="they are text",
    ),
    "a banner and nothing else": Case(
        lambda: Stranger(Print(0.1, BANNER), resets=True),
        *(UNKNOWN, 'they are text: "ets Jun  8 2016 00:22:57', RESTARTING),
        silence="126 bytes of text came unsolicited",
        rate="nothing came at all",
    ),
    "a banner, and then the board": Case(
        lambda: Stranger(Print(0.1, BANNER), answer=answering(REPLY), resets=True),
        *(PASSED, f'11 {FRAMES}; not recognised: 126 other bytes, among them text: "ets Jun'),
        silence="126 bytes of text came unsolicited",
    ),
    "an inverted line": Case(
        lambda: Stranger(answer=answering(REPLY), inverted=True),
        *(UNKNOWN, f"not recognised: 12 {ENDS.format(97, 6)}", "inverted"),
        rate=f"12 {NO_REPLY}",
    ),
    "a GPS receiver on an inverted line": Case(
        lambda: Stranger(Print(0.05, GPS, 1.0), inverted=True),
        *(UNKNOWN, NONE_BEGINS, "inverted"),
        silence=f"{NO_FRAME} came unsolicited",
        rate=NO_REPLY,
    ),
    "noise": Case(
        lambda: Stranger(Print(0.05, NOISE, 0.7)),
        *(UNKNOWN, NONE_BEGINS, AT_WHICH),
        silence=f"8 {NO_FRAME}",
        rate=NO_REPLY,
    ),
    "headers and nothing else": Case(
        lambda: Stranger(answer=lambda _: bytes.fromhex("55 55 00 12 55 55 01 00")),
        *(UNKNOWN, "they begin as a frame does, and are none", COMPARE),
        rate=f"16 {NO_REPLY}",
    ),
    "replies short of a byte": Case(
        lambda: Board(baud=9600, faults=lambda _: cut(-1)),
        *(UNKNOWN, f"not recognised: 10 {ENDS.format(6, 5)}", "bytes are lost on the way"),
        rate=f"10 {NO_REPLY}",
    ),
    "replies without their header": Case(
        lambda: Board(baud=9600, faults=lambda _: lost(0, 1)),
        *(UNKNOWN, "bytes came, and no whole frame", AT_WHICH),
        rate=f"10 {NO_REPLY}",
    ),
    "one reply short of a byte": Case(
        lambda: stumbling(5, cut(-1)), PASSED, "not recognised: 5 other bytes"
    ),
    **{
        f"a restart within a reply, {name}": Case(partial(stumbling, 5, script), PASSED, seen)
        for name, (script, seen) in RESTARTS.items()
    },
    "the board": Case(
        lambda: Board(baud=9600),
        *(PASSED, "what came is this protocol: 15 whole frames (BatteryVoltage, ServoPositions)"),
    ),
    "the board at another rate": Case(
        lambda: Stranger(answer=answering(REPLY), rate=115200),
        *(PASSED, f"what came is this protocol: 11 {FRAMES}"),
        rate="was not answered at 9600 baud, but is at 115200",
    ),
    "the servos' own bus": Case(
        lambda: Stranger(Print(0.05, SERVO_BUS, 0.5)),
        *(FAILED, f"{OTHER}{BUS}", "look-alikes"),
        silence=f"10 {NO_FRAME}",
        rate=NO_REPLY,
    ),
    "a board of the dialect": Case(
        lambda: Stranger(Print(0.05, DIALECT, 0.5)),
        *(FAILED, f"{OTHER}{LEARM}", "look-alikes"),
        silence=f"7 {NO_FRAME}",
        rate=NO_REPLY,
    ),
    "the board, and the servos' own bus": Case(
        lambda: Board(baud=9600, faults={5: followed(SERVO_BUS, 0.01)}.get),
        *(FAILED, f"{OTHER}{BUS}", "look-alikes"),
    ),
}


@in_turn("name", lambda: CASES)
def test_only_what_is_recognised_is_said_to_be_a_protocol(name: str) -> None:
    case = CASES[name]
    found = examined(case.device())
    look_alike = found["look-alike"]
    assert (look_alike.state, case.seen in look_alike.seen) == (case.state, True), look_alike
    assert case.advice in look_alike.advice
    for check in ("silence", "rate"):
        expected = getattr(case, check)
        assert (found[check].state == FAILED) is bool(expected), found[check]
        assert expected in found[check].seen
    if case.state == UNKNOWN:
        assert look_alike.seen.startswith("not recognised: ")
        assert look_alike.evidence
        assert look_alike.advice


TEXTS = st.text("0123456789abcXYZ$,.=*: \r\n", min_size=1, max_size=80).map(str.encode)


@given(data=TEXTS | st.binary(min_size=1, max_size=60), inverted=st.booleans())
@example(data=b"UU\x04\r\nOK", inverted=False)
@example(data=b"UUU\r\nUUU", inverted=False)
@example(data=received(GPS, sent_at=9600, read_at=115200), inverted=False)
def test_what_is_no_frame_never_passes(data: bytes, inverted: bool) -> None:
    found = examined(Stranger(Print(0.05, data, 1.0), inverted=inverted))
    assert found["look-alike"].state != PASSED
    assert found["look-alike"].advice


RATE = 115200
SERVO = Stranger(answer=lambda _: frame(1, 2, *bytes(4)), rate=RATE)


@in_turn(
    "device, state, seen",
    lambda: [
        (Stranger(Print(0.05, GPS, 1.0), rate=RATE), UNKNOWN, f"they are text: {GPS_TEXT}"),
        (Stranger(Print(0.05, REPLY, 1.0), rate=RATE), FAILED, "Hiwonder bus servo controller"),
        (SERVO, PASSED, "what came is this protocol"),
    ],
)
def test_every_library_says_what_it_recognises(device: Stranger, state: str, seen: str) -> None:
    found = examined(device, "lxservo")["look-alike"]
    assert (found.state, seen in found.seen) == (state, True), found


# Devices that are of no protocol, on a line of some rate.
OF_NONE: dict[str, Callable[[float], Stranger]] = {
    "a GPS receiver": lambda rate: Stranger(Print(0.05, GPS, 0.3), rate=rate),
    "a modem": lambda rate: Stranger(answer=lambda _: MODEM, rate=rate),
    "an Arduino": lambda rate: Stranger(Print(0.1, SKETCH, 0.1), rate=rate),
    "a banner": lambda rate: Stranger(Print(0.1, BANNER), rate=rate, resets=True),
    "an inverted line": lambda rate: Stranger(Print(0.05, GPS, 0.3), rate=rate, inverted=True),
    "noise": lambda rate: Stranger(Print(0.05, 10 * NOISE, 0.4), rate=rate),
    "zeros": lambda rate: Stranger(Print(0.05, bytes(20), 0.4), rate=rate),
}
TEXTUAL = {"a GPS receiver", "an Arduino", "a banner"}


@pytest.mark.parametrize("name", some(FILES, lambda name: name == "lxservo"))
def test_no_doctor_takes_what_is_no_protocol_for_its_own(libraries: Libraries, name: str) -> None:
    package = name if name == "lxservo" else libraries[name].__name__
    rate = import_module(f"{package}._library").LINK.baud
    for device, made in OF_NONE.items():
        found = examined(made(rate), package)["look-alike"]
        assert found.state == UNKNOWN, (device, found)
        assert ("text: " in found.seen) is (device in TEXTUAL) or device == "a modem", device


@in_turn(
    "data, text",
    lambda: [
        (b"OK\r\n", '"OK"'),
        (GPS, f'"{GPS[:60].decode()}..."'),
        ("\r\n21,5 °C\r\n".encode(), '"21,5 °C"'),
        (b"a line\r\nthe next\n", r'"a line\r\nthe next"'),
        (b"\x1b[0;32mI (29) boot", r'"\x1b[0;32mI (29) boot"'),
        (b"\xf8I (29) boot: ESP-IDF", '"\ufffdI (29) boot: ESP-IDF"'),
        (bytes.fromhex("55 55 04 0F 4C 1D"), ""),
        (b"UUUU" * 10, ""),
        (b"U\n" * 10, ""),
        (NOISE, ""),
        (bytes(range(256)), ""),
        (b"", ""),
        (b" \t\r\n", ""),
    ],
)
def test_text_is_shown_as_text(data: bytes, text: str) -> None:
    assert plain_text(data) == text
