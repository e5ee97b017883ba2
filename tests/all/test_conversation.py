"""Ends of two editions that talk: each mutation of each spec, and what is said of its exchanges."""

from __future__ import annotations

import pytest
from framegen.comparison.pair import Pair

from tests.comparison.conversation_cases import CASES
from tests.comparison.edits import pair_of
from tests.comparison.ends import differing, ends_of
from tests.comparison.mutations import MUTATIONS, after

SPECS = ("busservo", "lxservo", "dynamixel1", "modbus", "visca", "msp", "roboclaw", "learm", "ubx")


@pytest.mark.parametrize("spec", SPECS)
@pytest.mark.parametrize("mutation", MUTATIONS)
def test_generated_ends_see_what_is_said_after_a_mutation(spec: str, mutation: str) -> None:
    made = after(spec, [mutation])
    if made is None:
        pytest.skip("nothing in this spec can be changed so")
    with ends_of(Pair(made.old, made.new)) as ends:
        assert differing(ends) == []


@pytest.mark.parametrize("name", CASES)
def test_generated_ends_see_what_is_said_of_a_case(name: str) -> None:
    with ends_of(pair_of(CASES[name].old, CASES[name].new)) as ends:
        assert differing(ends) == []
