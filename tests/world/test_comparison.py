"""Editions of every spec, one to three mutations apart: the verdict is how the libraries talk."""

from contextlib import ExitStack
from itertools import islice

import pytest
from framegen.comparison.pair import Pair
from hypothesis import given
from hypothesis import strategies as st

from tests.contract.comparison import proof
from tests.contract.comparison.talks import Talk
from tests.mutations.authors import marked
from tests.mutations.mutations import (
    MUTATIONS,
    SPECS,
    Editions,
    after,
    after_data,
    editions,
    places,
)
from tests.mutations.word_mutations import WORD_MUTATIONS
from tests.protocols.specs import values_for
from tests.random_specs import specs

# Words are changed in so many of the specs in which they have a place.
SOME = 4


@pytest.fixture
def day(pytestconfig: pytest.Config) -> int:
    """The seed by which a mutation is tried on one of the specs that have a place for it."""
    return int(pytestconfig.option.seed)


def all_hold(editions: Editions) -> None:
    with ExitStack() as until:
        talk = Talk(editions, until)
        proof.assert_each_frame_is_judged_right(talk)
        proof.assert_witnesses_show_it(talk)
        proof.assert_no_frame_is_lost(talk)
        proof.assert_mirrored(talk)
        proof.assert_words_alone_change_no_code(talk.pair)


@pytest.mark.parametrize("name", MUTATIONS)
def test_a_mutation_is_judged_right(name: str, day: int) -> None:
    all_hold(next(places(name, day)))


@given(st.data())
def test_several_at_once_are_judged_right(data: st.DataObject) -> None:
    all_hold(data.draw(editions(data.draw(st.sampled_from([*SPECS])))))


@given(st.data())
def test_no_frame_becomes_worse_than_the_worst_one_tried(data: st.DataObject) -> None:
    spec = data.draw(st.sampled_from([*SPECS]))
    with ExitStack() as until:
        talk = Talk(data.draw(editions(spec)), until)
        drawn = (
            (oracle, trial, tried, [data.draw(values_for(trial.message, few=True))])
            for oracle, trial, tried in talk.trials()
        )
        proof.assert_nothing_is_worse_than_its_verdict(drawn)


@given(specs(), st.lists(st.sampled_from([*MUTATIONS]), min_size=1, max_size=3), st.integers(0, 99))
def test_random_specs_are_judged_right(
    spec: dict[str, object], names: list[str], seed: int
) -> None:
    made = after_data(spec, names, seed)
    if made is not None:
        all_hold(made)


@pytest.mark.parametrize("name", WORD_MUTATIONS)
def test_words_change_nothing_but_docstrings(name: str, day: int) -> None:
    for made in islice(places(name, day), SOME):
        proof.assert_no_effect(Pair(made.old, made.new))
        proof.assert_same_code(made.old, made.new)


def test_marks_are_no_part_of_a_spec() -> None:
    made = after("lamp", ["words: the title"])
    assert made is not None
    assert "#" not in repr(made.new.compiled.tree.data)
    assert "#" in repr(marked(made.new.compiled.tree.data))
