"""Ends of two editions that talk: each mutation of some spec, and what is said of its exchanges."""

import pytest
from framegen.comparison.pair import Pair
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.comparison import conversations
from tests.contract.comparison.conversation_cases import CASES
from tests.contract.comparison.ends import differing, ends_of
from tests.mutations.edits import pair_of
from tests.mutations.mutations import MUTATIONS, editions, places

SPECS = ("lxservo", "dynamixel1", "modbus", "visca", "msp", "roboclaw", "ubx")


@pytest.mark.parametrize("mutation", MUTATIONS)
def test_generated_ends_see_what_is_said_after_a_mutation(
    mutation: str, pytestconfig: pytest.Config
) -> None:
    made = next(places(mutation, int(pytestconfig.option.seed)))
    pair = Pair(made.old, made.new)
    with ends_of(pair) as ends:
        assert differing(ends) == []
    conversations.assert_mirrored(pair)


@pytest.mark.parametrize("name", CASES)
def test_generated_ends_see_what_is_said_of_a_case(name: str) -> None:
    if name != "both ends ask":
        with ends_of(pair_of(CASES[name].old, CASES[name].new)) as ends:
            assert differing(ends) == []


@pytest.mark.parametrize("name", CASES)
def test_the_way_back_of_a_case_mirrors_the_way_there(name: str) -> None:
    conversations.assert_mirrored(pair_of(CASES[name].old, CASES[name].new))


@given(st.data())
def test_values_beyond_the_edges_end_no_worse(data: st.DataObject) -> None:
    made = data.draw(editions(data.draw(st.sampled_from(SPECS))))
    conversations.assert_nothing_ends_worse(Pair(made.old, made.new), data)
