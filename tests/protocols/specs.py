"""The protocols that are written down here, and what their messages may carry."""

from functools import cache
from pathlib import Path
from typing import Any

from framegen.model.layout import MessageLayout
from framegen.model.model import Model
from framegen.model.slots import Field, Items, Number, Packed, Text
from hypothesis import strategies as st

from tests.factories import compiled_file
from tests.guide_specs import file_of
from tests.protocols.peer import Values

FOLDER = Path(__file__).parent
FILES = {file.stem: file for file in sorted(FOLDER.glob("*.yaml"))}
# The one that ships.
FILES["lxservo"] = FOLDER.parents[1] / "spec" / "lxservo.yaml"
# What somebody speaks.
SPOKEN = tuple(FILES)
# Nobody speaks it: it has every kind of part and field.
FILES["everything"] = FOLDER.parent / "specs" / "everything.yaml"
# One kind of its frames may begin as another, by its checksum.
FILES["gauges"] = file_of("gauges")
# Elements of a list that is drawn; one of the largest size is drawn apart.
FEW = 5


def model_of(name: str) -> Model:
    """Return the model of a protocol, by the name of its file."""
    return compiled_file(FILES[name]).model


@cache
def messages_of(name: str) -> dict[str, MessageLayout]:
    """Return the layouts of a protocol, by name."""
    return model_of(name).messages


@cache
def values_of(name: str, message: str, *, few: bool = False) -> st.SearchStrategy[Values]:
    """Return a strategy for values that a frame of a message can carry, `few` in each list."""
    return values_for(messages_of(name)[message], few=few)


def values_for(layout: MessageLayout, *, few: bool = False) -> st.SearchStrategy[Values]:
    """Return a strategy for values that a frame with this layout can carry, `few` in each list."""
    whole = _in_order({slot.name: _values(slot, few) for slot in layout.arguments})
    if not layout.optional:
        return whole
    absent = [
        {slot.name: None for slot in layout.optional if slot not in layout.there(count)}
        for count in layout.counts
    ]
    return st.builds(lambda values, gone: values | gone, whole, st.sampled_from(absent))


def _values(slot: Field, few: bool = False) -> st.SearchStrategy[Any]:
    match slot:
        case Number():
            return _numbers(slot)
        case Text():
            return _texts(slot.size)
        case Packed():
            number = st.integers(slot.low, slot.high)
            return st.lists(number, min_size=slot.count, max_size=slot.count)
        case Items():
            return _lists(slot, few)


def _in_order(drawn: dict[str, st.SearchStrategy[Any]]) -> st.SearchStrategy[Values]:
    """Return a strategy for values in the order of the frame, which Hypothesis shuffles."""
    return st.fixed_dictionaries(drawn).map(lambda values: {name: values[name] for name in drawn})


def _lists(items: Items, few: bool) -> st.SearchStrategy[Any]:
    most = max(items.low, min(items.high, FEW))
    if items.text is not None:
        return _texts(most).filter(lambda text: len(text) >= items.low)
    element: st.SearchStrategy[Any] = (
        _values(items.fields[0])
        if items.element is None
        else _in_order({field.name: _values(field) for field in items.fields})
    )
    some = st.lists(element, min_size=items.low, max_size=most)
    return some if few else some | st.builds(lambda one: [one] * items.high, element)


def _numbers(number: Number) -> st.SearchStrategy[Any]:
    if number.is_float:
        return st.floats(width=32 if number.size == 4 else 64, allow_nan=False)
    return st.integers(number.low, number.high)


def _texts(longest: int) -> st.SearchStrategy[str]:
    """Return texts that do not end with a zero, which is padding where the size is fixed."""
    characters = st.characters(min_codepoint=0, max_codepoint=127)
    return st.text(characters, max_size=longest).filter(lambda text: not text.endswith("\0"))
