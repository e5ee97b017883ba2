"""Deprecated messages warn at the line that makes them, and not where they are read."""

import copy
import inspect
import pickle
import warnings
from collections.abc import Callable, Iterator
from importlib import import_module
from types import ModuleType
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from tests.factories import DEMO, data_of, files_of, library
from tests.lines.timed_line import TimedLine, client_on
from tests.mutations.places import having

TEXT = "Vents open by themselves since 2024."
SAID = f"VentsOpen is deprecated: {TEXT}"


@pytest.fixture(scope="module")
def old() -> Iterator[ModuleType]:
    """A library with a deprecated command that its client sends, and one that others send."""
    data = having(data_of(DEMO), {"messages.VentsOpen.deprecated": TEXT})
    with library(files_of(data)) as made:
        yield made


def sent_by_a_method(old: ModuleType) -> object:
    with client_on(TimedLine(), old.Controller) as controller:
        return controller.vents_open([(1, 0)], ramp_s=1)


MAKING: dict[str, Callable[[ModuleType], object]] = {
    "made": lambda old: old.VentsOpen(1, [(1, 0)]),
    "from plain data": lambda old: old.VentsOpen.from_dict({"ramp_s": 1, "vents": [(1, 0)]}),
    "sent by a method": sent_by_a_method,
}


@pytest.mark.parametrize("how", MAKING)
def test_making_a_deprecated_message_warns_at_the_callers_line(old: ModuleType, how: str) -> None:
    with pytest.warns(DeprecationWarning, match=TEXT) as caught:
        MAKING[how](old)
    (warning,) = caught
    assert str(warning.message) == SAID
    assert warning.filename == __file__
    lines, first = inspect.getsourcelines(MAKING[how])
    assert first <= warning.lineno < first + len(lines)


def test_reading_a_deprecated_message_does_not_warn(old: ModuleType) -> None:
    with pytest.warns(DeprecationWarning, match=TEXT):
        message = old.VentsOpen(1, [(1, 0)])
    frame = message.encode()
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert old.decode(frame, message.DIRECTION) == message
        assert old.StreamDecoder(message.DIRECTION).feed(frame) == [message]
        assert type(message).decode(frame) == message
        assert pickle.loads(pickle.dumps(message)) == copy.copy(message) == message  # noqa: S301
        assert message.to_dict() == {"ramp_s": 1, "vents": [{"vent_id": 1, "angle": 0}]}


def test_what_is_not_deprecated_does_not_warn(old: ModuleType) -> None:
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        old.VentJammed(1, 0)
    named = {kind.__name__: kind.DEPRECATED for kind in old.MESSAGES if kind.DEPRECATED}
    assert named == {
        "VentsOpen": TEXT,
        "TextShow": "The display reads the bus by itself since 2024.",
    }


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=5)
@given(data=st.data())
def test_strategies_make_a_deprecated_message_without_a_warning(old: ModuleType, data: Any) -> None:
    strategies = import_module(f"{old.__name__}.strategies")
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert type(data.draw(strategies.vents_open())) is old.VentsOpen
