"""The entry of a version in the history: what users notice first, of words no more than a few."""

import pytest
from framegen.comparison.comparison import Comparison
from framegen.comparison.entry import sentences

from tests.bad_specs import BASES
from tests.factories import DEMO, Data, data_of
from tests.mutations.edits import edition
from tests.mutations.places import having, renamed

OLD = data_of(DEMO)


def told(old: Data, new: Data, *, examples: bool = True) -> list[str]:
    return sentences(Comparison(edition(old), edition(new)), examples=examples)


def test_the_version_and_its_history_are_no_changes() -> None:
    history = [{"version": "2.0.0", "changes": ["More."]}, *OLD["history"]]
    assert told(OLD, having(OLD, {"history": history, "protocol.version": "2.0.0"})) == []


def test_a_few_changes_of_words_are_told_and_many_are_counted() -> None:
    (one,) = told(OLD, having(OLD, {"protocol.title": "A hothouse"}))
    assert one.endswith(".")
    book = {"title": "A book", "kind": "document"}
    many = having(OLD, {f"sources.book_{number}": book for number in range(4)})
    assert told(OLD, many) == ["4 changes of words, sources or examples."]


def test_examples_follow_what_changed_unless_nothing_else_did() -> None:
    frame = OLD["messages"]["VentsOpen"]["examples"][0]["hex"]
    new = having(OLD, {"messages.VentsOpen.examples.0.hex": f"{frame[:-2]}77"})
    (alone,) = told(OLD, new, examples=False)
    assert "VentsOpen.examples[0]" in alone
    both = having(new, {"protocol.title": "A hothouse"})
    assert [alone in told(OLD, both, examples=each) for each in (True, False)] == [True, False]


def test_a_deprecation_is_told_with_its_reason_before_mere_words() -> None:
    why = {"messages.VentsOpen.deprecated": "VentsMove is smoother."}
    first, words = told(OLD, having(OLD, {**why, "protocol.title": "A hothouse"}))
    assert first == "VentsOpen is deprecated now: VentsMove is smoother."
    assert "VentsOpen" not in words


LAMPS = data_of(BASES / "lamps.yaml")


@pytest.mark.parametrize("words", [{}, {"protocol.summary": "Lamps."}])
def test_what_users_notice_comes_first(words: dict[str, str]) -> None:
    count = {"messages.LampsSet.fields.lamps.count": "1..6"}
    first, *others = told(LAMPS, having(LAMPS, count | words))
    assert "lamps" in first
    assert "8" in first
    assert len(others) == len(words)


def test_a_name_that_may_have_changed_is_gone_and_the_other_new() -> None:
    found = told(LAMPS, renamed(LAMPS, "LampRead", "LampAsk"))
    assert found[0] == "LampRead is gone, and LampAsk is new."
    assert "may be" not in " ".join(found)
