"""The numbers that messages carry, read from many frames at once: what is measured, and of what."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any

import numpy as np
import pyarrow as pa

from ..columns import field_array

if TYPE_CHECKING:
    from collections.abc import Iterator

    from numpy.typing import NDArray

    from ...explain.protocol import Slot
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
    slot: Slot
    key: Slot | None
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
        said = self.slot.said
        is_reply = self.layout.described.said.get("kind") == "reply"
        return is_reply or "unit" in said or "scale" in said or self.column.slot.role != "field"

    @property
    def scale(self) -> tuple[float, float, str]:
        """The factor, the offset and the unit in which people read it."""
        said = self.slot.said
        if "scale" in said:
            step, unit, *offset = said["scale"]
            return float(step), float((*offset, "0")[0]), str(unit)
        return 1.0, 0.0, str(said.get("unit", ""))

    @property
    def absent(self) -> list[int]:
        """The values that stand for no value."""
        named = self.slot.said.get("values", {}).values()
        return [each["value"] for each in named if each.get("absent")]


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
    slot = column.slot
    address = next((each.slot for each in layout.columns if each.slot.role == "address"), None)
    if slot.role == "packed" or (slot.role == "field" and _is_quantity(slot)):
        yield Quantity(layout, column, slot, address, column.name)
    if slot.role != "list" or "text" in slot.said:
        return
    names = layout.element_names(column)
    if not names:
        yield Quantity(layout, column, column.fields[0], address, column.name)
        return
    key, *others = column.fields
    is_keyed = bool(others) and _is_key(key)
    for name, each in zip(names, column.fields, strict=True):
        if each.role == "field" and _is_quantity(each) and not (is_keyed and each is key):
            of = key if is_keyed else address
            yield Quantity(layout, column, each, of, f"{column.name}.{name}")


def _is_key(slot: Slot) -> bool:
    """Tell whether a number may say what is measured: a whole one, which has no unit."""
    is_whole = slot.role == "field" and not slot.is_float and slot.size < 8
    return is_whole and not {"unit", "scale", "bits"} & slot.said.keys()


def _is_quantity(slot: Slot) -> bool:
    """Tell whether it is a number that may be more or less, rather than bits."""
    return "bits" not in slot.said


def readings(layout: Layout, frames: Frames) -> Iterator[tuple[Quantity, Readings]]:
    """Yield all numbers of one message with their values in some of its frames."""
    address = next((each for each in layout.columns if each.slot.role == "address"), None)
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
            array = array.field(quantity.column.fields.index(quantity.slot))
    else:
        frame = _whole(array)
        key, array = addresses[frame], array.drop_null()
    value = _numbers(array)
    absent = np.isin(value, quantity.absent)
    if np.issubdtype(value.dtype, np.floating):
        absent |= ~np.isfinite(value)
    if "signed_as" in quantity.slot.said:
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
