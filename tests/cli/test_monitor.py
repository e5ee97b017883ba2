"""The verb `monitor`, with a transport, a screen and a clock of our own."""

import argparse
import io
from pathlib import Path

import pytest
from busservo import BatteryVoltage
from busservo.cli import main, monitor


class Line:
    """Brings pieces of bytes, each a second after the one before."""

    def __init__(self, *pieces: bytes) -> None:
        self.pieces = list(pieces)
        self.now = 100.0

    def clock(self) -> float:
        return self.now

    def read(self, timeout: float) -> bytes:  # noqa: ARG002
        self.now += 1
        return self.pieces.pop(0) if self.pieces else b""

    def write(self, data: bytes) -> None:  # noqa: ARG002
        raise AssertionError("a monitor only listens")

    def drain(self, timeout: float) -> None:
        pass

    def close(self) -> None:
        pass


FRAME = BatteryVoltage(7500).encode()


def shown(*words: str, log: io.StringIO | None = None) -> list[str]:
    parser = argparse.ArgumentParser()
    monitor.add_arguments(parser)
    line = Line(FRAME, b"\x13" + FRAME, FRAME)
    screen = io.StringIO()
    arguments = parser.parse_args(["--port", "COM7", *words])
    monitor.Monitor(arguments, screen, line.clock, log).watch(line)
    return screen.getvalue().splitlines()


HEX = "55 55 04 0F 4C 1D | BatteryVoltage voltage_mv=7500 mV"


@pytest.mark.parametrize(("form", "times"), [("zero", (1, 2, 2, 3)), ("delta", (1, 1, 0, 1))])
def test_a_line_for_each_frame_and_for_noise(form: str, times: tuple[int, ...]) -> None:
    rest = [f"controller  {HEX}", "noise       13 | bad header", *2 * [f"controller  {HEX}"]]
    expected = [f"{at:12.6f}  {what}" for at, what in zip(times, rest, strict=True)]
    assert shown("-n", "4", "-t", form) == expected


def test_only_what_is_asked_for() -> None:
    assert shown("-n", "1", "--only", "noise") == ["    2.000000  noise       13 | bad header"]


def test_the_log_is_read_by_decode(tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    log = io.StringIO()
    shown("-n", "4", log=log)
    file = tmp_path / "line.hex"
    file.write_text(log.getvalue())
    assert main(["decode", str(file)]) == 0
    assert "3 messages, 1 byte of noise" in capsys.readouterr().err
