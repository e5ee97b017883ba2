"""The command `busservo-simulator`: what it prints, what it refuses, and how it ends."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
from dataclasses import fields, replace
from typing import TYPE_CHECKING

import pytest
from busservo import (
    BatteryVoltage,
    BatteryVoltageRead,
    ServoPositions,
    ServoPositionsRead,
    open_transport,
)
from busservo_simulator import Faults
from busservo_simulator.cli import _board, main
from busservo_simulator.faults import CHANCES
from busservo_simulator.options import PROGRAM, parser_of
from framewire.simulator import line_options
from framewire.simulator.line_options import faults_of
from framewire.simulator.servo_list import parse_servos

from tests.in_turn import in_turn
from tests.lines.hosts import Host
from tests.programs import ran
from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator
    from pathlib import Path

ENVIRONMENT = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
not_windows = pytest.mark.skipif(sys.platform == "win32", reason="no pty and no SIGINT there")


@pytest.fixture
def start() -> Iterator[Callable[..., tuple[subprocess.Popen[str], str]]]:
    """Yield a function that starts the command, and returns it with the port that it printed."""
    started: list[subprocess.Popen[str]] = []

    def run(*arguments: str) -> tuple[subprocess.Popen[str], str]:
        command = [sys.executable, "-m", "busservo_simulator", *arguments]
        process = subprocess.Popen(
            command,
            env=ENVIRONMENT,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        started.append(process)
        assert process.stdout is not None
        return process, process.stdout.readline().strip()

    yield run
    for process in started:
        process.kill()
        process.communicate()


@not_windows
def test_it_answers_prints_what_happens_and_ends_cleanly(
    start: Callable[..., tuple[subprocess.Popen[str], str]], tmp_path: Path
) -> None:
    link = tmp_path / "COM7"
    process, port = start(
        "--link", str(link), "--battery", "8000", "--servos", "1,3-4", "--off", "4"
    )
    assert port == str(link)
    host = Host(open_transport(port))
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(8000)
    assert host.ask(ServoPositionsRead([1, 2, 3, 4])) == ServoPositions(
        [(1, 500), (3, 500), (4, 65535)]
    )
    host.hang_up()
    process.send_signal(signal.SIGTERM)
    output, errors = process.communicate(timeout=GENEROUS)
    assert process.returncode == 0
    assert "LED2      blinks: BatteryVoltageRead()" in output
    assert errors == "2 messages, 0 rejected\n"
    assert not link.is_symlink()


@not_windows
def test_over_tcp_it_can_be_quiet_and_says_where_the_network_reaches_it(
    start: Callable[..., tuple[subprocess.Popen[str], str]],
) -> None:
    process, port = start(
        *("--tcp", "--quiet", "--baud", "inf", "--fault", "noise=1", "--seed", "3"),
        *("--host", "0.0.0.0"),  # noqa: S104 - it is what is asked for
    )
    assert port.startswith("socket://0.0.0.0:")
    host = Host(open_transport(port))
    assert host.ask(BatteryVoltageRead()) == BatteryVoltage(7500)
    assert host.noise()
    host.hang_up()
    process.send_signal(signal.SIGINT)
    output, errors = process.communicate(timeout=GENEROUS)
    assert (process.returncode, output) == (0, "")
    assert errors.startswith("busservo-simulator: the network reaches it at 0.0.0.0\n")


def test_help_teaches_by_example(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["--help"]) == 0
    shown = capsys.readouterr().out
    assert "busservo-simulator --tcp 4000" in shown
    assert all(name in shown for name in CHANCES)


def test_every_option_has_its_help() -> None:
    for action in parser_of(PROGRAM)._actions:
        assert action.help, action.option_strings


@in_turn("name", lambda: [each.name for each in fields(Faults)])
def test_every_field_of_the_faults_is_reached(name: str) -> None:
    value = 7 if name == "seed" else 0.125
    option = [f"--{name.replace('_', '-')}", str(value)]
    words = ["--fault", f"{name}={value}"] if name in CHANCES else option
    arguments = parser_of(PROGRAM).parse_args(words)
    assert faults_of(arguments, Faults) == replace(Faults(), **{name: value})  # type: ignore[arg-type]


ASK = BatteryVoltageRead().encode()
REPLY = BatteryVoltage(7500).encode()


@in_turn(
    "words, expected",
    lambda: [
        ("--local-echo --baud 96000", ASK + REPLY),
        ("--fault duplicated=1", REPLY + REPLY),
        ("--fault late=1 --late-by 0.02", REPLY),
        ("--fault delays=1 --longest-delay 0.02", REPLY),
        ("--fault lost_bytes=0.2 --seed 1", bytes.fromhex("55 04 0F 4C 1D")),
        ("--servos 1-2 --fault wrong_count=1 --seed 1", bytes.fromhex("55 55 09 15 01")),
    ],
)
def test_its_options_change_what_is_on_the_wire(words: str, expected: bytes) -> None:
    arguments = parser_of(PROGRAM).parse_args(["--tcp", *words.split()])
    with _board(arguments) as board:
        host = Host(open_transport(board.port))
        host.transport.write(ServoPositionsRead([1, 2]).encode() if "count" in words else ASK)
        assert host.collect(len(expected))[: len(expected)] == expected
        host.hang_up()


@in_turn(
    "arguments, words",
    lambda: [
        (["--fault", "gremlins=1"], "no fault is called 'gremlins'"),
        (["--fault", "noise=lots"], "--fault: 'lots' is no chance: write one from 0 to 1"),
        (["--fault", "noise=2"], "--fault: '2' is no chance: write one from 0 to 1, as noise=0.1"),
        (["--fault", "noise"], "--fault: '' is no chance: write one from 0 to 1, as noise=0.1"),
        (["--fault", "late_by=2"], "no fault is called 'late_by'"),
        (["--late-by=-1"], "--late-by: '-1' is no time: write seconds, as 0.5"),
        (["--longest-delay", "nan"], "--longest-delay: 'nan' is no time"),
        (["--seed", "1_0"], "--seed: '1_0' is no seed: write a whole number, as 7"),
        (["--off", "9", "--tcp"], "there is no such servo"),
        (["--tcp", "--link", "COM7"], "--link names a pty"),
        (["--tcp", "99999"], "'99999' is no TCP port: write one from 0 to 65535"),
        (["--tcp", "0", "--host", "203.0.113.7"], "203.0.113.7, port 0 cannot be opened: "),
        (["--servos", "300"], "--servos"),
        (["--baud", "0"], "--baud: '0' is no rate: write one above 0, as 9600, or inf"),
        (["--baud", "fast"], "--baud: 'fast' is no rate"),
    ],
)
def test_what_it_cannot_do_is_an_error(
    capsys: pytest.CaptureFixture[str], arguments: list[str], words: str
) -> None:
    assert main(arguments) == 2
    shown = capsys.readouterr().err
    assert words in shown
    # A host that cannot be listened at is not said to be reached.
    assert "reaches" not in shown


@in_turn("text, servos", lambda: [("1", [1]), ("1-3", [1, 2, 3]), ("1-2,9", [1, 2, 9])])
def test_servos_are_listed_as_people_write_them(text: str, servos: list[int]) -> None:
    assert parse_servos(text) == servos


@in_turn("text", lambda: ["", "3-1", "254", "x", "-1"])
def test_what_names_no_servo_is_refused(text: str) -> None:
    with pytest.raises(ValueError):  # noqa: PT011 - argparse shows its own words
        parse_servos(text)


@in_turn("words, pace", lambda: [("", 9600), ("--baud 96000", 96000), ("--baud inf", None)])
def test_the_line_is_as_slow_as_the_real_one_unless_told_otherwise(
    words: str, pace: float | None
) -> None:
    assert line_options.pace(parser_of(PROGRAM).parse_args(words.split())) == pace


@not_windows
def test_it_ends_when_whoever_read_along_has_gone(
    start: Callable[..., tuple[subprocess.Popen[str], str]],
) -> None:
    process, port = start("--tcp")
    assert process.stdout is not None
    process.stdout.close()
    process.stdout = None
    host = Host(open_transport(port))
    host.say(BatteryVoltageRead())
    _, errors = process.communicate(timeout=GENEROUS)
    host.hang_up()
    assert (process.returncode, errors) == (141, "1 message, 0 rejected\n")


@not_windows
@pytest.mark.parametrize(
    ("words", "signalled", "status"),
    [("", False, 141), ("", True, 141), ("--quiet", True, 0)],
)
def test_how_it_ends_does_not_depend_on_when_its_reader_goes(
    start: Callable[..., tuple[subprocess.Popen[str], str]],
    words: str,
    signalled: bool,
    status: int,
) -> None:
    process, _ = start("--tcp", *words.split())
    assert process.stdout is not None
    process.stdout.close()
    process.stdout = None
    if signalled:
        process.send_signal(signal.SIGTERM)
    _, errors = process.communicate(timeout=GENEROUS)
    assert (process.returncode, errors) == (status, "0 messages, 0 rejected\n")


@not_windows
def test_it_ends_at_once_where_nobody_reads_the_name_of_its_port() -> None:
    ours, theirs = os.pipe()
    os.close(ours)
    done = ran(
        *(sys.executable, "-m", "busservo_simulator", "--tcp"),
        status=141,
        env=ENVIRONMENT,
        capture_output=False,
        stdout=theirs,
        stderr=subprocess.PIPE,
    )
    os.close(theirs)
    assert done.stderr == ""
