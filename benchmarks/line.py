"""How near a client comes to what the line allows: six-servo position reads at 9600 baud.

    python -m benchmarks.line [--reads N] [--via pty|tcp]

A virtual controller lets bytes through at the pace of the wire, both ways. A read is a request of
11 bytes and a reply of 23, so 34 bytes of ten bits: 35.4 ms at 9600 baud, and no client that asks
one thing at a time can be faster. The share is of that rate. On a busy
machine the pacing itself is late: pyserial alone, which decodes nothing, shows by how much.
"""

from __future__ import annotations

import argparse
import asyncio
import time

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


def main() -> None:
    """Measures both clients, and prints a line for each."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--reads", type=int, default=100)
    parser.add_argument("--via", choices=["pty", "tcp"], default="pty")
    arguments = parser.parse_args()
    print(f"the line alone: {BEST * 1000:.2f} ms a read, {1 / BEST:.2f} reads a second")
    for name, measure in (
        ("pyserial alone", with_nothing),
        ("Controller", with_threads),
        ("AsyncController", with_asyncio),
    ):
        with VirtualController(via=arguments.via, baud=BAUD) as board:
            taken = measure(str(board.port), arguments.reads)
        print(f"{name:16} {taken * 1000:.2f} ms a read, {BEST / taken:.1%} of the line's rate")


if __name__ == "__main__":
    main()
