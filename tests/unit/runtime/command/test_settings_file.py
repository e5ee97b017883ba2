"""The file of settings: where it is found, what it may hold, and what is saved in it."""

import json
import math
import re
import sys
from pathlib import Path
from typing import Any

import lxservo.__main__
import pytest
from busservo._command import PROGRAM
from busservo_simulator import VirtualController
from framewire.command import link, settings, teach
from framewire.command.settings_file import parsed
from framewire.command.settings_save import save
from framewire.command.usage_error import UsageError
from framewire.line.link_errors import PortNotFoundError

from tests.commands import run
from tests.factories import ROOT
from tests.timeouts import GENEROUS

FILE = "busservo.toml"
FAST = ("--timeout", GENEROUS, "--baud", "inf")


@pytest.fixture(autouse=True)
def user(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return the user's file, which is not there yet, and work in a folder without one."""
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path / "user"))
    monkeypatch.setenv("APPDATA", str(tmp_path / "user"))
    here = tmp_path / "here"
    here.mkdir()
    monkeypatch.chdir(here)
    return tmp_path / "user" / "busservo" / FILE


def test_the_file_of_the_guide_is_one() -> None:
    guide = (ROOT / "docs" / "command.md").read_text("utf-8")
    (text,) = re.findall(r"```toml\n(.*?)```", guide, re.DOTALL)
    found = parsed(Path(FILE), text.encode(), PROGRAM.library)
    assert (found.port, found.ids) == ("/dev/ttyUSB0", (1, 2, 3, 4, 5, 6))
    assert found.limits is not None
    assert found.limits.allowed == {1: (100, 900), 6: None}


def refused_port(monkeypatch: pytest.MonkeyPatch) -> list[tuple[str, float]]:
    """Have every port refused, and return what was opened."""
    opened: list[tuple[str, float]] = []

    def refuse(port: str, *_line: object, baud: float, **_: object) -> object:
        opened.append((port, baud))
        raise PortNotFoundError(port, "it is a test", "look elsewhere")

    monkeypatch.setattr(link, "open_port", refuse)
    monkeypatch.setattr(link, "serial_ports", list)
    monkeypatch.setattr(link, "hid_devices_at_hand", lambda _link: [])
    return opened


def error_of(*words: object, **how: Any) -> str:
    """Return the one line that a command ends with, for what it is given."""
    status, output, errors = run(*words, **how)
    assert (status, output) == (2, "")
    line, end, rest = errors.partition("\n")
    assert (end, rest) == ("\n", "")
    return line.partition(": error: ")[2]


# ------------------------------------------------------------------ what it may hold
NO_KEY = "there is no such key; there are port, baud, local_echo, ids, limits"
NO_PORT = 'is no name of a port, such as "COM7"'
NO_RATE = "is no rate: a whole number of baud, 1 or more, or inf"
NO_IDS = "is no list of numbers, such as [1, 2, 3]"
NO_PAIR = 'is no pair like [0, 1000], nor "none" for anything'
SINGLE = "with backslashes, text stands in single quotes: port = '\\\\.\\COM10'"
TOML, NO_NUMBER = "it is not TOML:", "is not a number, such as 1"
TWICE = "Cannot overwrite a value; a key stands there once"
QUOTES = 'text stands in quotes: port = "COM7"'
# What stands there, and what is said of it behind the name of the file.
BAD = [
    (b"prot = 'COM7'", ", line 1: prot: there is no such key; did you mean port?"),
    (b"# it\nspeed = 3", f", line 2: speed: {NO_KEY}"),
    (b"port = 7", f", line 1: port: 7 {NO_PORT}"),
    (b"port = ''", f', line 1: port: "" {NO_PORT}'),
    (b'port = "\\\\.\\COM10"', f", line 1, column 14: {TOML} Unescaped '\\' in a string; {SINGLE}"),
    (b"port = 'COM7'\nbaud = '9600'", f', line 2: baud: "9600" {NO_RATE}'),
    (b"baud = 0", f", line 1: baud: 0 {NO_RATE}"),
    (b"baud = -inf", f", line 1: baud: -inf {NO_RATE}"),
    (b"baud = true", f", line 1: baud: true {NO_RATE}"),
    (b"local_echo = 1", ", line 1: local_echo: 1 is neither true nor false"),
    (b"ids = 1", f", line 1: ids: 1 {NO_IDS}"),
    (b"ids = [1, true]", f", line 1: ids: [1, true] {NO_IDS}"),
    (b"ids = [1, 254]", ", line 1: ids: 254 is outside 1..253, which a servo has"),
    (b"ids = [2024-01-01]", f', line 1: ids: ["2024-01-01"] {NO_IDS}'),
    (b"limits = [900]", f", line 1: limits: [900] {NO_PAIR}"),
    (b"limits = [900, 100]", ", line 1: limits: [900, 100] has the higher value first"),
    (b"[limits]\n1 = [100, 900]\n2 = 'any'", f', line 3: limits.2: "any" {NO_PAIR}'),
    (b"[limits]\n1 = [1, 9]\n'2-3' = [1, 2]", f", line 3: limits.2-3: '2-3' {NO_NUMBER}"),
    (b"[limits]\n01 = [1, 2]", f", line 2: limits.01: '01' {NO_NUMBER}"),
    (b"[limits]\n256 = [1, 2]", ", line 2: limits.256: 256 is outside 0..255 of a servo"),
    (b"[arm]\nport = 'COM7'", f", line 1: arm: {NO_KEY}"),
    (b"port = 'COM7'\nport = 'COM8'\n", f", line 2, column 14: {TOML} {TWICE}"),
    (b"port = COM7", f", line 1, column 8: {TOML} Invalid value; {QUOTES}"),
    (b"port = 'COM7", f', at its end: {TOML} Expected "\'"'),
    (b"\n# caf\xe9", ", line 2: it is not UTF-8: save it as that"),
    ("port".encode("utf-16"), ", line 1: it is not UTF-8: save it as that"),
]


def test_a_file_that_is_wrong_anywhere_is_refused_with_the_place_and_the_way_out(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    opened = refused_port(monkeypatch)
    found = []
    for data, _ in BAD:
        Path(FILE).write_bytes(data)
        # Even where an option is given in its place: limits, too, stand in there.
        found.append((data, error_of("battery", "--port", "COM9").removeprefix(FILE)))
    assert found == BAD
    assert opened == []


def test_a_file_that_cannot_be_read_is_refused_and_none_is_needed_without_a_port() -> None:
    Path(FILE).mkdir()
    error = error_of("hold")
    assert error.startswith("busservo.toml cannot be read: ")
    assert error.endswith("; set that right, or move it away")
    assert run("encode", "BatteryVoltageRead").status == 0


def test_other_protocols_have_files_of_their_own(monkeypatch: pytest.MonkeyPatch) -> None:
    opened = refused_port(monkeypatch)
    main = lxservo.__main__.main
    Path(FILE).write_text("port = 'COM1'")
    Path("lxservo.toml").write_text("port = 'COM7'\nlocal_echo = false")
    assert run("read-position", "1", main=main).status == 2
    assert [port for port, _ in opened] == ["COM7"]
    bad = {
        "ids = [1]": "ids: nothing that is asked here takes a list of ids; remove it",
        "limits = [1, 2]": "limits: nothing that is sent here has limits; remove it",
    }
    for text, expected in bad.items():
        Path("lxservo.toml").write_text(text)
        assert error_of("read-position", "1", main=main) == f"lxservo.toml, line 1: {expected}"


# ------------------------------------------------------------------ what counts
def test_an_option_counts_before_the_variable_the_file_here_and_that_of_the_user(
    monkeypatch: pytest.MonkeyPatch, user: Path
) -> None:
    opened = refused_port(monkeypatch)
    user.parent.mkdir(parents=True)
    user.write_bytes(b"\xef\xbb\xbfport = 'user'\r\nbaud = 4800\r\n")
    said = "it is a test; look elsewhere (the port is named by busservo.toml in"
    assert error_of("battery") == f"user: {said} the user's folder)"
    Path(FILE).write_text("port = 'here'\nbaud = inf")
    assert error_of("battery") == f"here: {said} this folder)"
    Path(FILE).write_text("baud = 57600")
    # The other file is not read besides: no port is named.
    assert "or `port` in busservo.toml" in error_of("battery")
    monkeypatch.setenv("BUSSERVO_PORT", "variable")
    run("battery")
    run("battery", "--port", "option", "--baud", "1200")
    assert opened == [("user", 4800), ("here", math.inf), ("variable", 57600), ("option", 1200)]


def test_the_folder_of_the_user_is_that_of_the_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "home", lambda: Path("home"))
    monkeypatch.setenv("XDG_CONFIG_HOME", "not absolute")
    monkeypatch.delenv("APPDATA")
    mac, windows = "Library/Application Support", "AppData/Roaming"
    for system, folder in {"linux": ".config", "darwin": mac, "win32": windows}.items():
        monkeypatch.setattr(sys, "platform", system)
        assert settings.user_file(PROGRAM) == Path("home", folder, "busservo", FILE)


def test_each_servo_has_its_limits_wherever_limits_hold(board: VirtualController) -> None:
    Path(FILE).write_text(f"port = '{board.port}'\n[limits]\n1 = [100, 400]\n2 = 'none'\n")
    poses = {"format": "busservo poses", "version": 1, "poses": [{"positions": {"1": 90}}]}
    Path("wave.json").write_text(json.dumps(poses))
    of_1 = "is outside the limits 100..400 of servo 1 in busservo.toml; "
    of_3 = "is outside the limits 0..1000 of servo 3; "
    other = "--limits 500..2500 is for PWM servo boards, "
    usual, anything = "--limits 0..1000 is for what is usual, ", "--limits none sends anything"
    for words, expected in {
        "move 1:450": f"targets[0].position: 450 {of_1}{usual}{anything}",
        "send ServoMove time_ms=1 targets=2:3000,1:500": (
            f"targets[1].position: 500 {of_1}{usual}{other}{anything}"
        ),
        "move 2:2000 3:1100": f"targets[1].position: 1100 {of_3}{other}{anything}",
        "play wave.json": f"wave.json: poses[0].positions.1: 90 {of_1}{usual}{anything}",
    }.items():
        assert error_of(*words.split(), *FAST) == expected
    held = "servos 2, 3 held\nservo 1 not held: 500 is outside the limits 100..400\n"
    assert run("hold", *FAST) == (1, "", held)
    for words in ("move 2:3000", "move 1:450 --limits 0..1000"):
        assert run(*words.split(), "--in", "1ms", "--no-wait", *FAST).status == 0
    Path(FILE).write_text(f"port = '{board.port}'\nlimits = [600, 700]")
    assert "the limits 600..700 in busservo.toml; " in error_of("move", "1:500", *FAST)


def test_the_ids_of_the_file_are_meant_where_none_are_named(
    board: VirtualController, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path(FILE).write_text(f"port = '{board.port}'\nids = [1, 3, 9, 3]")
    for verb in ("hold", "stop"):
        assert run(verb, *FAST) == (1, "", "servos 1, 3 held\nservo 9 not held: no answer\n")
    assert run("hold", "2", *FAST) == (0, "", "servo 2 held\n")
    status, output, errors = run("positions", *FAST)
    assert (status, "positions=1:500,3:500" in output, "servo_ids 9" in errors) == (1, True, True)
    Path(FILE).write_text(f"port = '{board.port}'\nids = [1, 3]\nlimits = [600, 700]")
    lines = iter(["", "q", "n"])
    monkeypatch.setattr(teach, "_line", lambda _prompt: next(lines))
    status, _, errors = run("teach", "new.json", "--yes", *FAST)
    assert status == 1
    assert "500 is outside the limits 600..700 in busservo.toml; " in errors
    assert "0 poses recorded; servos 1, 3 are limp\n" in errors


# ------------------------------------------------------------------ what is saved
PORT: dict[str, Any] = {"port": "/dev/ttyUSB0"}
GRIP = "\r\n\r\n[limits]\r\n# grip\r\n1 = [100, 900]"
# What stood there, what is saved, and what stands there then.
SAVED: list[tuple[str, dict[str, Any], str]] = [
    ("", PORT | {"baud": math.inf}, 'port = "/dev/ttyUSB0"\nbaud = inf\n'),
    (
        f"# mine\r\nport = 'COM7'  # left{GRIP}",
        PORT | {"ids": [1, 2]},
        f'# mine\r\nport = "/dev/ttyUSB0"  # left\r\nids = [1, 2]{GRIP}',
    ),
    (
        "# grip\n[limits]\n1 = [100, 900]\n",
        PORT,
        'port = "/dev/ttyUSB0"\n\n# grip\n[limits]\n1 = [100, 900]\n',
    ),
    (
        "ids = [\n  1,\n  2,\n]\n'port'='a'\nlimits = 'none'",
        PORT | {"ids": [3], "local_echo": True},
        "ids = [3]\n'port'=\"/dev/ttyUSB0\"\nlimits = 'none'\nlocal_echo = true\n",
    ),
    ("\ufeffbaud = 1", {"baud": 9600}, "\ufeffbaud = 9600"),
    ("", {"port": '\\\\.\\COM10 "é😀"'}, 'port = "\\\\\\\\.\\\\COM10 \\"é😀\\""\n'),
]
# What stands there cannot be changed by itself, or is no text that can be saved.
KEPT: list[tuple[str, dict[str, Any]]] = [
    ("ids = [\n  1,  # left\n]", {"ids": [2]}),
    ("port = '''\na'''", PORT),
    ("", {"port": "/dev/\udcff"}),
    ("", {"port": "\x7f"}),
]


def test_what_is_saved_changes_its_own_lines_and_nothing_else() -> None:
    path = Path(FILE)
    found = []
    for before, values, _ in SAVED:
        path.write_bytes(before.encode())
        save(path, values, PROGRAM)
        found.append((before, values, path.read_bytes().decode()))
    assert found == SAVED
    for text, values in KEPT:
        path.write_bytes(text.encode())
        with pytest.raises(UsageError, match="nothing saved") as caught:
            save(path, values, PROGRAM)
        assert path.read_bytes() == text.encode()
        assert len(caught.value.choices) == 1
    assert [*Path().iterdir()] == [path]


def test_doctor_saves_what_it_finds_unless_a_check_fails(
    board: VirtualController, user: Path
) -> None:
    status, _, errors = run("doctor", "--port", "no-such-port", "--save")
    assert (status, errors.splitlines()[-1]) == (1, "nothing saved: a check has failed")
    assert not user.exists()
    status, _, errors = run("doctor", "--port", board.port, "--save", *FAST)
    expected = f'port = "{board.port}"\nbaud = inf\nids = [1, 2, 3]\n'
    assert (status, user.read_text()) == (0, expected)
    assert errors.endswith(f"saved in {user}: {', '.join(expected.splitlines())}\n")
    # In this folder, if the file is there.
    Path(FILE).write_text(f"# arm\nport = '{board.port}'\nids = [9]\n")
    status, output, _ = run("doctor", "--save", "--timeout", GENEROUS)
    assert status == 0
    assert output.split("\n")[0].endswith("; named by busservo.toml in this folder")
    assert Path(FILE).read_text() == f'# arm\nport = "{board.port}"\nids = [1, 2, 3]\n'
    assert user.read_text() == expected
