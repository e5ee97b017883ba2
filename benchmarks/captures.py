"""The byte streams to decode: what a controller sends, clean and disturbed.

Every stream is made here from a fixed seed, so that two runs decode the same bytes.
"""

from __future__ import annotations

import random
from functools import cache, lru_cache

from benchmarks import floor

KINDS = ("clean", "garbage", "flipped")
"""clean: frame after frame.
garbage: one to eight random bytes between one frame and the next, one time in four; one time in
sixteen of these the last of them is 55, which makes a false header with the frame behind it.
flipped: one byte in five hundred has one of its bits turned over."""

PIECE = 1 << 20
"""Bytes in a piece: a run walks from piece to piece, so that ten of them are the ten megabytes."""

_QUESTIONS = {
    floor.POSITIONS: bytes.fromhex("55 55 09 15 06 01 02 03 04 05 06"),
    floor.BATTERY: bytes.fromhex("55 55 02 0F"),
}


def positions_frame(positions: list[tuple[int, int]]) -> bytes:
    """Return the position reply that carries these (servo id, position) pairs."""
    body = b"".join(
        servo_id.to_bytes(1, "little") + position.to_bytes(2, "little")
        for servo_id, position in positions
    )
    return bytes([0x55, 0x55, 3 * len(positions) + 3, floor.POSITIONS, len(positions)]) + body


def battery_frame(voltage_mv: int) -> bytes:
    """Return the battery reply that carries this voltage."""
    return bytes([0x55, 0x55, 4, floor.BATTERY]) + voltage_mv.to_bytes(2, "little")


def report_frame(command: int, group: int, times: int) -> bytes:
    """Return the report that an action group started or completed."""
    return bytes([0x55, 0x55, 5, command, group]) + times.to_bytes(2, "little")


def _frames(rng: random.Random) -> list[bytes]:
    """Return a thousand frames of a polled six-servo arm: eight in ten are positions."""
    frames = []
    for index in range(1000):
        turn = index % 10
        if turn < 8:
            pairs = [(servo_id, rng.randrange(1001)) for servo_id in range(1, 7)]
            frames.append(positions_frame(pairs))
        elif turn == 8:
            frames.append(battery_frame(rng.randrange(6000, 8400)))
        else:
            command = (floor.ACTION_GROUP_STARTED, floor.ACTION_GROUP_COMPLETED)[index // 10 % 2]
            frames.append(report_frame(command, rng.randrange(32), rng.randrange(1, 10)))
    return frames


def _garbage(rng: random.Random) -> bytes:
    garbage = rng.randbytes(rng.randint(1, 8))
    return garbage[:-1] + b"\x55" if rng.random() < 1 / 16 else garbage


@cache
def piece(kind: str, number: int) -> bytes:
    """Return piece `number` of the stream of this kind; only its end may cut a frame."""
    rng = random.Random(number)
    frames = _frames(rng)
    parts: list[bytes] = []
    size = 0
    while size < PIECE:
        frame = rng.choice(frames)
        if kind == "garbage" and rng.random() < 0.25:
            frame += _garbage(rng)
        parts.append(frame)
        size += len(frame)
    data = bytearray(b"".join(parts)[:PIECE])
    if kind == "flipped":
        for offset in rng.sample(range(PIECE), PIECE // 500):
            data[offset] ^= 1 << rng.randrange(8)
    return bytes(data)


def conversation() -> bytes:
    """Return a megabyte of both directions of a line: each question in front of its answer."""
    rng = random.Random(0)
    frames = _frames(rng)
    data = bytearray()
    while len(data) < PIECE:
        frame = rng.choice(frames)
        data += _QUESTIONS.get(frame[3], b"") + frame
    return bytes(data)


@cache
def disturbed(share: float) -> bytes:
    """Return a conversation of which so much is noise, and half of that looks like frames.

    A piece of noise is some random bytes, a false header with a length and a command that a message
    has, a frame that is cut off, or a frame with one byte too many.
    """
    rng = random.Random(share)
    frames = _frames(rng)
    data = bytearray()
    noise = 0
    while len(data) < PIECE:
        frame = rng.choice(frames)
        data += _QUESTIONS.get(frame[3], b"") + frame
        while noise < share * len(data):
            piece = _hostile(rng, rng.choice(frames))
            data += piece
            noise += len(piece)
    return bytes(data)


def _hostile(rng: random.Random, frame: bytes) -> bytes:
    """Return a piece of noise."""
    match rng.randrange(4):
        case 0:
            return rng.randbytes(rng.randint(1, 16))
        case 1:
            return frame[:4]
        case 2:
            return frame[: rng.randrange(1, len(frame))]
        case _:
            at = rng.randrange(2, len(frame))
            return frame[:at] + rng.randbytes(1) + frame[at:]


@lru_cache(maxsize=2)
def chunks(kind: str, number: int, size: int, chunk: int) -> list[bytes]:
    """Return the first `size` bytes of a piece in chunks, as a port or a file returns them."""
    data = piece(kind, number)[:size]
    return [data[start : start + chunk] for start in range(0, size, chunk)]
