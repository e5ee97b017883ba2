"""Captures of every protocol, cut at safe places: the pieces hold the events of the whole."""

from importlib import import_module
from itertools import pairwise
from types import ModuleType
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.protocols.conftest import libraries
from tests.protocols.libraries import Libraries, direction_of
from tests.protocols.specs import FILES, model_of
from tests.protocols.streams import frames, lines, sent

__all__ = ["libraries"]


def events(made: ModuleType, direction: Any, data: bytes) -> list[tuple[Any, ...]]:
    """Return the events of a decoder, with neighbouring noise joined."""
    decoder = made.StreamDecoder(direction)
    found: list[tuple[Any, ...]] = []
    for event in [*decoder.feed(data), *decoder.flush()]:
        if type(event) is made.Noise and found and found[-1][:2] == (made.Noise, event.reason):
            found[-1] = (made.Noise, event.reason, found[-1][2] + event.data)
        elif isinstance(event, made.Noise):
            found.append((type(event), event.reason, event.data))
        else:
            found.append((type(event), None, event.encode()))
    return found


@pytest.mark.parametrize("name", FILES)
@given(data=st.data())
def test_the_pieces_have_the_events_of_the_whole(
    libraries: Libraries, name: str, data: st.DataObject
) -> None:
    made = libraries[name]
    tables: Any = import_module(f"{made.__name__}.tables")
    ways = [way for way in model_of(name).directions if sent(name, way)]
    pieces = [strategy(name, way) for way in ways for strategy in (lines, frames)]
    parts = data.draw(st.lists(st.one_of(pieces), max_size=8))
    capture = b"".join(parts) * data.draw(st.sampled_from([1, 1, 5]))
    direction = data.draw(st.sampled_from([None, *(direction_of(made, way) for way in ways)]))
    places = tables.safe_cuts(capture, data.draw(st.sampled_from([1, 40])), direction=direction)
    found = [
        event
        for start, end in pairwise([0, *places, len(capture)])
        for event in events(made, direction, capture[start:end])
    ]
    assert found == events(made, direction, capture)
