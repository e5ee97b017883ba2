"""Editions of the language: old ones are read for ever, newer ones refused before all else.

The specs in `specs/editions/N` were right in edition N, and are never edited; nor are those in
`spec/released`, of which none needs more than the first edition.
"""

import re
from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.edition import EDITIONS, LATEST, is_newer
from framegen.language.load import read_source
from framegen.reading.source import Source
from framegen.reading.yamltree import read_tree

from tests.factories import BUSSERVO, DEMO, ROOT, data_of
from tests.in_turn import in_turn
from tests.mutations.spec_edits import edited

FOLDER = Path(__file__).parents[2] / "specs" / "editions"
OLD = sorted(FOLDER.glob("*/*.yaml"))
RELEASED = sorted((ROOT / "spec" / "released").glob("*.yaml"))


@pytest.mark.parametrize(
    ("file", "number"),
    [*((file, int(file.parent.name)) for file in OLD), *((file, 1) for file in RELEASED)],
    ids=lambda value: getattr(value, "stem", value),
)
def test_a_spec_of_an_old_edition_is_read_as_ever_and_says_the_same_in_the_latest(
    file: Path, number: int
) -> None:
    text = re.sub(r"(?m)^framegen: \d+$", f"framegen: {number}", read_source(file).text)
    old = compile_spec(Source(file.name, text))
    assert old.findings == []
    assert old.spec.framegen == number
    text = edited(text, (f"framegen: {number}\n", f"framegen: {LATEST}\n"))
    new = compile_spec(Source(file.name, text))
    assert new.findings == []
    assert (new.model.roles, new.model.messages) == (old.model.roles, old.model.messages)


def test_there_is_a_spec_of_every_old_edition() -> None:
    assert {int(file.parent.name) for file in OLD} == set(EDITIONS) - {LATEST}
    assert list(EDITIONS) == list(range(1, LATEST + 1))


def test_our_own_specs_are_written_in_the_latest_edition() -> None:
    assert [data_of(file)["framegen"] for file in (BUSSERVO, DEMO)] == [LATEST] * 2


@in_turn(
    "text, newer",
    lambda: (
        [("1", False), ("2", False), ("3", True), ("9" * 39, True), ("0", False), ("-3", False)]
        + [(each, False) for each in ('"3"', "true", "null", "[3]", "{a: 3}", "three", "")]
    ),
)
def test_only_a_higher_number_is_a_newer_edition(text: str, newer: bool) -> None:
    tree, _ = read_tree(Source("spec.yaml", f"framegen: {text}"))
    assert is_newer(tree.data["framegen"]) == newer


def test_a_newer_edition_is_the_only_finding() -> None:
    text = "framegen: 3\nendpoints: *who\nprotocol: [no]\nmessages: 010\n"
    [finding] = compile_spec(Source("spec.yaml", text)).findings
    assert finding.rule == "edition"
    assert "edition 3 of the language" in finding.message
    assert "a newer framegen is needed: git pull in its clone, then" in finding.hint
