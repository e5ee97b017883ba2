"""The ranges of the numbers of a frame, looked at in the way of every frame that is read."""

from __future__ import annotations

from struct import Struct

from .number import Number

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .message import Message


def fields_hold(kind: type[Message]) -> Callable[[bytes], bool]:
    """Return what says of a whole frame of a message whether its fields are right."""
    shape = kind.SHAPE
    numbers = [part for part in shape.parts if isinstance(part, Number) and part.narrowed]
    places = [place[0] for place in shape.places(shape.counts[0])]
    usual = len(shape.counts) == 1 and places == [number.at for number in numbers]
    if usual and all(type(each.struct) is Struct and not each.others for each in numbers):
        orders = {each.struct.format[0] for each in numbers}
        if len(orders) == 1:
            return _in_range(orders.pop(), numbers)
    return shape.holds


def _in_range(order: str, numbers: Sequence[Number]) -> Callable[[bytes], bool]:
    """Return what looks at numbers of one byte order, all unpacked at once."""
    layout, end = order, 0
    for number in numbers:
        layout += f"{number.at - end}x{number.code}"
        end = number.at + number.struct.size
    unpack = Struct(layout).unpack_from
    bounds = [(number.low, number.high) for number in numbers]
    if len(bounds) == 1:
        ((low, high),) = bounds

        def one(frame: bytes) -> bool:
            number: int = unpack(frame)[0]
            return low <= number <= high

        return one
    if len(bounds) == 2:
        (low, high), (least, most) = bounds

        def two(frame: bytes) -> bool:
            first, second = unpack(frame)
            return low <= first <= high and least <= second <= most

        return two

    def every(frame: bytes) -> bool:
        for number, (low, high) in zip(unpack(frame), bounds, strict=True):
            if not low <= number <= high:
                return False
        return True

    return every
