"""The numbers that messages carry, read from many frames at once: what is measured, and of what."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa

from ...protocol.slots import List, Number, Packed
from ..columns import field_array

if TYPE_CHECKING:
    from collections.abc import Iterator
    from typing import TypeGuard

    from numpy.typing import NDArray

    from ...protocol.slots import Slot
    from ...recording.layout import Column, Layout
    from ..events import Frames, Numbers


@dataclass(frozen=True, eq=False)
class Quantity:
    """A number that a message carries, or that each element of its list does.

    `key` says what it is measured of: the first number of an element, or the address of the frame;
    None where a message has but one such number.
    """

    layout: Layout
    column: Column
    slot: Number | Packed
    key: Number | None
    path: str

    @property
    def name(self) -> str:
        """The message, and the path of the number in it."""
        return f"{self.layout.name}.{self.path}"

    @property
    def place(self) -> tuple[int, int]:
        """Its place among all of the protocol."""
        return self.layout.number, quantities(self.layout).index(self)

    @property
    def about(self) -> str:
        """What it is, as the spec has it."""
        return self.slot.about

    @property
    def is_measured(self) -> bool:
        """Whether it is a reading, rather than a setting: a reply's, in a unit, or one of many."""
        has_unit = bool(self.slot.unit or self.slot.scale)
        return self.layout.described.kind == "reply" or has_unit or self.column.is_list

    @property
    def scale(self) -> tuple[float, float, str]:
        """The factor, the offset and the unit in which people read it."""
        scale = self.slot.scale
        if scale is None:
            return 1.0, 0.0, self.slot.unit
        return float(scale.step), float(scale.offset or 0), scale.unit

    @property
    def absent(self) -> list[int]:
        """The values that stand for no value."""
        named = self.slot.values.values() if isinstance(self.slot, Number) else ()
        return [each.value for each in named if each.absent]


@dataclass(frozen=True, slots=True)
class Readings:
    """The values of a quantity: in which frame each stands, and what it is measured of.

    `key` is 0 throughout where a quantity has none. `absent` marks what stands for no value.
    """

    frame: Numbers
    key: NDArray[Any]
    value: NDArray[Any]
    absent: NDArray[np.bool_]

    def measured_of(self, ids: Numbers) -> Readings:
        """Return those that are measured of some numbers."""
        which = np.isin(self.key, ids)
        return Readings(self.frame[which], self.key[which], self.value[which], self.absent[which])


@cache
def quantities(layout: Layout) -> tuple[Quantity, ...]:
    """Return the numbers of a message, in the order of its fields."""
    return tuple(each for column in layout.columns for each in _of(layout, column))


def _of(layout: Layout, column: Column) -> Iterator[Quantity]:
    slot, address = column.slot, _address(layout)
    key = address.slot if address is not None and isinstance(address.slot, Number) else None
    if isinstance(slot, Packed) or _is_quantity(slot):
        yield Quantity(layout, column, slot, key, column.name)
    if not isinstance(slot, List) or slot.text:
        return
    names = layout.element_names(column)
    first, *others = column.fields
    if others and _is_key(first):
        key = first
    for name, each in zip(names or ("",), column.fields, strict=True):
        if each is not key and isinstance(each, Number) and (_is_quantity(each) or not names):
            path = f"{column.name}.{name}" if names else column.name
            yield Quantity(layout, column, each, key, path)


def _address(layout: Layout) -> Column | None:
    """Return the column of the address, of a message that has one."""
    return next((each for each in layout.columns if each.slot.role == "address"), None)


def _is_key(slot: Slot) -> TypeGuard[Number]:
    """Tell whether a number may say what is measured: a whole one, which has no unit."""
    if not _is_quantity(slot) or slot.unit or slot.scale:
        return False
    return not slot.is_float and slot.size < 8


def _is_quantity(slot: Slot) -> TypeGuard[Number]:
    """Tell whether it is a number that may be more or less, rather than bits."""
    return isinstance(slot, Number) and slot.role == "field" and not slot.bits


def readings(layout: Layout, frames: Frames) -> Iterator[tuple[Quantity, Readings]]:
    """Yield all numbers of one message with their values in some of its frames."""
    address = _address(layout)
    count = len(frames.start)
    addresses: NDArray[Any] = np.zeros(count, np.int64)
    if address is not None:
        addresses = _numbers(field_array(layout, frames, address))
    last: Column | None = None
    array = pa.nulls(0)
    for each in quantities(layout):
        if each.column is not last:
            last, array = each.column, field_array(layout, frames, each.column)
        yield each, _readings(each, array, addresses)


def _readings(quantity: Quantity, array: pa.Array, addresses: NDArray[Any]) -> Readings:
    if pa.types.is_list(array.type):
        frame = _frames_of_elements(array)
        array = array.flatten()
        key = addresses[frame]
        if pa.types.is_struct(array.type):
            if quantity.key is quantity.column.fields[0]:
                key = _numbers(array.field(0))
            fields = enumerate(quantity.column.fields)
            array = array.field(next(at for at, each in fields if each is quantity.slot))
    else:
        frame = _whole(array)
        key, array = addresses[frame], array.drop_null()
    value = _numbers(array)
    absent = np.isin(value, quantity.absent)
    if np.issubdtype(value.dtype, np.floating):
        absent |= ~np.isfinite(value)
    if isinstance(quantity.slot, Number) and quantity.slot.signed_as:
        value = _signed(value, quantity.slot.size)
    return Readings(frame, key, value, absent)


def _signed(value: NDArray[Any], size: int) -> NDArray[Any]:
    """Return numbers of so many bytes as people read them: a little below zero is no more."""
    unused = 8 * (value.itemsize - size)
    return (value << unused).view(f"i{value.itemsize}") >> unused


def _whole(array: pa.Array) -> Numbers:
    """Return the frames that have the number: all of them, unless it is optional."""
    every: Numbers = np.arange(len(array))
    return every[_numbers(array.is_valid())] if array.null_count else every


def _frames_of_elements(array: pa.Array) -> Numbers:
    counts = np.diff(_numbers(array.offsets))
    frames: Numbers = np.repeat(np.arange(len(array)), counts)
    return frames


def _numbers(array: pa.Array) -> NDArray[Any]:
    found: NDArray[Any] = array.to_numpy(zero_copy_only=False)
    return found
