"""How near a client comes to what the line allows: six-servo position reads at 9600 baud.

    python -m benchmarks.line [--reads N] [--rounds N] [--via pty|tcp]

A virtual controller lets bytes through at the pace of the wire, both ways. A read is a request of
11 bytes and a reply of 23, so 34 bytes of ten bits: 35.4 ms at 9600 baud, and no client that asks
one thing at a time can be faster. The share is of that rate. On a busy
machine the pacing itself is late: pyserial alone, which decodes nothing, shows by how much. `xarm`,
from the package index, is a client of the same controller; where it is not installed, that is said.
"""

from __future__ import annotations

import argparse
import asyncio
import importlib.util
import os
import tempfile
import time
from pathlib import Path
from statistics import median

import busservo
import serial
from busservo.protocol import BAUD, BITS_PER_BYTE
from busservo_simulator import VirtualController

SERVOS = [1, 2, 3, 4, 5, 6]
BYTES = len(busservo.ServoPositionsRead(SERVOS).encode()) + len(
    busservo.ServoPositions([(servo, 500) for servo in SERVOS]).encode()
)
BEST = BYTES * BITS_PER_BYTE / BAUD


def with_nothing(port: str, reads: int) -> float:
    """Seconds a read, by pyserial alone: what this machine allows at this moment."""
    request = busservo.ServoPositionsRead(SERVOS).encode()
    with serial.serial_for_url(port, BAUD, timeout=1) as line:
        line.write(request)
        line.read(BYTES - len(request))
        began = time.perf_counter()
        for _ in range(reads):
            line.write(request)
            line.read(BYTES - len(request))
        return (time.perf_counter() - began) / reads


def with_threads(port: str, reads: int) -> float:
    """Seconds a read, by the client for threads."""
    with busservo.open_controller(port) as controller:
        controller.read_servo_positions(SERVOS)
        began = time.perf_counter()
        for _ in range(reads):
            controller.read_servo_positions(SERVOS)
        return (time.perf_counter() - began) / reads


def with_asyncio(port: str, reads: int) -> float:
    """Seconds a read, by the client for asyncio."""

    async def measure() -> float:
        async with busservo.open_async_controller(port) as controller:
            await controller.read_servo_positions(SERVOS)
            began = time.perf_counter()
            for _ in range(reads):
                await controller.read_servo_positions(SERVOS)
            return (time.perf_counter() - began) / reads

    return asyncio.run(measure())


def with_xarm(port: str, reads: int) -> float:
    """Seconds a read, by the client `xarm`, which takes ports by the name of COM alone."""
    import xarm  # noqa: PLC0415 - a peer, and not installed by everybody

    before = Path.cwd()
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "COM1").symlink_to(port)
        os.chdir(folder)
        try:
            arm = xarm.Controller("COM1")
        finally:
            os.chdir(before)
    servos = [xarm.Servo(servo) for servo in SERVOS]
    # It waits a second for each answer: few of them tell as much as many.
    reads = min(reads, 3)
    try:
        began = time.perf_counter()
        for _ in range(reads):
            arm.getPosition(servos)
        return (time.perf_counter() - began) / reads
    finally:
        arm._device.close()


CONTENDERS = {
    "pyserial alone": with_nothing,
    "Controller": with_threads,
    "AsyncController": with_asyncio,
    "xarm": with_xarm,
}


def main() -> None:
    """Measures all in turn, some rounds of it, and prints the median of each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reads", type=int, default=60, help="in a round (default: 60)")
    parser.add_argument("--rounds", type=int, default=5, help="default: 5")
    parser.add_argument("--via", choices=["pty", "tcp"], default="pty")
    arguments = parser.parse_args()
    able = dict(CONTENDERS)
    if arguments.via == "tcp":
        del able["xarm"]
        print("xarm: opens serial ports alone, and this is TCP")
    elif importlib.util.find_spec("xarm") is None:
        del able["xarm"]
        print("xarm: not installed")
    print(f"the line alone: {BEST * 1000:.2f} ms a read, {1 / BEST:.2f} reads a second")
    taken: dict[str, list[float]] = {name: [] for name in able}
    for _ in range(arguments.rounds):
        for name, measure in able.items():
            with VirtualController(via=arguments.via, baud=BAUD) as board:
                taken[name].append(measure(board.port, arguments.reads))
    for name, rounds in taken.items():
        middle = median(rounds)
        print(
            f"{name:16} {middle * 1000:8.2f} ms a read, {BEST / middle:6.1%} of the line's rate "
            f"({BEST / max(rounds):.1%} to {BEST / min(rounds):.1%})"
        )


if __name__ == "__main__":
    main()
