"""The standard streams of commands, and text that would control a terminal."""

import io
import json
import os
import subprocess
import sys
import unicodedata
from collections.abc import Iterator, Sequence
from functools import partial
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple, TypeAlias

import busservo.__main__
import busservo_simulator.cli
import framegen.cli
import pytest
from framegen.reading.text import first_invisible
from framewire.command import console
from framewire.command.console import Screen, visible
from hypothesis import example, given
from hypothesis import strategies as st
from serial.tools.list_ports_common import ListPortInfo

from tests.documents import ROOT
from tests.in_turn import in_turn
from tests.programs import ran
from tests.rows import Rows
from tests.timeouts import GENEROUS

Capture: TypeAlias = pytest.CaptureFixture[str]

not_windows = pytest.mark.skipif(sys.platform == "win32", reason="its streams close otherwise")
SPEC = str(ROOT / "spec" / "busservo.yaml")
FULL = Path("/dev/full")

# -- One and the same, whatever the environment and the streams ------------------------------------


class Command(NamedTuple):
    """A command line that prints something, and its error stream when all is well."""

    line: str
    errors: str = ""
    stdin: str = ""

    @property
    def program(self) -> str:
        return self.line.split()[1].replace("_", "-")


COMMANDS = [
    Command("-m busservo --version"),
    Command("-m busservo decode", "4 bytes: 1 message, 0 bytes of noise\n", "55 55 02 07"),
    Command("-m busservo encode --raw ActionGroupStop"),
    Command("-m busservo answer", stdin="encode ActionGroupStop\n"),
    Command("-m framegen --help"),
    Command("-m busservo_simulator --help"),
]
# It ends by itself only where nobody can be given the name of its port.
SIMULATOR = Command("-m busservo_simulator --tcp")


def each(*typical: int, also: Sequence[Command] = ()) -> pytest.MarkDecorator:
    """Try commands; tests/world has those that go the same ways."""
    others = [command for at, command in enumerate(COMMANDS) if at not in typical]
    rows = Rows([*(COMMANDS[at] for at in typical), *also], others)
    return pytest.mark.parametrize("command", rows, ids=attrgetter("line"))


# One of each program, and of each way to read and write.
EACH, TWO = (1, 3, 4), (1, 4)
EXAMPLE = Command("examples/virtual_arm.py")


def environments() -> list[dict[str, str]]:
    """Return environments with and without buffers and cached bytecode."""
    path = os.pathsep.join(filter(None, sys.path))
    switches = ("PYTHONUNBUFFERED", "PYTHONDONTWRITEBYTECODE", "PYTHONPYCACHEPREFIX")
    plain = {name: value for name, value in os.environ.items() if name not in switches}
    plain |= {"PYTHONPATH": path, "LC_ALL": "C.UTF-8", "COLUMNS": "80"}
    return [plain, plain | {"PYTHONUNBUFFERED": "1", "PYTHONDONTWRITEBYTECODE": "1"}]


def run(
    command: Command,
    closed: tuple[int, ...] = (),
    stdout: int = subprocess.DEVNULL,
    *,
    is_written: bool = True,
) -> tuple[int, str]:
    """Run a command in each environment; return status and errors, which must be the same.

    Whether Python buffers is all the same where nothing happens to what `is_written`.
    """
    started = [
        subprocess.Popen(
            [sys.executable, *command.line.split()],
            cwd=ROOT,
            env=environment,
            stdin=subprocess.PIPE,
            stdout=stdout,
            stderr=subprocess.PIPE,
            text=True,
            preexec_fn=partial(close_all, closed) if closed else None,  # noqa: PLW1509
        )
        for environment in environments()[: 2 if is_written else 1]
    ]
    done = []
    for process in started:
        _, errors = process.communicate(command.stdin, timeout=GENEROUS)
        done.append((process.returncode, errors))
    assert done[0] == done[-1]
    return done[0]


def close_all(streams: tuple[int, ...]) -> None:
    for stream in streams:
        os.close(stream)


@each(*EACH, also=[EXAMPLE])
def test_each_command_succeeds_with_open_streams(command: Command) -> None:
    assert run(command, is_written=False) == (0, command.errors)


@not_windows
@each(*TWO, also=[SIMULATOR])
def test_the_reader_has_gone(command: Command) -> None:
    ours, theirs = os.pipe()
    os.close(ours)
    try:
        assert run(command, stdout=theirs) == (141, "")
    finally:
        os.close(theirs)


@pytest.mark.skipif(not FULL.exists(), reason="needs a device that is always full")
@each(*TWO, also=[SIMULATOR])
def test_the_disk_is_full(command: Command) -> None:
    problem = "the output cannot be written: No space left on device"
    with FULL.open("wb") as full:
        assert run(command, stdout=full.fileno()) == (2, f"{command.program}: error: {problem}\n")


@not_windows
@each(*TWO, also=[SIMULATOR])
def test_the_output_is_closed(command: Command) -> None:
    errors = f"{command.program}: error: the output cannot be written: it is closed\n"
    assert run(command, closed=(1,)) == (2, errors)


@not_windows
@each(*TWO)
def test_the_error_stream_is_closed(command: Command) -> None:
    assert run(command, closed=(2,), is_written=False) == (0, "")


@not_windows
@each(*EACH)
def test_the_input_is_closed(command: Command) -> None:
    closed = (2, "busservo: error: standard input cannot be read: it is closed\n")
    expected = closed if command.stdin else (0, command.errors)
    assert run(command._replace(stdin=""), (0,), is_written=False) == expected


@not_windows
def test_no_port_gets_the_number_of_a_stream_that_is_closed() -> None:
    program = (
        "import os, sys; from framewire.command.console import run;"
        "sys.exit(run('it', lambda: os.open(os.devnull, os.O_RDONLY)))"
    )
    close = partial(close_all, (0, 1, 2))
    assert ran(sys.executable, "-c", program, status=3, capture_output=False, preexec_fn=close)


# -- Text of strangers -----------------------------------------------------------------------------

# It clears the screen, colours what follows, turns the writing round, and forges a line of
# its own; at its end are a byte that is no text and a bell.
HOSTILE = "\x1b[2J\x9b31m\u202eevil\nbusservo: all is well\udcff\x07"
# Calls with it in the place of @, by program.
BUSSERVO = """
@ | --@ | --print-completion @ | decode @ | decode --file @ | decode --direction @ | docs @
decode --format @ | explain 55 --direction @ | encode @ | encode BatteryVoltage @
encode BatteryVoltage @=1 | encode BatteryVoltage voltage_mv=@ | explain @
encode ServoMove time_ms=1 targets=@
monitor --port @ | monitor --port socket://@:1 | monitor --port hwgrep://@ | monitor --port @://
monitor --port spy://loop://?file=@ | monitor --port loop:// --baud @ | monitor --port loop:// -n @
monitor --port loop:// --only @ | monitor --port loop:// --log @/log | send --port loop:// @
send --port @ BatteryVoltageRead | send --port loop:// BatteryVoltageRead --timeout @
replay @ --dry-run | replay hostile --dry-run | replay log.hex --port @ | ports @
replay log.hex --dry-run --speed @ | bench-line --port @ | bench-line --port loop:// @
doctor --port @ | doctor --port @ --json | doctor --report @/report | teach pose.json --port @
teach @/pose.json --port loop:// | teach hostile --port loop:// | play @ --dry-run
teach pose.json --port loop:// --ids @ | play hostile --dry-run | play pose.json --dry-run
play pose.json --dry-run --pause @
"""
SIMULATE = """
@ | --link @/link | --tcp @ | --tcp 99999 | --tcp --host @ | --tcp --host \0 | --servos @
--battery @ | --fault @ | --fault noise=@
"""
FRAMEGEN = """
@ | --@ | check @ | check @.yaml | check --json @.yaml | check escaped.yaml | check raw.yaml
check --json escaped.yaml | generate @.yaml | generate SPEC --out log.hex | docs @.yaml | diff @
diff @.yaml SPEC | diff SPEC @:@ | diff --fail-on @ | release @.yaml | explain @ | rules @
explain @.yaml 55 | explain SPEC 55 --direction @ | schema @
"""
MAINS = {
    "busservo": busservo.__main__.main,
    "framegen": framegen.cli.main,
    "busservo-simulator": busservo_simulator.cli.main,
}


def calls() -> Iterator[tuple[str, list[str]]]:
    """Yield the program and the words of each call."""
    of_simulator = [f"simulate {each}" for each in listed(SIMULATE)]
    for program, lines in {
        "busservo": [*listed(BUSSERVO), *of_simulator],
        "framegen": listed(FRAMEGEN),
        "busservo-simulator": listed(SIMULATE),
    }.items():
        for line in lines:
            yield (
                program,
                [word.replace("@", HOSTILE).replace("SPEC", SPEC) for word in line.split(" ")],
            )


def listed(lines: str) -> list[str]:
    return [each for line in lines.strip("\n").split("\n") for each in line.split(" | ")]


@pytest.fixture
def _hostile_files(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    log = "55 55 02 07  # 0.0 s, host: a\n"
    (tmp_path / "log.hex").write_text(log, encoding="utf-8")
    (tmp_path / "hostile").write_text(f"{log}zz # 0.1 s, \x1b[2J\x9b: b\n", encoding="utf-8")
    pose = json.dumps({HOSTILE: [{HOSTILE: HOSTILE}], "poses": [{HOSTILE: 1}]})
    (tmp_path / "pose.json").write_text(pose, encoding="utf-8")
    spec = (ROOT / "spec" / "busservo.yaml").read_text(encoding="utf-8")
    for name, value in {
        f"{HOSTILE}.yaml": "v16",
        "raw.yaml": '"v16\x1b[2J"',
        "escaped.yaml": r'"v16\e[2J\x9b31m\u202e\n"',
    }.items():
        text = spec.replace("type: u16", f"type: {value}", 1)
        try:
            (tmp_path / name).write_text(text, encoding="utf-8")
        except OSError:  # a file cannot have this name here, and is not found
            assert sys.platform in ("win32", "darwin")


@pytest.mark.usefixtures("_hostile_files")
@in_turn("program, words", calls, ids=ascii)
def test_a_hostile_call_is_refused_visibly(capsys: Capture, program: str, words: list[str]) -> None:
    assert MAINS[program](words) in (1, 2)
    output, errors = capsys.readouterr()
    assert hidden_in(output) == hidden_in(errors) == ""
    assert "Traceback" not in errors
    assert "\nbusservo: all is well" not in output + errors
    assert errors


def hidden_in(text: str) -> str:
    """Return the characters that a terminal would obey or not show."""
    return "".join(c for c in text if c != "\n" and unicodedata.category(c) in ("Cc", "Cf", "Cs"))


@pytest.mark.parametrize("form", [[], ["--json"]])
def test_a_device_cannot_command_the_terminal(
    capsys: Capture, monkeypatch: pytest.MonkeyPatch, form: list[str]
) -> None:
    port = ListPortInfo("/dev/ttyUSB0")
    port.description = HOSTILE
    monkeypatch.setattr("serial.tools.list_ports.comports", lambda: [port])
    assert busservo.__main__.main(["ports", *form]) == 0
    output, _ = capsys.readouterr()
    assert hidden_in(output) == ""
    assert output.count("\n") == 1
    assert r"\x1b[2J" in output or r"\u001b[2J" in output


@example(HOSTILE)
@given(st.text())
def test_visible_text_is_one_line_that_hides_nothing(text: str) -> None:
    seen = visible(text)
    assert first_invisible(seen) is None
    assert "\n" not in seen
    if not first_invisible(text) and "\n" not in text:
        assert seen == text


@example(HOSTILE)
@given(st.text())
def test_a_screen_shows_what_is_hidden_and_keeps_the_lines(text: str) -> None:
    behind = io.StringIO(newline="")
    screen = Screen(behind)
    assert screen.write(text) == len(text)
    lines = [[visible(part) for part in line.split("\t")] for line in text.split("\n")]
    assert behind.getvalue() == "\n".join("\t".join(parts) for parts in lines)


def test_a_screen_of_few_characters_shows_the_others_as_escapes() -> None:
    behind = io.TextIOWrapper(io.BytesIO(), encoding="ascii", errors="strict")
    print("25 °C → 298 K", file=Screen(behind), flush=True)
    assert behind.buffer.getvalue() == rb"25 \xb0C \u2192 298 K" + os.linesep.encode()


def test_an_output_that_failed_once_keeps_failing() -> None:
    class Full(io.StringIO):
        def write(self, _text: str, /) -> int:
            raise OSError(28, "it is full")

    screen = Screen(Full())
    for _ in range(2):
        with pytest.raises(OSError, match="it is full"):
            screen.write("text")
    # A stream that is not vital loses what it cannot take.
    assert Screen(Full(), vital=False).write("text") == 4


def test_a_colour_of_our_own_passes() -> None:
    behind = io.StringIO()
    console.write_as_it_is(Screen(behind), "\x1b[31mred\x1b[0m")
    console.write_as_it_is(behind, "\r")
    assert behind.getvalue() == "\x1b[31mred\x1b[0m\r"
