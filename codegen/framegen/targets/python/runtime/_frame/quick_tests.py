"""Quick tests, made once for each class of messages: they are in the way of each one."""

from __future__ import annotations

from struct import Struct

from .protocol import STRUCT_ORDER

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from typing import Any

    from .floating import Float
    from .lists import Place
    from .number import Number


def checker(fields: Sequence[Number | Float]) -> Callable[..., None]:
    """Return a function that raises EncodeError for the first wrong one of the numbers given.

    Good ones are passed over. Any others are looked at one by one, and are either numbers of
    another kind, such as NumPy's, or explained.
    """
    lows, highs = [field.low for field in fields], [field.high for field in fields]
    kinds = [float if isinstance(field.low, float) else int for field in fields]

    def explain(numbers: tuple[Any, ...]) -> None:
        for field, number in zip(fields, numbers, strict=True):
            field.checked(number, field.name)

    def check_all(*numbers: Any) -> None:
        for number, kind, low, high in zip(numbers, kinds, lows, highs, strict=False):
            if type(number) is not kind or not low <= number <= high:
                return explain(numbers)
        return None

    def check(*numbers: Any) -> None:
        for number, low, high in zip(numbers, lows, highs):
            if type(number) is not int or number < low or number > high:
                return explain(numbers)
        return None

    return check if set(kinds) == {int} else check_all


def range_test(numbers: Sequence[Number]) -> Callable[[bytes], bool]:
    """Return a function that says whether all these numbers of a frame are inside their ranges."""
    at = 0
    layout = STRUCT_ORDER
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
    lows, highs = [number.low for number in numbers], [number.high for number in numbers]

    def all_inside(frame: bytes) -> bool:
        for value, low, high in zip(unpack(frame), lows, highs):
            if value < low or value > high:
                return False
        return True

    return all_inside


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


def count_test(
    counters: Sequence[tuple[Number, int]], around: int, unit: int
) -> Callable[[bytes], bool]:
    """Return a function that says whether all counters of a list are right.

    Each counts an element as a number of its own. An element has `unit` bytes, and `around` ones of
    the frame are not of the list.
    """
    counted = [(number.struct.unpack_from, number.at, factor) for number, factor in counters]

    def all_agree(frame: bytes) -> bool:
        count = (len(frame) - around) // unit
        return all(unpack(frame, at)[0] == count * factor for unpack, at, factor in counted)

    return all_agree


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
