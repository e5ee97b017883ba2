"""The options of the line of any simulator: what each of them becomes."""

from __future__ import annotations

from dataclasses import fields, replace
from typing import Any

from busservo_simulator import Faults
from busservo_simulator.cli import SIMULATOR
from busservo_simulator.faults import CHANCES
from framewire.simulator.line_options import line_of

from tests.in_turn import in_turn


def line(words: str) -> Any:
    """Return the line that arguments choose."""
    return line_of(SIMULATOR.parser().parse_args(words.split()), Faults)


@in_turn("name", lambda: [each.name for each in fields(Faults)])
def test_every_field_of_the_faults_is_reached(name: str) -> None:
    value = 7 if name == "seed" else 0.125
    words = f"--fault {name}={value}" if name in CHANCES else f"--{name.replace('_', '-')} {value}"
    assert line(words)["faults"] == replace(Faults(), **{name: value})  # type: ignore[arg-type]


@in_turn("words, pace", lambda: [("", 9600), ("--baud 96000", 96000), ("--baud inf", None)])
def test_the_line_is_as_slow_as_the_real_one_unless_told_otherwise(
    words: str, pace: float | None
) -> None:
    assert line(words)["baud"] == pace
