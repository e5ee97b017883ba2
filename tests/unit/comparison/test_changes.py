"""What became of what between two editions: each change is told, once, and both ways alike."""

import copy
import re
from functools import reduce
from typing import Any

import pytest
from framegen.checks import RULES
from framegen.comparison import changes as rules
from framegen.comparison.changes import CHANGE_RULES, changes
from framegen.comparison.changes.change import Change, ChangeRule
from framegen.comparison.edition import Edition
from framegen.comparison.effect import Effect
from framegen.comparison.explained import explain
from framegen.comparison.pair import Pair

from tests.factories import ROOT, Data, compiled_of, data_of
from tests.in_turn import in_turn
from tests.mutations.edits import EDITS, SERVO, SPECS, edition, pair_of
from tests.mutations.kinds import keys_of_the_language
from tests.mutations.leaves import mirrored, told_at_their_places, turned
from tests.mutations.places import GONE, having, leaves, renamed, with_
from tests.unit.comparison.rule_examples import example

EXPECTED = data_of(ROOT / "tests" / "unit" / "comparison" / "changes.yaml")
BY_ID = in_turn("rule", lambda: CHANGE_RULES)


def told_of(old: Data, new: Data) -> list[Change]:
    """Return the changes; of editions whose rules nobody has looked at."""
    return changes(pair_of(old, new, checked=False))


@in_turn("name", lambda: EDITS)
def test_an_edit_is_told_and_what_is_new_one_way_is_gone_the_other_way(name: str) -> None:
    old, new = EDITS[name]
    told = told_of(old, new)
    assert [f"{each.rule} | {each.text}" for each in told] == EXPECTED[name]
    assert mirrored(told) == turned(told_of(new, old))


@pytest.mark.parametrize("name", SPECS)
def test_nothing_became_of_what_is_the_same(name: str) -> None:
    assert told_of(SPECS[name], copy.deepcopy(SPECS[name])) == []


@BY_ID
def test_a_rule_says_what_it_is_for(rule: ChangeRule) -> None:
    assert re.fullmatch(r"[a-z]+(?:-[a-z]+)*", rule.id)
    assert not rule.title.endswith(".")
    assert rule.why.endswith(".")
    assert rule.do.endswith(".")
    assert rule.before != rule.after
    assert getattr(rules, rule.id.replace("-", "_")).RULE is rule


@BY_ID
def test_what_a_rule_says_is_not_about_its_example(rule: ChangeRule) -> None:
    assert not re.search(
        r"lamp|level|colour|signed_|_controller", f"{rule.why} {rule.do}", re.IGNORECASE
    )


def test_no_two_rules_share_an_id_and_none_has_that_of_a_rule_of_check() -> None:
    ids = [rule.id for rule in (*CHANGE_RULES, *RULES)]
    assert sorted(set(ids)) == sorted(ids)


def test_what_may_come_may_go() -> None:
    ids = {rule.id for rule in CHANGE_RULES}
    assert {each.removesuffix("-added") for each in ids if each.endswith("-added")} == {
        each.removesuffix("-removed") for each in ids if each.endswith("-removed")
    }


@BY_ID
def test_the_example_of_a_rule_is_what_it_tells_of(rule: ChangeRule) -> None:
    old, new = example(rule)
    for data in (old, new):
        assert {each.rule for each in compiled_of(data).findings} <= {"no-example"}
    told = {each.rule for each in told_of(old, new)}
    # Of other sizes, the rule of the length says so too.
    assert rule.id in told
    assert told <= {rule.id, "length-changed"}


# So many leaves are one that is changed in every run; all of them are in tests/world.
_EACH = 24


@pytest.mark.parametrize("name", ["greenhouse", "everything"])
def test_every_changed_fact_is_told_at_its_place(name: str) -> None:
    assert told_at_their_places(SPECS[name], each=_EACH) > 5


def test_every_key_of_the_language_is_among_the_examples() -> None:
    """Each key of each part of a spec is in a spec whose leaves are changed, here or by a rule."""
    said: set[str] = set()
    specs: list[Any] = [*SPECS.values()]
    for rule in CHANGE_RULES:
        specs += example(rule)
    for data in specs:
        said |= {str(step) for path, _ in leaves(data) for step in path}
    assert keys_of_the_language() <= said


def test_what_names_a_thing_by_its_new_name_is_no_change() -> None:
    new = renamed(SERVO, "time_ms", "duration_ms")
    new = with_(new, "messages", "ServoMove", "fields", "duration_ms", "was", "time_ms")
    told = [each.text for each in told_of(SERVO, new)]
    assert told == ["ServoMove.duration_ms: renamed from time_ms"]
    back = [each.text for each in told_of(new, SERVO)]
    assert back == ["ServoMove.time_ms: renamed from duration_ms"]


def test_what_only_may_be_renamed_is_told_under_the_name_that_it_had() -> None:
    new = renamed(SERVO, "ActionGroupCompleted", "GroupOver")
    new = with_(new, "messages", "ActionGroupRun", "reports", ["ActionGroupStarted"])
    told = [each.text for each in told_of(SERVO, new) if each.rule == "reports"]
    assert told == [
        "ActionGroupRun: reports ActionGroupStarted, ActionGroupCompleted became ActionGroupStarted"
    ]


@pytest.mark.parametrize(("key", "at", "words"), [("errata", 2, "title"), ("unknowns", 2, "what")])
def test_what_is_said_otherwise_of_one_message_is_the_same(key: str, at: int, words: str) -> None:
    message = SERVO[key][at]["concerns"]["message"]
    new = with_(SERVO, key, at, words, "Other words.")
    new = with_(new, key, at, "concerns", {"message": message})
    told = [(each.rule, each.path) for each in told_of(SERVO, new)]
    assert {path[:2] for _, path in told} == {(key, at)}
    assert not [rule for rule, _ in told if rule.endswith(("-added", "-removed"))]


def test_changes_come_in_the_order_of_the_new_edition_and_what_is_gone_last() -> None:
    several = {"messages.ServoMove.id": 4, "link.baud": 19200, "pose": GONE}
    count = {"messages.ServoUnload.fields.servo_ids.count": "2.."}
    data = having(SERVO, several | count)
    editions = []
    for compiled in map(compiled_of, (SERVO, data)):
        made = edition(compiled.tree.data)
        editions.append(Edition("spec.yaml", compiled, made.spec, made.model))
    told = [each.rule for each in changes(Pair(*editions))]
    assert told == ["baud", "message-id", "count", "pose-removed"]


MOVE = ("messages", "ServoMove")


def explained(effect: Effect, *edits: tuple[object, ...]) -> list[str]:
    """Return the rules of what explains an effect on the servos, which are edited so."""
    new = reduce(lambda data, edit: with_(data, *edit), edits, SERVO)
    return [each.rule for each in explain(effect, changes(pair_of(SERVO, new)))]


WIDER = (*MOVE, "fields", "time_ms", "type", "u32")
WORDS = (*MOVE, "summary", "Move.")
HEADER = ("frame", "header", "bytes", "55 AA")
METHOD = (*MOVE, "method", "move(targets, time_ms)")
ELSEWHERE = ("messages", "ServoUnload", "id", 99)


@in_turn(
    "edits, axis, path, expected",
    lambda: [
        ([WIDER, WORDS, ELSEWHERE], "wire", MOVE, ["field-type"]),
        ([HEADER, WORDS, ELSEWHERE], "wire", MOVE, ["part-bytes"]),
        ([HEADER, METHOD], "wire", MOVE, ["part-bytes"]),
        ([HEADER, METHOD], "programs", MOVE, ["method-changed"]),
        ([WIDER, METHOD], "programs", (*MOVE, "fields", "time_ms"), ["field-type"]),
        ([WORDS], "wire", MOVE, ["words"]),
        ([("protocol", "name", "servos")], "programs", ("protocol", "name"), ["library-renamed"]),
    ],
)
def test_the_nearest_changes_explain(
    edits: list[tuple[object, ...]], axis: str, path: tuple[str, ...], expected: list[str]
) -> None:
    effect = Effect(axis, "refused", path, path, "It differs.")  # type: ignore[arg-type]
    assert explained(effect, *edits) == expected


def test_what_an_effect_names_explains_it_too() -> None:
    path = ("messages", "BatteryVoltageRead")
    effect = Effect("conversation", "no reply", path, path, "BatteryVoltage is refused.")
    longer = ("messages", "BatteryVoltage", "fields", "voltage_mv", "type", "u32")
    assert explained(effect, longer, ELSEWHERE) == ["field-type"]
