"""The entry of a version in the history: what users notice first, of words no more than a few."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest
from framegen.comparison.comparison import Comparison
from framegen.comparison.entry import sentences

from tests.bad_specs import base
from tests.factories import DEMO, data_in, data_of
from tests.mutations.edits import edition
from tests.mutations.places import having
from tests.mutations.spec_edits import edited

if TYPE_CHECKING:
    from framegen.comparison.edition import Edition

OLD = data_of(DEMO)


def lamps(text: str) -> Edition:
    return edition(data_in(text))


def told(**changes: str) -> list[str]:
    new = {**OLD, "protocol": {**OLD["protocol"], **changes}}
    return sentences(Comparison(edition(OLD), edition(new)))


def test_the_version_and_its_history_are_no_changes() -> None:
    new = {**OLD, "history": [{"version": "2.0.0", "changes": ["More."]}, *OLD["history"]]}
    new["protocol"] = {**OLD["protocol"], "version": "2.0.0"}
    assert sentences(Comparison(edition(OLD), edition(new))) == []


def test_a_few_changes_of_words_are_told_and_many_are_counted() -> None:
    one = told(title="A hothouse")
    assert len(one) == 1
    assert one[0].endswith(".")
    many = {**OLD, "sources": {**OLD["sources"]}}
    for number in range(4):
        many["sources"][f"book_{number}"] = {"title": "A book", "kind": "document"}
    assert sentences(Comparison(edition(OLD), edition(many))) == [
        "4 changes of words, sources or examples."
    ]


def test_examples_follow_what_changed_unless_nothing_else_did() -> None:
    frame = OLD["messages"]["VentsOpen"]["examples"][0]["hex"]
    new = having(OLD, {"messages.VentsOpen.examples.0.hex": f"{frame[:-2]}77"})
    alone = sentences(Comparison(edition(OLD), edition(new)), examples=False)
    assert len(alone) == 1
    assert "VentsOpen.examples[0]" in alone[0]
    comparison = Comparison(edition(OLD), edition(having(new, {"protocol.title": "A hothouse"})))
    assert [alone[0] in sentences(comparison, examples=each) for each in (True, False)] == [
        True,
        False,
    ]


def test_a_deprecation_is_told_with_its_reason_before_mere_words() -> None:
    why = {"messages.VentsOpen.deprecated": "VentsMove is smoother."}
    new = having(OLD, {**why, "protocol.title": "A hothouse"})
    first, words = sentences(Comparison(edition(OLD), edition(new)))
    assert first == "VentsOpen is deprecated now: VentsMove is smoother."
    assert "VentsOpen" not in words


@pytest.mark.parametrize("words", [[], [("summary: Lamps on a line.", "summary: Lamps.")]])
def test_what_users_notice_comes_first(words: list[tuple[str, str]]) -> None:
    text = base("lamps")
    for old, new in words:
        text = edited(text, {"replace": old, "with": new})
    text = edited(text, {"replace": "count: 1..8", "with": "count: 1..6"})
    found = sentences(Comparison(lamps(base("lamps")), lamps(text)))
    assert "lamps" in found[0]
    assert "8" in found[0]
    assert len(found) == 1 + len(words)


def test_a_name_that_may_have_changed_is_gone_and_the_other_new() -> None:
    text = base("lamps").replace("LampRead", "LampAsk")
    found = sentences(Comparison(lamps(base("lamps")), lamps(text)))
    assert found[0] == "LampRead is gone, and LampAsk is new."
    assert "may be" not in " ".join(found)
