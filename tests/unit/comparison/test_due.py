"""Which bump of the version is due, what is said of a version that does not have it, and its entry.

The entry in the history tells what users notice first, and of words no more than a few.
"""

from itertools import product

import pytest
from framegen.comparison.changes.change import Change
from framegen.comparison.comparison import Comparison
from framegen.comparison.due import Bump, due, next_version, version_finding
from framegen.comparison.effect import Effect
from framegen.comparison.entry import sentences
from framegen.language.version import STAGES, Version
from hypothesis import given
from hypothesis import strategies as st

from tests.bad_specs import BASES
from tests.factories import DEMO, Data, data_of
from tests.in_turn import in_turn
from tests.mutations.edits import edition
from tests.mutations.places import having, renamed

HERE = ("messages", "LampFade")
BREAKS = Effect("wire", "refused", HERE, HERE, "it is refused")
ACCEPTED = Effect("wire", "refused", HERE, HERE, "it is refused", accepted="No lamp has it.")
UNCERTAIN = Effect("wire", "uncertain", HERE, HERE, "it may be another one", certain=False)
ADDS = Effect("programs", "added", None, HERE, "it is new", breaks=False)
WORDS = Change("about", HERE, HERE, "LampFade is described otherwise")
DEPRECATED = Change("message-deprecated", HERE, HERE, "LampFade is deprecated now: It is slow.")
IS_NEW, WORDED = "something is new or deprecated", "something is worded otherwise"
BROKEN, LOW = "something breaks", ", so the version {} is too low:"
STILL = ", and the version is still that: "
VERSION = Change("version", ("protocol", "version"), ("protocol", "version"), "1.0.0 became 1.1.0")
TOLD = Change("history", None, ("history", 0), "1.1.0 is told of")


@in_turn(
    "effects, changes, bump",
    lambda: [
        *(([], [], None), ([], [VERSION, TOLD], None), ([], [VERSION, WORDS], "patch")),
        *(([], [DEPRECATED, WORDS], "minor"), ([BREAKS], [DEPRECATED], "major")),
        *(([ADDS], [], "minor"), ([ADDS], [WORDS], "minor"), ([ADDS, BREAKS], [WORDS], "major")),
        *(([ACCEPTED], [], "major"), ([UNCERTAIN, ADDS], [], "major")),
    ],
)
def test_the_worst_decides(effects: list[Effect], changes: list[Change], bump: Bump | None) -> None:
    assert due(effects, changes) == bump
    assert due(effects[::-1], changes[::-1]) == bump


@in_turn(
    "old, bump, new",
    lambda: [
        *(("1.2.3", "patch", "1.2.4"), ("1.2.3", "minor", "1.3.0"), ("1.2.3", "major", "2.0.0")),
        *(("0.2.3", "patch", "0.2.4"), ("0.2.3", "minor", "0.3.0"), ("0.2.3", "major", "0.3.0")),
        *(("2.0.0-rc.1", "patch", "2.0.0"), ("2.0.0-rc.1", "major", "2.0.0")),
    ],
)
def test_a_bump_leads_to_a_version(old: str, bump: Bump, new: str) -> None:
    assert next_version(old, bump) == new


@in_turn(
    "old, new, bump, finding",
    lambda: [
        ("1.0.0", "1.0.0", None, None),
        ("1.0.0", "1.0.1", None, None),
        ("1.0.0", "0.9.0", None, "the version went back from 1.0.0 to 0.9.0"),
        ("1.0.0", "1.0.0", "minor", f"{IS_NEW} since 1.0.0{STILL}1.1.0 is due"),
        ("1.0.0", "1.4.2", "major", f"{BROKEN} since 1.0.0{LOW.format('1.4.2')} 2.0.0 is due"),
        ("0.3.1", "0.3.2", "major", f"{BROKEN} since 0.3.1{LOW.format('0.3.2')} 0.4.0 is due"),
        ("1.0.0", "2.0.0-alpha.1", "major", None),
        ("2.0.0-alpha.1", "2.0.0-alpha.2", "major", None),
        ("2.0.0-rc.1", "2.0.0-rc.1", "patch", f"{WORDED} since 2.0.0-rc.1{STILL}2.0.0 is due"),
        ("1.0", "1.1.0", "minor", '`1.0` is no semantic version: write "1.0.0"'),
    ],
)
def test_a_version_without_its_bump_is_a_finding(
    old: str, new: str, bump: Bump | None, finding: str | None
) -> None:
    assert version_finding(old, new, bump) == finding


NUMBERS = st.integers(0, 3)
VERSIONS = st.builds(
    Version, NUMBERS, NUMBERS, NUMBERS, st.just((len(STAGES), 0)) | st.tuples(NUMBERS, NUMBERS)
).filter(lambda version: version.stage[0] < len(STAGES) or version.is_final)
BUMPS: list[Bump] = ["patch", "minor", "major"]


@given(VERSIONS, VERSIONS, st.sampled_from(BUMPS))
def test_what_is_due_is_the_lowest_final_version_without_a_finding(
    old: Version, other: Version, bump: Bump
) -> None:
    lowest = Version.parse(next_version(str(old), bump))
    assert version_finding(str(old), str(lowest), bump) is None
    right = version_finding(str(old), str(other), bump) is None
    assert right == (other > old and (other.final >= lowest or not old.is_final))


@given(VERSIONS, VERSIONS)
def test_a_version_that_does_for_much_does_for_less(old: Version, new: Version) -> None:
    fine = [version_finding(str(old), str(new), bump) is None for bump in (None, *BUMPS)]
    assert fine == sorted(fine, reverse=True)


@given(VERSIONS)
def test_no_version_is_before_itself(version: Version) -> None:
    assert version_finding(str(version), str(version), None) is None
    for bump, other in product(BUMPS, BUMPS):
        one, two = next_version(str(version), bump), next_version(str(version), other)
        later = BUMPS.index(bump) <= BUMPS.index(other)
        assert not later or Version.parse(one) <= Version.parse(two)


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
