"""The faults of a line: what is no chance, and no length of time."""

from __future__ import annotations

import pytest
from busservo_simulator import Faults
from busservo_simulator.faults import CHANCES, DURATIONS

from tests.in_turn import in_turn


@in_turn(
    "name, value",
    lambda: [
        *((name, value) for name in CHANCES for value in (-0.1, 1.1, float("nan"))),
        *((name, value) for name in DURATIONS for value in (-0.1, float("inf"), float("nan"))),
    ],
)
def test_what_cannot_be_is_refused_by_its_name(name: str, value: float) -> None:
    with pytest.raises(ValueError, match=f"^{name} is {value}: "):
        Faults(**{name: value})  # type: ignore[arg-type]
