"""Leaves of every spec: with another value there, the change is told at its place, both ways.

And every effect that breaks something has a change that explains it. Each day it is one of so many
leaves, and every edit one way round; --seed 0, 1, ... tries all of them.
"""

import pytest
from framegen.comparison.changes import CHANGE_RULES
from framegen.comparison.changes.change import ChangeRule
from framegen.comparison.comparison import Comparison
from framegen.comparison.explained import explain

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
