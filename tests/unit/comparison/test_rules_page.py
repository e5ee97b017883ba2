"""The page of the rules of change says what the rules say, and what their examples break."""

import re

import pytest
from framegen.comparison.changes import CHANGE_RULES

from tests.unit.comparison.rules_page import PAGE, contents, section, verdicts

TEXT = PAGE.read_text(encoding="utf-8")
# What these break is tried out in every run; that of all rules in tests/world.
SOME = ("field-type", "field-unit", "maybe-renamed", "reserved-removed")


def test_the_page_describes_every_rule() -> None:
    stale = [rule.id for rule in CHANGE_RULES if f"\n{section(rule)}\n" not in TEXT]
    assert stale == [], "if this was meant to change: python -m tests.documents"
    assert TEXT.count("\n### ") == len(CHANGE_RULES)


def test_the_contents_lead_to_every_heading_in_its_order() -> None:
    assert f"\n{contents()}\n## " in TEXT
    headings = re.findall(r"^##+ (.+)$", TEXT, re.MULTILINE)
    links = re.findall(r"\[([^]]+)\]\(#([\w-]+)\)", contents())
    assert [name for name, _ in links] == headings
    assert all(anchor == name.lower().replace(" ", "-") for name, anchor in links)


@pytest.mark.parametrize("id_", SOME)
def test_the_page_says_what_an_example_breaks(id_: str) -> None:
    (rule,) = (rule for rule in CHANGE_RULES if rule.id == id_)
    assert f"\n{section(rule)}\n\n{verdicts(rule)}\n" in TEXT
