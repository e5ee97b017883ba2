"""Which bump of the version is due, and what is said of a version that does not have it."""

from itertools import product

from framegen.comparison.changes.change import Change
from framegen.comparison.due import Bump, due, next_version, version_finding
from framegen.comparison.effect import Effect
from framegen.language.version import STAGES, Version
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn

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
