"""The verbs that need a line, against the virtual controller."""

import argparse
import ast
import json
import re
import shlex
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from types import SimpleNamespace

import pytest
from busservo import Controller, Device, ServoPositions, ServoPositionsRead
from busservo.__main__ import main
from busservo._command import PROGRAM
from busservo.simulator import VirtualDevice
from busservo_simulator import Faults, VirtualController
from framewire.command import link, send, simulate
from framewire.command.method_verb import MethodVerb
from framewire.command.questions import in_parts
from framewire.command.verbs import verb_named
from framewire.line.hid_devices import HidDevice
from framewire.line.serial_port import SerialPortSeen
from serial.tools.list_ports_common import ListPortInfo

from tests.commands import records, run
from tests.documents import ROOT
from tests.in_turn import in_turn
from tests.lines.timed_line import client_on
from tests.lines.virtual_line import VirtualLine
from tests.programs import ran
from tests.timeouts import GENEROUS
from tests.unit.runtime.command.test_settings_file import refused_port

REPLAY = f"replay {ROOT}/tests/captures/noisy_line.bin"
PATIENT = ("--timeout", GENEROUS)
SPLIT = "sent in {} requests: one reply has no room for so much"


def test_a_reply_is_printed_as_decode_prints_it_or_as_json() -> None:
    shown = "     0  controller  BatteryVoltage voltage_mv=7500 mV | 55 55 04 0F 4C 1D\n"
    with VirtualController("tcp") as board:
        words = ("send", "--port", board.port, *PATIENT)
        assert run(*words, "BatteryVoltageRead") == (0, shown, "")
        (record,) = records(*words, "ServoPositionsRead", "servo_ids=1", "--json")
    assert record["fields"] == {"positions": [{"servo_id": 1, "position": 500}]}


def test_a_command_arrives_and_prints_nothing() -> None:
    with VirtualController("tcp") as board:
        words = ("send", "--port", board.port)
        assert run(*words, "ServoUnload", "servo_ids=1,2") == (0, "", "")
        # Its answer proves that the command before it has been taken in.
        assert run(*words, "BatteryVoltageRead", *PATIENT).status == 0
        assert (board.servos[1].loaded, board.servos[3].loaded) == (False, True)
        assert board.rejects.total == 0


def test_a_question_too_large_for_one_reply_is_sent_in_parts() -> None:
    servos = range(1, 201)
    with VirtualController("tcp", servos=servos) as board:
        ids = f"servo_ids={','.join(map(str, servos))}"
        words = ("ServoPositionsRead", ids, "--json", "--baud", "inf")
        status, output, errors = run("send", "--port", board.port, *words, *PATIENT)
        assert board.accepted == 3
    parts = [json.loads(line)["fields"]["positions"] for line in output.splitlines()]
    assert [len(each) for each in parts] == [84, 84, 32]
    assert [each["servo_id"] for part in parts for each in part] == [*servos]
    assert (status, errors) == (0, f"{SPLIT.format(3)}\n")


def test_silence_after_a_part_keeps_what_had_come(monkeypatch: pytest.MonkeyPatch) -> None:
    line = VirtualLine(lambda _: [] if line.received[1:] else [(0.0, ServoPositions([(1, 500)]))])
    client = client_on(line, Controller, settle=None)
    monkeypatch.setattr(send, "open_client", lambda *_, **__: client)
    ids = f"servo_ids={','.join(map(str, range(1, 87)))}"
    status, output, errors = run("send", "--port", "COM7", "ServoPositionsRead", ids)
    assert status == 1
    assert output.count("ServoPositions positions=1:500 |") == 1
    first, incomplete, silent = errors.splitlines()
    assert first == SPLIT.format(2)
    assert incomplete.startswith("the reply is incomplete: nothing of servo_ids 2, 3, 4, ")
    assert "no ServoPositions came within" in silent


def test_a_question_too_large_for_one_reply_is_refused_where_it_cannot_be_split(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """As for a protocol whose question has more fields than its list."""
    monkeypatch.setattr(send, "in_parts", lambda *_: [ServoPositionsRead(range(85))])
    status, _, errors = run("send", "--port", "loop://", "ServoPositionsRead")
    problem = "85 items are requested at once, and a reply has room for 84\n"
    assert (status, errors.endswith(problem)) == (2, True)


def test_retries_ask_again() -> None:
    words = ("BatteryVoltageRead", "--retries", "2", "--timeout", "0.01")
    status, _, errors = run("send", "--port", "loop://", *words)
    warning, error = errors.split("\n", 1)
    assert (status, "loop:// gives back what is sent" in warning) == (1, True)
    assert error.startswith("no BatteryVoltage came within ")
    assert "to 3 requests of BatteryVoltageRead()" in error


# `stats` has no port: it is told the rate of a line that was recorded.
@in_turn("name", lambda: sorted({*PROGRAM.verbs} - {"simulate", "stats"}))
def test_a_verb_that_takes_a_port_takes_its_rate(name: str) -> None:
    parser = argparse.ArgumentParser()
    verb_named(name, PROGRAM).add_arguments(parser, PROGRAM)
    options = parser.format_help()
    assert ("--port" in options) == ("--baud" in options)


ADAPTER = SerialPortSeen("COM3", "1A86:7523", "USB Serial")
# What is foreign stays in its line.
OTHER = SerialPortSeen("/dev/cu.01", "10C4:EA60", "CP\n2102")
BUILT_IN = SerialPortSeen("COM1", "", "")
BOARD = HidDevice(0x0483, 0x5750, "1-1", "")
KEEP = "  busservo doctor --port PORT --save  keeps one in busservo.toml\n"
NO_USB = "no port is plugged in by USB; if it is one of these, name it:\n  --port COM1  not USB\n"
SEVERAL = (
    "2 ports are plugged in by USB; name the one that is meant:\n"
    "  --port COM3        USB Serial\n  --port /dev/cu.01  CP\\n2102\n"
)
NONE = (
    "no port is plugged in; plug in the device, or name a port: --port PORT, BUSSERVO_PORT=PORT, "
    "or `port` in busservo.toml; `busservo doctor` looks closer\n"
)

# Which port is taken, by the words, the environment, the ports and the devices there are; or what
# the error says.
PORTS: list[tuple[list[str], str, list[SerialPortSeen], list[HidDevice], str]] = [
    (["--port", "COM9"], "COM8", [ADAPTER], [], "COM9"),
    ([], "COM8", [ADAPTER], [], "COM8"),
    ([], "", [ADAPTER], [], "COM3"),
    ([], "", [BUILT_IN, ADAPTER], [], "COM3"),
    ([], "", [BUILT_IN], [], f"busservo: error: {NO_USB}{KEEP}"),
    ([], "", [BUILT_IN], [BOARD], "hid://"),
    ([], "", [ADAPTER], [BOARD], "COM3"),
    ([], "", [BUILT_IN, ADAPTER, OTHER], [], f"busservo: error: {SEVERAL}{KEEP}"),
    ([], "", [], [], f"busservo: error: {NONE}"),
]


def test_the_port_is_by_option_environment_or_the_only_one(monkeypatch: pytest.MonkeyPatch) -> None:
    opened, found = refused_port(monkeypatch), []
    for words, variable, ports, devices, _ in PORTS:
        monkeypatch.setenv("BUSSERVO_PORT", variable)
        monkeypatch.setattr(link, "serial_ports", lambda ports=ports: ports)
        monkeypatch.setattr(link, "hid_devices_at_hand", lambda _link, devices=devices: devices)
        status, _, errors = run("send", "ActionGroupStop", *words)
        assert status == 2
        found.append(opened.pop()[0] if opened else errors)
    assert found == [expected for *_, expected in PORTS]


USB0 = "/dev/ttyUSB0"


def plugged_in() -> list[ListPortInfo]:
    """Return an adapter, and a port that is built in."""
    adapter = ListPortInfo(USB0)
    adapter.vid, adapter.pid, adapter.description = 0x1A86, 0x7523, "USB Serial"
    return [adapter, ListPortInfo("/dev/ttyS0")]


LOBOT = HidDevice(0x0483, 0x5750, "/dev/hidraw1", "LOBOT")
NAMELESS = LOBOT._replace(path="/dev/hidraw2", product="")
ABOUT = "USB HID, no serial port (not seen on hardware yet)"
NO_PORT = "no serial port is plugged in\n"
UNLISTED = (
    "USB HID devices (0483:5750) have no serial port, and are not listed without "
    "hidapi: pip install hidapi\n"
)
# Of two boards of a kind, each has an address of its own.
IN_JSON = [
    {"port": USB0, "usb": "1A86:7523", "description": "USB Serial"},
    {"port": "hid:///dev/hidraw1", "usb": "0483:5750", "description": f"LOBOT, {ABOUT}"},
    {"port": "hid:///dev/hidraw2", "usb": "0483:5750", "description": ABOUT},
]
TWO_PORTS = "/dev/ttyS0        -\n/dev/ttyUSB0      1A86:7523  USB Serial\n"
TWO_BOARDS = "".join(f"{json.dumps(each)}\n" for each in IN_JSON)
# The ports and the devices that there are, the words, and what is printed.
LISTED: list[tuple[list[ListPortInfo], list[HidDevice] | None, str, str, str]] = [
    ([], [], "ports", "", NO_PORT),
    ([], None, "ports", "", f"{NO_PORT}{UNLISTED}"),
    ([], [LOBOT], "ports", f"hid://0483:5750   0483:5750  LOBOT, {ABOUT}\n", NO_PORT),
    (plugged_in(), [], "ports", TWO_PORTS, ""),
    (plugged_in()[:1], [LOBOT, NAMELESS], "ports --json", TWO_BOARDS, ""),
]


@in_turn("ports, devices, words, output, errors", lambda: LISTED, ids=lambda row: repr(row[2:]))
def test_ports_are_listed_and_boards_without_one(
    ports: list[ListPortInfo],
    devices: list[HidDevice] | None,
    words: str,
    output: str,
    errors: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: ports)
    monkeypatch.setattr("framewire.command.ports.hid_devices_at_hand", lambda _link: devices)
    assert run(*words.split()) == (0, output, errors)


def test_a_line_that_is_lost_in_the_middle_of_a_reply_has_a_status_of_its_own() -> None:
    with VirtualController("tcp", faults=Faults(hang_up=1.0)) as board:
        status, _, errors = run("send", "--port", board.port, "BatteryVoltageRead", *PATIENT)
    assert status == 3
    assert errors.startswith(f"busservo: error: {board.port}: the line was lost")
    assert errors.endswith("; check the cable and the power, then run this again\n")


def test_simulate_runs_the_simulator() -> None:
    status, shown, _ = run("simulate", "--help")
    assert (status, shown.partition("[")[0].strip()) == (0, "usage: busservo simulate")
    assert "busservo simulate --tcp 4000" in shown
    assert "busservo-simulator" not in shown


@in_turn(
    "package, said",
    lambda: [
        (None, "which answers as the specification says"),
        (SimpleNamespace(Board=VirtualDevice), "which answers as the specification says"),
        (SimpleNamespace(Board=Device), "Board is no virtual device: derive it from busservo."),
    ],
)
def test_without_a_simulator_of_its_own_it_runs_what_follows_from_the_specification(
    package: object, said: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "busservo_simulator", package)
    monkeypatch.setitem(sys.modules, "busservo_simulator.cli", None)
    status, shown, errors = run("simulate", "--help")
    assert (status, said in shown + errors) == (2 if errors else 0, True)


def test_a_missing_dependency_of_the_simulator_is_not_taken_for_the_simulator(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    for module in ("busservo_simulator.cli", "framewire.simulator.command"):
        monkeypatch.delitem(sys.modules, module, raising=False)
    monkeypatch.setitem(sys.modules, "signal", None)
    with pytest.raises(ModuleNotFoundError, match="signal"):
        simulate.hand_over([], PROGRAM)


# What imports less than this each time, one after another in one process.
WITHOUT_A_PORT = ["decode 55", "encode ActionGroupStop", "answer", "--help", "decode --help"]
BEFORE_A_PORT = [
    *(f"{verb} --help" for verb in ("monitor", "send", "bench-line", "replay", "doctor", "ports")),
    "doctor --port COM7 --baud x",
    f"{REPLAY} --dry-run --skip-noise --either send",
    "send --port COM7 ServoMov",
    "--version",
]


def test_nothing_is_imported_before_it_is_needed() -> None:
    assert imported(WITHOUT_A_PORT, "serial", "threading", "shtab") == []
    assert imported(BEFORE_A_PORT, "serial", "shtab") == []


def imported(commands: list[str], *names: str) -> list[tuple[str, list[str]]]:
    """Return the commands behind which some of these modules are imported, and which."""
    program = f"""if True:
        import sys
        sys.path[:] = {sys.path!r}
        from busservo.__main__ import main
        found = [(each, main(each.split()), {{*sys.modules}}) for each in {commands!r}]
        found = [(each, sorted(known & {{*{names!r}}})) for each, _, known in found]
        print([(each, some) for each, some in found if some])
    """
    done = ran(sys.executable, "-S", "-c", program, stdin=subprocess.DEVNULL)
    found: list[tuple[str, list[str]]] = ast.literal_eval(done.stdout.splitlines()[-1])
    return found


@in_turn("verb", lambda: sorted({*PROGRAM.verbs} - {"simulate"}))
def test_help_teaches_by_examples_that_work_and_names_every_exit_status(verb: str) -> None:
    status, shown, _ = run(verb, "--help")
    assert (status, "\nexamples:\n  busservo " in shown) == (0, True)
    assert all(example in shown for example, _ in PROGRAM.examples[verb])
    ends = re.findall(r"^  ([0-9]+) +[a-z]", shown.partition("\nexit status:\n")[2], re.MULTILINE)
    assert [int(end) for end in ends] == sorted({0, 2, 130, 141, *map(int, ends)})
    assert ("3" in ends) == ("--port" in shown)


EXAMPLES = [line for lines in PROGRAM.examples.values() for line, _ in lines]


@in_turn("line", lambda: [line for line in EXAMPLES if "--help" not in line])
def test_an_example_is_a_command_line(line: str) -> None:
    _, name, *words = shlex.split(line)
    verb = verb_named(name, PROGRAM)
    if name == "simulate":
        assert words == []
        return
    parser = argparse.ArgumentParser(exit_on_error=False)
    verb.add_arguments(parser, PROGRAM)
    given = parser.parse_intermixed_args(words)
    if "message" in given:
        library = PROGRAM.library
        assert given.message is None or in_parts(given.message, given.fields, library)[0].encode()
    if isinstance(verb, MethodVerb):
        assert all(each.encode() for each in verb.messages(given))


def test_ctrl_c_is_quiet_where_no_terminal_has_shown_it(monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(send, "open_client", interrupted)
    assert run("send", "--port", "loop://", "ActionGroupStop") == (130, "", "")


def test_a_verb_can_be_run_from_any_thread() -> None:
    """Signal are for the main thread alone, and SIGTERM is then left as it is."""
    before = signal.getsignal(signal.SIGTERM)
    with VirtualController("tcp") as board, ThreadPoolExecutor(1) as pool:
        words = ["send", "--port", board.port, "BatteryVoltageRead", *map(str, PATIENT)]
        assert pool.submit(main, words).result(GENEROUS) == 0
        assert board.accepted == 1
    assert signal.getsignal(signal.SIGTERM) is before
