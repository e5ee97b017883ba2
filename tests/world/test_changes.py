"""Changes of every spec: told at their place, both ways, explained, and ready to be released.

Each day it is one of so many leaves, and every edit one way round; --seed 0, 1, ... tries all.
"""

import pytest
from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.comparison import Comparison
from framegen.comparison.due import due, version_finding
from framegen.comparison.explained import explain
from framegen.comparison.listing import edition_of
from framegen.comparison.release import release
from framegen.compile import compile_spec
from framegen.reading.source import Source
from framegen.reading.yamltext import block

from tests.factories import Data
from tests.mutations.edits import EDITS, SPECS, edition, of_the_day
from tests.mutations.leaves import told_at_their_places
from tests.unit.comparison.rules_page import PAGE, section, verdicts

# One of so many leaves is changed.
_EACH = 5


@pytest.mark.parametrize("name", SPECS)
def test_every_leaf_of_a_spec(name: str, pytestconfig: pytest.Config) -> None:
    assert told_at_their_places(SPECS[name], _EACH, pytestconfig.getoption("seed")) > 15


@pytest.mark.parametrize("name", EDITS)
def test_every_effect_is_explained(name: str, pytestconfig: pytest.Config) -> None:
    old, new = (edition(data) for data in of_the_day(name, pytestconfig.getoption("seed")))
    comparison = Comparison(old, new)
    for effect in comparison.effects:
        assert explain(effect, comparison.changes), effect.text


@pytest.mark.parametrize("rule", CHANGE_RULES, ids=lambda rule: rule.id)
def test_the_page_says_what_every_example_breaks(rule: ChangeRule) -> None:
    said = f"\n{section(rule)}\n\n{verdicts(rule)}\n"
    assert said in PAGE.read_text(encoding="utf-8")


def text_of(data: Data) -> str:
    return "".join(f"{line}\n" for line in block(data))


@pytest.mark.parametrize("name", EDITS)
def test_a_released_spec_has_the_version_that_is_due(
    name: str, pytestconfig: pytest.Config
) -> None:
    old, new = of_the_day(name, pytestconfig.getoption("seed"))
    compiled = compile_spec(Source("spec/made_up.yaml", text_of(new)))
    before = compile_spec(Source("spec/released/made_up.yaml", text_of(old)))
    if compiled.findings or before.findings:
        pytest.skip("it contradicts itself")
    older = edition_of(before.source)
    comparison = Comparison(older, edition_of(compiled.source))
    if due(comparison.effects, comparison.changes) is None:
        pytest.skip("nothing but the version changed")
    made = release(compiled, comparison, {older.version}, accept="It is so.")
    released = compile_spec(Source("spec/made_up.yaml", made.text))
    assert released.findings == []
    again = Comparison(older, edition_of(released.source))
    assert [each.path for each in again.effects if each.breaks and not each.accepted] == []
    bump = due(again.effects, again.changes)
    assert version_finding(older.version, made.version, bump) is None
    assert released.spec.history[0].version == made.version
    assert released.spec.history[0].changes
