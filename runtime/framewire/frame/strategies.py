"""Any message, and any noise, for Hypothesis: what the strategies are made of."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING
from warnings import catch_warnings, simplefilter

from hypothesis import strategies as st

from .floating import Float
from .lists import List
from .optional import Optional
from .packed import Packed
from .text import Text

if TYPE_CHECKING:
    from collections.abc import Callable
    from typing import Any, TypeVar

    from hypothesis.strategies import SearchStrategy

    from .heads import Heads
    from .message import Message

    Kind = TypeVar("Kind", bound=Message)


def any_noise(heads: Heads, max_size: int) -> SearchStrategy[bytes]:
    """Generate bytes without a complete header of those frames that have one."""
    headers = [envelope.header for envelope in heads.envelopes if envelope.header]
    return st.binary(min_size=1, max_size=max_size).filter(
        lambda data: not any(header in data for header in headers)
    )


def any_of(kind: type[Kind], *, allow_nan: bool = False) -> SearchStrategy[Kind]:
    """Generate any message of a class, with any legal values of its fields."""
    fields = {name: getattr(kind, name) for name in kind.__match_args__}
    make: Callable[..., Kind] = partial(_quietly, kind) if kind.DEPRECATED else kind
    absent = [each.name for each in kind.SHAPE.optional]
    return st.one_of(
        [
            st.builds(
                make,
                **{
                    name: _value(field, allow_nan=allow_nan)
                    for name, field in fields.items()
                    if name not in absent[present:]
                },
            )
            for present in kind.SHAPE.present or [0]
        ]
    )


def _quietly(kind: type[Kind], /, **fields: Any) -> Kind:
    """Return a deprecated message, without the warning: it is still to be read."""
    with catch_warnings():
        simplefilter("ignore", DeprecationWarning)
        return kind(**fields)


def _value(field: Any, *, allow_nan: bool) -> SearchStrategy[Any]:
    """Generate any value of a field: what its type and its range allow."""
    if isinstance(field, Optional):
        return _value(field.number, allow_nan=allow_nan)
    if isinstance(field, Float):
        width: Any = 8 * field.struct.size
        return st.floats(width=width, allow_nan=allow_nan)
    if isinstance(field, Text):
        # Zeros at the end are no part of a text with room for more.
        lowest = 1 if field.least is None else 0
        characters = st.characters(min_codepoint=lowest, max_codepoint=0x7F)
        return st.text(characters, min_size=field.least or 0, max_size=field.most)
    if isinstance(field, Packed):
        numbers = st.integers(field.low, field.high)
        return st.lists(numbers, min_size=field.length, max_size=field.length)
    if isinstance(field, List):
        values = [_value(each, allow_nan=allow_nan) for each in field.fields]
        elements = st.tuples(*values) if field.element else values[0]
        return st.lists(elements, min_size=field.counts[0], max_size=field.counts[-1])
    whole = st.integers(field.low, field.high)
    return whole | st.sampled_from(field.others) if field.others else whole
