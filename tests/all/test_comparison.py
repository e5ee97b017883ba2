"""Editions of every spec, one to three mutations apart: the verdict is how the libraries talk."""

from __future__ import annotations

from contextlib import ExitStack

import pytest
from framegen.comparison.pair import Pair
from hypothesis import given
from hypothesis import strategies as st

from tests.comparison import proof
from tests.comparison.authors import marked
from tests.comparison.mutations import MUTATIONS, SPECS, Editions, after, after_data, editions
from tests.comparison.talks import Talk
from tests.comparison.word_mutations import WORD_MUTATIONS
from tests.few_each import few_each
from tests.protocols.specs import values_for
from tests.random_specs import specs

# All of a mutation in every spec would be a day.
SEEDS = range(2)
# Each of these has many frames, or long ones: one seed is enough.
LARGE = {"everything", "ubx", "modbus", "lxservo", "busservo"}


def all_hold(editions: Editions) -> None:
    with ExitStack() as until:
        talk = Talk(editions, until)
        proof.assert_each_frame_is_judged_right(talk)
        proof.assert_witnesses_show_it(talk)
        proof.assert_no_frame_is_lost(talk)
        proof.assert_mirrored(editions)


@pytest.mark.parametrize("spec", SPECS)
@pytest.mark.parametrize("name", MUTATIONS)
def test_a_mutation_is_judged_right_both_ways(spec: str, name: str) -> None:
    seeds = SEEDS[:1] if spec in LARGE else SEEDS
    for made in (after(spec, [name], seed) for seed in seeds):
        if made is not None:
            all_hold(made)
            all_hold(made.turned)


@pytest.mark.parametrize("spec", SPECS)
@few_each
@given(data=st.data())
def test_several_at_once_are_judged_right(spec: str, data: st.DataObject) -> None:
    all_hold(data.draw(editions(spec)))


@pytest.mark.parametrize("spec", SPECS)
@few_each
@given(data=st.data())
def test_no_frame_becomes_worse_than_the_worst_that_was_tried(
    spec: str, data: st.DataObject
) -> None:
    with ExitStack() as until:
        talk = Talk(data.draw(editions(spec)), until)
        drawn = (
            (oracle, trial, [data.draw(values_for(trial.message, few=True)) for _ in range(3)])
            for oracle, trial in talk.trials()
        )
        proof.assert_nothing_is_worse_than_its_verdict(talk, drawn)


@given(specs(), st.lists(st.sampled_from([*MUTATIONS]), min_size=1, max_size=3), st.integers(0, 99))
def test_random_specs_are_judged_right(
    spec: dict[str, object], names: list[str], seed: int
) -> None:
    made = after_data(spec, names, seed)
    if made is not None:
        all_hold(made)


@pytest.mark.parametrize("spec", SPECS)
@pytest.mark.parametrize("name", WORD_MUTATIONS)
def test_words_change_nothing_but_docstrings(spec: str, name: str) -> None:
    made = after(spec, [name])
    if made is not None:
        proof.assert_no_effect(Pair(made.old, made.new))
        proof.assert_same_code(made.old, made.new)


@pytest.mark.parametrize("name", MUTATIONS)
def test_each_mutation_has_a_place_in_some_spec(name: str) -> None:
    found = (after(spec, [name], seed) for spec in SPECS for seed in range(4))
    assert any(each is not None for each in found)


def test_marks_are_no_part_of_a_spec() -> None:
    made = after("lamp", ["words: the title"])
    assert made is not None
    assert "#" not in repr(made.new.compiled.tree.data)
    assert "#" in repr(marked(made.new.compiled.tree.data))
