"""Any message, and any noise, for Hypothesis: what the strategies are made of."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING
from warnings import catch_warnings, simplefilter

from hypothesis import strategies as st

from .number import Number
from .protocol import HEADER

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeVar

    from hypothesis.strategies import SearchStrategy

    from .items import Items
    from .message import Message

    Kind = TypeVar("Kind", bound=Message)


def any_noise(max_size: int) -> SearchStrategy[bytes]:
    """Generate bytes without a complete header."""
    return st.binary(min_size=1, max_size=max_size).filter(lambda data: HEADER not in data)


def any_of(kind: type[Kind]) -> SearchStrategy[Kind]:
    """Generate any message of a class, with any legal values of its fields."""
    fields = {name: getattr(kind, name) for name in kind.__match_args__}
    make: Callable[..., Kind] = partial(_quietly, kind) if kind.DEPRECATED else kind
    return st.builds(make, **{name: _value(field) for name, field in fields.items()})


def _quietly(kind: type[Kind], /, **fields: Any) -> Kind:
    """Return a deprecated message, without the warning: it is still to be read."""
    with catch_warnings():
        simplefilter("ignore", DeprecationWarning)
        return kind(**fields)


def _value(field: Number | Items[Any]) -> SearchStrategy[Any]:
    """Generate any value of a field: a number in its range, or a list of legal length."""
    if isinstance(field, Number):
        return st.integers(field.low, field.high)
    numbers = [_value(number) for number in field.fields]
    elements = st.tuples(*numbers) if field.element else numbers[0]
    return st.lists(elements, min_size=field.counts[0], max_size=field.counts[-1])
