"""The commands of simulators: what they print, what they refuse, and how they end."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from argparse import ArgumentTypeError
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import pytest
from busservo import BatteryVoltage, ServoPositions, ServoPositionsRead, open_transport
from busservo_simulator import Faults
from busservo_simulator.cli import SIMULATOR
from busservo_simulator.faults import CHANCES, DURATIONS
from framewire.simulator.line_options import line_of
from framewire.simulator.numbered import Numbered
from lxservo_simulator.cli import SIMULATOR as BUS

from tests.in_turn import in_turn
from tests.lines.hosts import Host
from tests.programs import ran
from tests.timeouts import GENEROUS
from tests.unit.runtime.simulator.conftest import ASK, VOLTAGE

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

    from framewire.simulator.command import Simulator

    Process = subprocess.Popen[str]
    Start = Callable[..., tuple[Process, str]]

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
BOARD = [sys.executable, "-m", "busservo_simulator"]
not_windows = pytest.mark.skipif(sys.platform == "win32", reason="no pty and no SIGINT there")


@pytest.fixture
def start() -> Iterator[Start]:
    """Yield a function that starts the command, and returns it with the port that it printed."""
    started: list[Process] = []

    def run(*words: str) -> tuple[Process, str]:
        pipe = subprocess.PIPE
        started.append(
            subprocess.Popen([*BOARD, *words], env=ENVIRONMENT, stdout=pipe, stderr=pipe, text=True)
        )
        assert started[-1].stdout is not None
        return started[-1], started[-1].stdout.readline().strip()

    yield run
    for process in started:
        process.kill()
        process.communicate()


def ended(process: Process, by: signal.Signals | None = None) -> tuple[int, str, str]:
    """Return the status of a command that ends, by itself or by a signal, and what it printed."""
    if by is not None:
        process.send_signal(by)
    output, errors = process.communicate(timeout=GENEROUS)
    return process.returncode, output, errors


def leave(process: Process) -> None:
    """End reading what a command prints."""
    assert process.stdout is not None
    process.stdout.close()
    process.stdout = None


@not_windows
def test_it_answers_prints_what_happens_and_ends_cleanly(start: Start, tmp_path: Path) -> None:
    link = tmp_path / "COM7"
    words = ["--battery", "8000", "--servos", "1,3-4", "--off", "4", "--missing", "3"]
    process, port = start("--link", str(link), *words)
    assert port == str(link)
    host = Host(open_transport(port))
    assert host.ask(ASK) == BatteryVoltage(8000)
    assert host.ask(ServoPositionsRead([1, 2, 3, 4])) == ServoPositions([(1, 500), (4, 65535)])
    host.hang_up()
    status, output, errors = ended(process, signal.SIGTERM)
    assert (status, errors) == (0, "2 messages, 0 rejected\n")
    assert "LED2      blinks: BatteryVoltageRead()" in output
    assert not link.is_symlink()


@not_windows
def test_over_tcp_it_can_be_quiet_and_says_where_the_network_reaches_it(start: Start) -> None:
    process, port = start(
        *("--tcp", "--quiet", "--baud", "inf", "--fault", "noise=1", "--seed", "3"),
        *("--host", "0.0.0.0"),  # noqa: S104 - it is what is asked for
    )
    assert port.startswith("socket://0.0.0.0:")
    host = Host(open_transport(port))
    assert host.ask(ASK) == VOLTAGE
    assert host.noise()
    host.hang_up()
    status, output, errors = ended(process, signal.SIGINT)
    assert (status, output) == (0, "")
    assert errors.startswith("busservo-simulator: the network reaches it at 0.0.0.0\n")


@in_turn(
    "simulator, others",
    lambda: [(SIMULATOR, []), (BUS, ["fewer", "absent", "wrong_count", "unsolicited"])],
)
def test_help_teaches_by_example(
    capsys: pytest.CaptureFixture[str], simulator: Simulator, others: list[str]
) -> None:
    assert simulator.main(["--help"]) == 0
    shown = capsys.readouterr().out
    assert f"{simulator.name} --tcp 4000" in shown
    assert [name for name in CHANCES if f"\n  {name} " not in shown] == others
    for action in simulator.parser()._actions:
        assert action.help, action.option_strings


FRAMES = ASK.encode(), VOLTAGE.encode()


@in_turn(
    "words, expected",
    lambda: [
        ("--local-echo --baud 96000", b"".join(FRAMES)),
        ("--fault duplicated=1", FRAMES[1] * 2),
        ("--fault late=1 --late-by 0.02", FRAMES[1]),
        ("--fault delays=1 --longest-delay 0.02", FRAMES[1]),
        ("--fault lost_bytes=0.2 --seed 1", bytes.fromhex("55 04 0F 4C 1D")),
        ("--servos 1-2 --fault wrong_count=1 --seed 1", bytes.fromhex("55 55 09 15 01")),
    ],
)
def test_its_options_change_what_is_on_the_wire(words: str, expected: bytes) -> None:
    arguments = SIMULATOR.parser().parse_args(["--tcp", *words.split()])
    with SIMULATOR.made_of(arguments) as board:
        host = Host(open_transport(board.port))
        host.say(ServoPositionsRead([1, 2]) if "count" in words else ASK)
        assert host.collect(len(expected))[: len(expected)] == expected
        host.hang_up()


@in_turn(
    "words, said",
    lambda: [
        ("--fault gremlins=1", "no fault is called 'gremlins'"),
        ("--fault noise=lots", "--fault: 'lots' is no chance: write one from 0 to 1"),
        ("--fault noise=2", "--fault: '2' is no chance: write one from 0 to 1, as noise=0.1"),
        ("--fault noise", "--fault: '' is no chance: write one from 0 to 1, as noise=0.1"),
        ("--fault late_by=2", "no fault is called 'late_by'"),
        ("--late-by=-1", "--late-by: '-1' is no time: write seconds, as 0.5"),
        ("--longest-delay nan", "--longest-delay: 'nan' is no time"),
        ("--seed 1_0", "--seed: '1_0' is no seed: write a whole number, as 7"),
        ("--off 9 --tcp", "--off 9: there is no such servo; see --servos"),
        ("--missing 0 --tcp", "--missing 0: there is no such servo; see --servos"),
        ("--tcp --link COM7", "--link names a pty, and there is none with --tcp"),
        ("--tcp 99999", "'99999' is no TCP port: write one from 0 to 65535"),
        ("--tcp 0 --host 203.0.113.7", "203.0.113.7, port 0 cannot be opened: "),
        ("--servos 300", "'300' names no servos: servos are numbered 0 to 253, as in 1-6,9"),
        ("--baud 0", "--baud: '0' is no rate: write one above 0, as 9600, or inf"),
        ("--baud fast", "--baud: 'fast' is no rate"),
        ("--battery 7.5", "'7.5' is no voltage of a battery in mV: write one from 0 to 65535"),
    ],
)
def test_what_it_cannot_do_is_an_error(
    capsys: pytest.CaptureFixture[str], words: str, said: str
) -> None:
    assert SIMULATOR.main(words.split()) == 2
    shown = capsys.readouterr().err
    assert said in shown
    # A host that cannot be listened at is not said to be reached.
    assert "reaches" not in shown


@not_windows
@pytest.mark.parametrize(
    ("words", "by", "asked", "status"),
    [
        ([], None, 1, 141),
        ([], None, 0, 141),
        ([], signal.SIGTERM, 0, 141),
        (["--quiet"], signal.SIGTERM, 0, 0),
    ],
)
def test_how_it_ends_does_not_depend_on_when_its_reader_goes(
    start: Start, words: list[str], by: signal.Signals | None, asked: int, status: int
) -> None:
    process, port = start("--tcp", *words)
    leave(process)
    if asked:
        host = Host(open_transport(port))
        host.say(ASK)
    printed = ended(process, by)
    if asked:
        host.hang_up()
    said = f"{asked} message{'' if asked else 's'}, 0 rejected\n"
    assert (printed[0], printed[2]) == (status, said)


@not_windows
def test_it_ends_at_once_where_nobody_reads_the_name_of_its_port() -> None:
    ours, theirs = os.pipe()
    os.close(ours)
    streams: dict[str, Any] = {"capture_output": False, "stdout": theirs, "stderr": subprocess.PIPE}
    done = ran(*BOARD, "--tcp", status=141, env=ENVIRONMENT, **streams)
    os.close(theirs)
    assert done.stderr == ""


# -------------------------------------------------------------------- devices by number


LAMPS = Numbered("lamp", 253)


@in_turn(
    "text, numbers",
    lambda: [
        *(("1", [1]), ("1-3", [1, 2, 3]), ("1-2,9", [1, 2, 9]), ("9, 0-1", [9, 0, 1])),
        *(("253", [253]), ("2,2", [2, 2])),
    ],
)
def test_numbers_are_listed_in_their_order(text: str, numbers: list[int]) -> None:
    assert LAMPS.read(text) == numbers


@in_turn("text", lambda: ["", "3-1", "254", "x", "-1", "1-", "1_0", "+1", "\u0663"])
def test_what_names_none_is_refused(text: str) -> None:
    with pytest.raises(ArgumentTypeError, match=r"names no lamps: lamps are numbered 0 to 253,"):
        LAMPS.read(text)


# -------------------------------------------------------------------- options of the line
def line(words: str) -> Any:
    """Return the line that arguments choose."""
    return line_of(SIMULATOR.parser().parse_args(words.split()), Faults)


@in_turn("name", lambda: [each.name for each in fields(Faults)])
def test_every_field_of_the_faults_is_reached(name: str) -> None:
    value = 7 if name == "seed" else 0.125
    words = f"--fault {name}={value}" if name in CHANCES else f"--{name.replace('_', '-')} {value}"
    assert line(words)["faults"] == replace(Faults(), **{name: value})  # type: ignore[arg-type]


@in_turn("words, pace", lambda: [("", 9600), ("--baud 96000", 96000), ("--baud inf", None)])
def test_the_line_is_as_slow_as_the_real_one_unless_told_otherwise(
    words: str, pace: float | None
) -> None:
    assert line(words)["baud"] == pace


@in_turn(
    "name, value",
    lambda: [
        *((name, value) for name in CHANCES for value in (-0.1, 1.1, float("nan"))),
        *((name, value) for name in DURATIONS for value in (-0.1, float("inf"), float("nan"))),
    ],
)
def test_what_cannot_be_is_refused_by_its_name(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"^{name} is {value}: "):
        Faults(**{name: value})  # type: ignore[arg-type]
