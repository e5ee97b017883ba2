"""Numbers read at many places of a stretch of bytes at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ..protocol.slots import Number
    from .events import Bytes, Numbers


def dtype_of(slot: Number) -> np.dtype[Any]:
    """Return the type of a number's values, of the machine's byte order."""
    if slot.is_float:
        return np.dtype(f"f{slot.size}")
    # A number of three bytes has room in four.
    return np.dtype(f"{'i' if slot.signed else 'u'}{4 if slot.size == 3 else slot.size}")


def read_numbers(data: Bytes, places: Numbers, slot: Number) -> NDArray[Any]:
    """Return the numbers that begin at some places of `data`."""
    kind = dtype_of(slot)
    if slot.size == 1:
        return data.take(places).view(kind)
    # Byte by byte: a number may begin anywhere, which few machines like.
    last = slot.size - 1
    lowest, further = (0, 1) if slot.order == "little" else (last, -1)
    numbers = data.take(places + lowest).astype(f"u{kind.itemsize}")
    for number in range(1, slot.size):
        byte = data.take(places + (lowest + further * number)).astype(numbers.dtype)
        byte <<= numbers.dtype.type(8 * number)
        numbers |= byte
    if slot.size == 3 and slot.signed:
        return (numbers << np.uint32(8)).view(kind) >> np.int32(8)
    return numbers.view(kind)


_steps: dict[int, Numbers] = {}


def steps(size: int, count: int) -> Numbers:
    """Return so many multiples of a size, from 0 on: a part of some that are made once."""
    made = _steps.get(size)
    if made is None or len(made) < count:
        made = _steps[size] = np.arange(0, size * count, size)
    return made[:count]


def read_blocks(data: Bytes, places: Numbers, size: int) -> Bytes:
    """Return the bytes that begin at some places, so many of each, a row for each place."""
    return data.take(places[:, np.newaxis] + np.arange(size))


def find_all(data: Bytes, header: bytes) -> Numbers:
    """Return where these bytes begin in `data`, also where they overlap."""
    count = len(data) - len(header) + 1
    if count <= 0:
        return np.empty(0, np.int64)
    if len(header) == 1:
        return np.flatnonzero(data[:count] == header[0])
    # Two bytes at once, wherever they begin.
    pairs: NDArray[np.uint16] = np.ndarray((count,), np.uint16, data, 0, (1,))
    found = np.flatnonzero(pairs == np.frombuffer(header[:2], np.uint16)[0])
    for at, byte in enumerate(header[2:], 2):
        found = found[data.take(found + at) == byte]
    return found
