"""Numbers read at many places of a stretch of bytes at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .._explanation.protocol import Slot
    from .events import Bytes, Numbers


def dtype_of(slot: Slot) -> np.dtype[Any]:
    """Return the type of a number's values, of the machine's byte order."""
    if slot.is_float:
        return np.dtype(f"f{slot.size}")
    # A number of three bytes has room in four.
    return np.dtype(
        f"{'i' if slot.said.get('signed') else 'u'}{4 if slot.size == 3 else slot.size}"
    )


def read_numbers(data: Bytes, places: Numbers, slot: Slot) -> NDArray[Any]:
    """Return the numbers that begin at some places of `data`."""
    kind = dtype_of(slot)
    if slot.size == 1:
        return data.take(places).view(kind)
    # Byte by byte: a number may begin anywhere, which few machines like.
    numbers = np.zeros(len(places), f"u{kind.itemsize}")
    for at in range(slot.size):
        byte = data.take(places + at).astype(numbers.dtype)
        shift = at if slot.order == "little" else slot.size - 1 - at
        numbers |= byte << numbers.dtype.type(8 * shift)
    if slot.size == 3 and slot.said.get("signed"):
        return (numbers << np.uint32(8)).view(kind) >> np.int32(8)
    return numbers.view(kind)


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
