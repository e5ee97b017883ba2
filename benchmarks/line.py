"""The speed of clients beside that of the line: six-servo position reads at 9600 baud.

    python -m benchmarks.line [--reads N] [--rounds N] [--via pty|tcp]

A virtual controller, in a process of its own, lets bytes through at the pace of the wire, both
ways. Besides the time of a read, its processor time is printed. A read is a request of 11 bytes and
a reply of 23, so 34 bytes of ten bits: 35.4 ms at 9600 baud, and no client that sends one request
at a time can be faster. The share is of that rate. On a busy machine the pacing itself is late:
pyserial alone, which decodes nothing, shows by how much. `xarm`, from the package index, is a
client of the same controller; if it is not installed, a line says so.
"""

from __future__ import annotations

import argparse
import asyncio
import importlib.util
import os
import subprocess
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from statistics import median
from typing import TYPE_CHECKING, NamedTuple

import busservo
import serial
from busservo._library import LINK

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

SERVOS = [1, 2, 3, 4, 5, 6]
BYTES = len(busservo.ServoPositionsRead(SERVOS).encode()) + len(
    busservo.ServoPositions([(servo, 500) for servo in SERVOS]).encode()
)
BEST = BYTES * LINK.bits_per_byte / LINK.baud


class Taken(NamedTuple):
    """What one read takes, in seconds: of the clock, and of the processor."""

    time: float
    cpu: float


class Watch:
    """A stopwatch that starts when it is made."""

    def __init__(self) -> None:
        self._time, self._cpu = time.perf_counter(), time.process_time()

    def each(self, reads: int) -> Taken:
        """Return the time that each of so many reads has taken."""
        taken, cpu = time.perf_counter() - self._time, time.process_time() - self._cpu
        return Taken(taken / reads, cpu / reads)


def with_nothing(port: str, reads: int) -> Taken:
    """Return the time of a read by pyserial alone: what this machine allows at this moment."""
    request = busservo.ServoPositionsRead(SERVOS).encode()
    with serial.serial_for_url(port, LINK.baud, timeout=1) as line:
        line.write(request)
        line.read(BYTES - len(request))
        watch = Watch()
        for _ in range(reads):
            line.write(request)
            line.read(BYTES - len(request))
        return watch.each(reads)


def with_threads(port: str, reads: int, threads: int = 1) -> Taken:
    """Return the time of a read by the client for threads; or by several that share one."""
    with busservo.open_controller(port) as controller, ThreadPoolExecutor(threads) as pool:
        controller.read_servo_positions(SERVOS)
        watch = Watch()
        if threads == 1:
            for _ in range(reads):
                controller.read_servo_positions(SERVOS)
        else:
            list(pool.map(lambda _: controller.read_servo_positions(SERVOS), range(reads)))
        return watch.each(reads)


def with_asyncio(port: str, reads: int) -> Taken:
    """Return the time of a read by the client for asyncio."""

    async def measure() -> Taken:
        async with busservo.open_async_controller(port) as controller:
            await controller.read_servo_positions(SERVOS)
            watch = Watch()
            for _ in range(reads):
                await controller.read_servo_positions(SERVOS)
            return watch.each(reads)

    return asyncio.run(measure())


def with_xarm(port: str, reads: int) -> Taken:
    """Return the time of a read by `xarm`, which takes only ports with a name of COM."""
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
        watch = Watch()
        for _ in range(reads):
            arm.getPosition(servos)
        return watch.each(reads)
    finally:
        arm._device.close()


CONTENDERS: dict[str, Callable[[str, int], Taken]] = {
    "pyserial alone": with_nothing,
    "Controller": with_threads,
    "eight threads": partial(with_threads, threads=8),
    "AsyncController": with_asyncio,
    "xarm": with_xarm,
}


@contextmanager
def board(via: str) -> Iterator[str]:
    """Run a virtual controller in a process of its own, and yield the name of its port."""
    command = [sys.executable, "-m", "busservo_simulator", "--quiet"]
    command += ["--tcp", "0"] if via == "tcp" else []
    with subprocess.Popen(
        command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True
    ) as process:
        try:
            assert process.stdout is not None
            yield process.stdout.readline().strip()
        finally:
            process.terminate()


def main() -> None:
    """Measure all in turn, some rounds of it, and print the median of each."""
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
    taken: dict[str, list[Taken]] = {name: [] for name in able}
    for _ in range(arguments.rounds):
        for name, measure in able.items():
            with board(arguments.via) as port:
                taken[name].append(measure(port, arguments.reads))
    for name, rounds in taken.items():
        times = [each.time for each in rounds]
        middle, cpu = median(times), median(each.cpu for each in rounds)
        print(
            f"{name:16} {middle * 1000:8.2f} ms a read, {BEST / middle:6.1%} of the line's rate "
            f"({BEST / max(times):.1%} to {BEST / min(times):.1%}), {cpu * 1000:.2f} ms of CPU"
        )


if __name__ == "__main__":
    main()
