"""The file of settings: where it is found, what it may hold, and what is saved in it."""

from __future__ import annotations

import json
import math
import re
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import busservo.__main__
import lxservo.__main__
import pytest
from busservo._command import PROGRAM
from framewire.command import link, settings, teach
from framewire.command import link as servo_link
from framewire.command.settings_file import parsed
from framewire.command.settings_save import save
from framewire.command.usage_error import UsageError
from framewire.line.link_errors import PortNotFoundError

from tests.factories import ROOT
from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from busservo_simulator import VirtualController

Capture = pytest.CaptureFixture[str]

FILE = "busservo.toml"
FAST = ("--timeout", str(GENEROUS), "--baud", "inf")


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


def refused_port(monkeypatch: pytest.MonkeyPatch, module: Any = link) -> list[tuple[str, float]]:
    """Have every port refused, and return what was opened."""
    opened: list[tuple[str, float]] = []

    def refuse(port: str, *_line: object, baud: float, **_: object) -> object:
        opened.append((port, baud))
        raise PortNotFoundError(port, "it is a test", "look elsewhere")

    monkeypatch.setattr(module, "open_port", refuse)
    monkeypatch.setattr(module, "serial_ports", list)
    monkeypatch.setattr(module, "hid_devices_at_hand", lambda _link: [])
    return opened


def error_of(capsys: Capture, words: list[str], main: Any = None) -> str:
    """Return the one line that a command ends with, for what it is given."""
    assert (main or busservo.__main__.main)(words) == 2
    output, errors = capsys.readouterr()
    assert output == ""
    line, end, rest = errors.partition("\n")
    assert (end, rest) == ("\n", "")
    return line.partition(": error: ")[2]


# ------------------------------------------------------------------ what it may hold

# What stands there, and what is said of it behind the name of the file.
BAD = [
    (b"prot = 'COM7'", ", line 1: prot: there is no such key; did you mean port?"),
    (
        b"# it\nspeed = 3",
        ", line 2: speed: there is no such key; there are port, baud, local_echo, ids, limits",
    ),
    (b"port = 7", ', line 1: port: 7 is no name of a port, such as "COM7"'),
    (b"port = ''", ', line 1: port: "" is no name of a port, such as "COM7"'),
    (
        b'port = "\\\\.\\COM10"',
        (
            ", line 1, column 14: it is not TOML: Unescaped '\\' in a string; with backslashes, "
            "text stands in single quotes: port = '\\\\.\\COM10'"
        ),
    ),
    (
        b"port = 'COM7'\nbaud = '9600'",
        ', line 2: baud: "9600" is no rate: a whole number of baud, 1 or more, or inf',
    ),
    (
        b"baud = 0",
        ", line 1: baud: 0 is no rate: a whole number of baud, 1 or more, or inf",
    ),
    (
        b"baud = -inf",
        ", line 1: baud: -inf is no rate: a whole number of baud, 1 or more, or inf",
    ),
    (
        b"baud = true",
        ", line 1: baud: true is no rate: a whole number of baud, 1 or more, or inf",
    ),
    (b"local_echo = 1", ", line 1: local_echo: 1 is neither true nor false"),
    (b"ids = 1", ", line 1: ids: 1 is no list of numbers, such as [1, 2, 3]"),
    (
        b"ids = [1, true]",
        ", line 1: ids: [1, true] is no list of numbers, such as [1, 2, 3]",
    ),
    (b"ids = [1, 254]", ", line 1: ids: 254 is outside 1..253, which a servo has"),
    (
        b"ids = [2024-01-01]",
        ', line 1: ids: ["2024-01-01"] is no list of numbers, such as [1, 2, 3]',
    ),
    (
        b"limits = [900]",
        ', line 1: limits: [900] is no pair like [0, 1000], nor "none" for anything',
    ),
    (
        b"limits = [900, 100]",
        ", line 1: limits: [900, 100] has the higher value first",
    ),
    (
        b"[limits]\n1 = [100, 900]\n2 = 'any'",
        ', line 3: limits.2: "any" is no pair like [0, 1000], nor "none" for anything',
    ),
    (
        b"[limits]\n1 = [100, 900]\n'2-3' = [1, 2]",
        ", line 3: limits.2-3: '2-3' is not a number, such as 1",
    ),
    (b"[limits]\n01 = [1, 2]", ", line 2: limits.01: '01' is not a number, such as 1"),
    (
        b"[limits]\n256 = [1, 2]",
        ", line 2: limits.256: 256 is outside 0..255 of a servo",
    ),
    (
        b"[arm]\nport = 'COM7'",
        ", line 1: arm: there is no such key; there are port, baud, local_echo, ids, limits",
    ),
    (
        b"port = 'COM7'\nport = 'COM8'\n",
        ", line 2, column 14: it is not TOML: Cannot overwrite a value; a key stands there once",
    ),
    (
        b"port = COM7",
        ', line 1, column 8: it is not TOML: Invalid value; text stands in quotes: port = "COM7"',
    ),
    (b"port = 'COM7", ', at its end: it is not TOML: Expected "\'"'),
    (b"\n# caf\xe9", ", line 2: it is not UTF-8: save it as that"),
    ("port".encode("utf-16"), ", line 1: it is not UTF-8: save it as that"),
]


def test_a_file_that_is_wrong_anywhere_is_refused_with_the_place_and_the_way_out(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    opened = refused_port(monkeypatch)
    found = []
    for data, _ in BAD:
        Path(FILE).write_bytes(data)
        # Even where an option is given in its place: limits, too, stand in there.
        error = error_of(capsys, ["battery", "--port", "COM9"])
        found.append((data, error.removeprefix(FILE)))
    assert found == BAD
    assert opened == []


def test_a_file_that_cannot_be_read_is_refused_and_none_is_needed_without_a_port(
    capsys: Capture,
) -> None:
    Path(FILE).mkdir()
    error = error_of(capsys, ["hold"])
    assert error.startswith("busservo.toml cannot be read: ")
    assert error.endswith("; set that right, or move it away")
    assert busservo.__main__.main(["encode", "BatteryVoltageRead"]) == 0


def test_other_protocols_have_files_of_their_own(
    monkeypatch: pytest.MonkeyPatch, capsys: Capture
) -> None:
    opened = refused_port(monkeypatch, servo_link)
    main = lxservo.__main__.main
    Path(FILE).write_text("port = 'COM1'")
    Path("lxservo.toml").write_text("port = 'COM7'\nlocal_echo = false")
    assert main(["read-position", "1"]) == 2
    assert [port for port, _ in opened] == ["COM7"]
    capsys.readouterr()
    bad = {
        "ids = [1]": "ids: nothing that is asked here takes a list of ids; remove it",
        "limits = [1, 2]": "limits: nothing that is sent here has limits; remove it",
    }
    for text, expected in bad.items():
        Path("lxservo.toml").write_text(text)
        error = error_of(capsys, ["read-position", "1"], main)
        assert error == f"lxservo.toml, line 1: {expected}"


# ------------------------------------------------------------------ what counts


def test_an_option_counts_before_the_variable_the_file_here_and_that_of_the_user(
    monkeypatch: pytest.MonkeyPatch, user: Path, capsys: Capture
) -> None:
    opened = refused_port(monkeypatch)
    user.parent.mkdir(parents=True)

    def tried(*words: str) -> None:
        busservo.__main__.main(["battery", *words])

    user.write_bytes(b"\xef\xbb\xbfport = 'user'\r\nbaud = 4800\r\n")
    tried()
    Path(FILE).write_text("port = 'here'\nbaud = inf")
    tried()
    Path(FILE).write_text("baud = 57600")
    assert capsys.readouterr().err == "".join(
        f"busservo: error: {port}: it is a test; look elsewhere (the port is named by {name})\n"
        for port, name in {
            "user": "busservo.toml in the user's folder",
            "here": "busservo.toml in this folder",
        }.items()
    )
    tried()  # the other file is not read besides: no port is named
    assert "or `port` in busservo.toml" in capsys.readouterr().err
    monkeypatch.setenv("BUSSERVO_PORT", "variable")
    tried()
    tried("--port", "option", "--baud", "1200")
    assert opened == [
        ("user", 4800),
        ("here", math.inf),
        ("variable", 57600),
        ("option", 1200),
    ]


def test_the_folder_of_the_user_is_that_of_the_system(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Path, "home", lambda: Path("home"))
    monkeypatch.setenv("XDG_CONFIG_HOME", "not absolute")
    monkeypatch.delenv("APPDATA")
    found = []
    for system in ("linux", "darwin", "win32"):
        monkeypatch.setattr(sys, "platform", system)
        path = settings.user_file(PROGRAM)
        assert path is not None
        found.append(path.as_posix())
    assert found == [
        "home/.config/busservo/busservo.toml",
        "home/Library/Application Support/busservo/busservo.toml",
        "home/AppData/Roaming/busservo/busservo.toml",
    ]


def test_each_servo_has_its_limits_wherever_limits_hold(
    board: VirtualController, capsys: Capture
) -> None:
    Path(FILE).write_text(
        f"port = '{board.port}'\n[limits]\n1 = [100, 400]\n2 = 'none'\n", encoding="utf-8"
    )
    poses = {"format": "busservo poses", "version": 1, "poses": [{"positions": {"1": 90}}]}
    Path("wave.json").write_text(json.dumps(poses))
    of_1 = "is outside the limits 100..400 of servo 1 in busservo.toml; "
    other = "--limits 500..2500 is for PWM servo boards, "
    usual, anything = "--limits 0..1000 is for what is usual, ", "--limits none sends anything"
    for words, expected in {
        "move 1:450": f"targets[0].position: 450 {of_1}{usual}{anything}",
        "send ServoMove time_ms=1 targets=2:3000,1:500": (
            f"targets[1].position: 500 {of_1}{usual}{other}{anything}"
        ),
        "move 2:2000 3:1100": (
            f"targets[1].position: 1100 is outside the limits 0..1000 of servo 3; {other}{anything}"
        ),
        "play wave.json": f"wave.json: poses[0].positions.1: 90 {of_1}{usual}{anything}",
    }.items():
        assert error_of(capsys, [*words.split(), *FAST]) == expected
    assert busservo.__main__.main(["hold", *FAST]) == 1
    assert capsys.readouterr().err == (
        "servos 2, 3 held\nservo 1 not held: 500 is outside the limits 100..400\n"
    )
    for words in ("move 2:3000", "move 1:450 --limits 0..1000"):
        assert busservo.__main__.main([*words.split(), "--in", "1ms", "--no-wait", *FAST]) == 0
    Path(FILE).write_text(f"port = '{board.port}'\nlimits = [600, 700]")
    assert "the limits 600..700 in busservo.toml; " in error_of(capsys, ["move", "1:500", *FAST])


def test_the_ids_of_the_file_are_meant_where_none_are_named(
    board: VirtualController, capsys: Capture, monkeypatch: pytest.MonkeyPatch
) -> None:
    Path(FILE).write_text(f"port = '{board.port}'\nids = [1, 3, 9, 3]")
    held = ["servos 1, 3 held", "servo 9 not held: no answer"]
    for verb in ("hold", "stop"):
        assert busservo.__main__.main([verb, *FAST]) == 1
        assert capsys.readouterr().err.splitlines() == held
    assert busservo.__main__.main(["hold", "2", *FAST]) == 0
    assert capsys.readouterr().err == "servo 2 held\n"
    assert busservo.__main__.main(["positions", *FAST]) == 1
    output, errors = capsys.readouterr()
    assert "positions=1:500,3:500" in output
    assert "servo_ids 9" in errors
    Path(FILE).write_text(f"port = '{board.port}'\nids = [1, 3]\nlimits = [600, 700]")
    lines = iter(["", "q", "n"])
    monkeypatch.setattr(teach, "_line", lambda _prompt: next(lines))
    assert busservo.__main__.main(["teach", "new.json", "--yes", *FAST]) == 1
    errors = capsys.readouterr().err
    assert "500 is outside the limits 600..700 in busservo.toml; " in errors
    assert "0 poses recorded; servos 1, 3 are limp\n" in errors


# ------------------------------------------------------------------ what is saved

PORT: dict[str, Any] = {"port": "/dev/ttyUSB0"}
# What stood there, what is saved, and what stands there then.
SAVED: list[tuple[str, dict[str, Any], str]] = [
    ("", PORT | {"baud": math.inf}, 'port = "/dev/ttyUSB0"\nbaud = inf\n'),
    (
        "# mine\r\nport = 'COM7'  # left\r\n\r\n[limits]\r\n# grip\r\n1 = [100, 900]",
        PORT | {"ids": [1, 2]},
        (
            '# mine\r\nport = "/dev/ttyUSB0"  # left\r\nids = [1, 2]\r\n\r\n[limits]\r\n# grip\r\n'
            "1 = [100, 900]"
        ),
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


def test_doctor_saves_what_it_has_found_unless_a_check_fails(
    board: VirtualController, user: Path, capsys: Capture
) -> None:
    patient = ("--timeout", str(GENEROUS))
    assert busservo.__main__.main(["doctor", "--port", "no-such-port", "--save"]) == 1
    assert capsys.readouterr().err.endswith("nothing saved: a check has failed\n")
    assert not user.exists()
    words = ["doctor", "--port", board.port, "--baud", "inf", "--save", *patient]
    assert busservo.__main__.main(words) == 0
    expected = f'port = "{board.port}"\nbaud = inf\nids = [1, 2, 3]\n'
    assert user.read_text() == expected
    said = f"saved in {user}: {expected.strip()}".replace("\n", ", ")
    assert capsys.readouterr().err.endswith(f"{said}\n")
    # In this folder, if the file is there.
    Path(FILE).write_text(f"# arm\nport = '{board.port}'\nids = [9]\n")
    assert busservo.__main__.main(["doctor", "--save", *patient]) == 0
    assert (
        capsys.readouterr().out.splitlines()[0].endswith("; named by busservo.toml in this folder")
    )
    assert Path(FILE).read_text() == f'# arm\nport = "{board.port}"\nids = [1, 2, 3]\n'
    assert user.read_text() == expected
