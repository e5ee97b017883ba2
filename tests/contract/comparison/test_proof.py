"""What a comparison says of the wire is how the two generated libraries really talk: a sample.

All mutations of all specs are in tests/world/test_comparison.py.
"""

from collections.abc import Iterator
from contextlib import ExitStack

import pytest
from framegen.comparison.pair import Pair
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.contract.comparison import proof
from tests.contract.comparison.talks import Talk
from tests.in_turn import in_turn
from tests.mutations.mutations import Editions, after
from tests.mutations.word_mutations import WORD_MUTATIONS
from tests.protocols.specs import values_for

# Small specs, and a mutation or two of each kind.
SAMPLE = (
    ("lamp", ("u8 became u16",)),
    ("lamp", ("a message renamed, unsaid", "a byte added in end")),
    ("tfmini", ("neighbouring fields swapped",)),
    ("sbus", ("bits: one renamed, unsaid",)),
    ("roboclaw", ("ids of messages swapped",)),
    ("weather", ("a field renamed, said", "range: documented")),
    ("blinds", ("a list is counted by the frame",)),
    ("mhz19", ("a named value moved",)),
    ("demo", ("an end renamed", "a list is sized by what counted it")),
)


def made(spec: str, names: tuple[str, ...]) -> Editions:
    """Return what mutations make of a spec, with the first seed that has a place for them."""
    found = (after(spec, names, seed) for seed in range(20))
    return next(each for each in found if each is not None)


@pytest.fixture(scope="module", params=SAMPLE, ids=lambda each: f"{each[0]}: {', '.join(each[1])}")
def talk(request: pytest.FixtureRequest) -> Iterator[Talk]:
    with ExitStack() as until:
        yield Talk(made(*request.param), until)


def test_each_frame_is_judged_by_what_the_libraries_make_of_it(talk: Talk) -> None:
    proof.assert_each_frame_is_judged_right(talk)


def test_each_witness_shows_what_it_claims(talk: Talk) -> None:
    proof.assert_witnesses_show_it(talk)


@given(data=st.data())
@settings(max_examples=3)
def test_no_frame_becomes_worse_than_the_worst_one_tried(talk: Talk, data: st.DataObject) -> None:
    drawn = (
        (oracle, trial, tried, [data.draw(values_for(trial.message, few=True))])
        for oracle, trial, tried in talk.trials()
    )
    proof.assert_nothing_is_worse_than_its_verdict(drawn)


def test_what_both_editions_understand_is_heard_on_one_line(talk: Talk) -> None:
    proof.assert_no_frame_is_lost(talk)


def test_the_way_back_mirrors_the_way_there(talk: Talk) -> None:
    proof.assert_mirrored(talk)


@pytest.mark.parametrize("spec", ["lamp", "tfmini"])
def test_an_edition_is_the_same_as_itself(spec: str) -> None:
    editions = made(spec, ("words: the title",))
    proof.assert_no_effect(Pair(editions.old, editions.old))


@in_turn("name", lambda: WORD_MUTATIONS)
def test_words_change_nothing_but_docstrings(name: str) -> None:
    editions = made("mhz19", (name,))
    proof.assert_no_effect(Pair(editions.old, editions.new))
    proof.assert_same_code(editions.old, editions.new)


def test_other_code_is_seen() -> None:
    editions = made("mhz19", ("range: narrower above",))
    proof.assert_other_code(editions.old, editions.new)
