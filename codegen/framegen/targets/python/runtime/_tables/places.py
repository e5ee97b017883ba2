"""Numbers read at many places of a stretch of bytes at once."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from .._explanation.protocol import Slot
    from .found import Bytes, Numbers


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
    kind, size = dtype_of(slot), slot.size
    if size == 1:
        return data[places].view(kind)
    if not len(places):
        return np.empty(0, kind)
    ordered = kind.newbyteorder("<" if slot.order == "little" else ">")
    if size != kind.itemsize:
        return _three_bytes(data, places, slot).astype(kind)
    # Every place is read as if a number began there, wherever the machine likes them to begin.
    count = len(data) - size + 1
    everywhere: NDArray[Any] = np.ndarray((count,), ordered, data, 0, (1,))
    return everywhere[places].astype(kind, copy=False)


def _three_bytes(data: Bytes, places: Numbers, slot: Slot) -> NDArray[np.int64]:
    first, second, third = (data[places + at].astype(np.int64) for at in range(3))
    low, high = (first, third) if slot.order == "little" else (third, first)
    whole = low | second << 8 | high << 16
    if not slot.said.get("signed"):
        return whole
    return (whole ^ 0x800000) - 0x800000


def read_blocks(data: Bytes, places: Numbers, size: int) -> Bytes:
    """Return the bytes that begin at some places, so many of each, a row for each place."""
    if not len(places):
        return np.empty((0, size), np.uint8)
    return data[places[:, np.newaxis] + np.arange(size)]
