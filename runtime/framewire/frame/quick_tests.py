"""Quick tests, made once for each class of messages: they are in the way of each one."""

from __future__ import annotations

from operator import contains
from struct import Struct

from .number import order_of

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any

    from .field import Place
    from .floating import Float
    from .number import Number


# So many numbers are checked by one call: most messages have no more.
_AT_ONCE = 3


def checker(fields: Sequence[Number | Float]) -> Callable[..., None]:
    """Return a function that raises EncodeError for the first wrong one of the numbers given.

    Good ones are passed over. Any others are looked at one by one, and are either numbers of
    another kind, such as NumPy's, or explained.
    """
    if len(fields) > _AT_ONCE:
        first, others = checker(fields[:_AT_ONCE]), checker(fields[_AT_ONCE:])

        def check_all(*numbers: Any) -> None:
            first(*numbers[:_AT_ONCE])
            others(*numbers[_AT_ONCE:])

        return check_all
    # What is not given is zero, and good.
    bounds: list[tuple[Any, float, float]]
    bounds = [(_kind(field), field.low, field.high) for field in fields]
    bounds += [(int, 0, 0)] * (_AT_ONCE - len(bounds))
    (kind, low, high), (kind_2, low_2, high_2), (kind_3, low_3, high_3) = bounds

    def check(number: Any, second: Any = 0, third: Any = 0) -> None:
        if (
            type(number) is not kind
            or type(second) is not kind_2
            or type(third) is not kind_3
            or not (
                low <= number <= high and low_2 <= second <= high_2 and low_3 <= third <= high_3
            )
        ):
            for field, each in zip(fields, (number, second, third), strict=False):
                field.checked(each, field.name)

    return check


def _kind(field: Number | Float) -> type:
    return float if isinstance(field.low, float) else int


def range_test(numbers: Sequence[Number]) -> Callable[[bytes], bool]:
    """Return a function that says whether all these numbers of a frame are inside their ranges.

    They have the same byte order.
    """
    at = 0
    layout = order_of(numbers)
    for number in numbers:
        layout += f"{number.at - at}x{number.code}"
        at = number.at + number.struct.size
    unpack: Callable[[bytes], tuple[int, ...]] = Struct(layout).unpack_from
    if len(numbers) == 1:
        (only,) = numbers
        low, high = only.low, only.high
        return lambda frame: low <= unpack(frame)[0] <= high
    if len(numbers) == 2:
        one, two = numbers
        low, high, least, most = one.low, one.high, two.low, two.high

        def both_inside(frame: bytes) -> bool:
            first, second = unpack(frame)
            return low <= first <= high and least <= second <= most

        return both_inside
    ranges = [range(number.low, number.high + 1) for number in numbers]
    return lambda frame: all(map(contains, ranges, unpack(frame)))


def place_test(places: Sequence[Place], tail: int) -> Callable[[bytes], bool]:
    """Return a function that says whether all is right in some places of a frame.

    What ends behind the fields is absent: `tail` bytes of the frame stand behind them.
    """

    def all_right(frame: bytes) -> bool:
        size = len(frame) - tail
        for at, end, due in places:
            if end > size:
                break
            found = frame[at:end]
            if found != due if isinstance(due, bytes) else due(found) is not None:
                return False
        return True

    return all_right


def count_test(number: Number, factor: int, around: int, unit: int) -> Callable[[bytes], bool]:
    """Return a function that says whether the counter of a list is right.

    Each element counts `factor` and has `unit` bytes, and `around` ones of the frame are not of the
    list.
    """
    unpack: Callable[[bytes, int], tuple[int, ...]] = number.struct.unpack_from
    at = number.at
    return lambda frame: unpack(frame, at)[0] == (len(frame) - around) // unit * factor


def item_test(numbers: Callable[[bytes], Sequence[int]], each: Number) -> Callable[[bytes], bool]:
    """Return a function that says whether each number of a list is inside its range."""
    low, high = each.low, each.high

    def all_inside(frame: bytes) -> bool:
        values = numbers(frame)
        return not values or (low <= min(values) and max(values) <= high)

    return all_inside


def element_test(places: Sequence[Place], listed: slice, size: int) -> Callable[[bytes], bool]:
    """Return a function that says whether all is right in the elements of a list."""

    def all_right(frame: bytes) -> bool:
        data = frame[listed]
        for base in range(0, len(data), size):
            for start, end, due in places:
                found = data[base + start : base + end]
                if found != due if isinstance(due, bytes) else due(found) is not None:
                    return False
        return True

    return all_right


def together(tests: Sequence[Callable[[bytes], bool]]) -> Callable[[bytes], bool] | None:
    """Return a function that says whether all tests hold; None where there are none."""
    if len(tests) < 2:
        return tests[0] if tests else None
    if len(tests) == 2:
        first, second = tests
        return lambda frame: first(frame) and second(frame)
    return lambda frame: all(holds(frame) for holds in tests)
