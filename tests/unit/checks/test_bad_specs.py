"""`framegen check`: every rule finds what it is for, at its place, and nothing else."""

import time
from collections import Counter
from typing import Any

import pytest
from framegen.checks import REMARKS, RULES, remarks
from framegen.checks.rule import AnyRule
from framegen.compile import compile_spec
from framegen.reading.findings import Finding
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable

from tests import bad_specs
from tests.bad_specs import bad_spec
from tests.in_turn import in_turn
from tests.mutations.spec_edits import EditError, edited
from tests.timeouts import GENEROUS

REMARKED = {rule.id for rule in REMARKS}


def said_of(source: Source, *, remarked: str = "") -> tuple[list[Finding], str]:
    """Return the findings of a bad spec, or its remarks of one rule, and why it is refused."""
    try:
        compiled = compile_spec(source)
        found = [] if compiled.findings else remarks(compiled.model, compiled.tree)
        return [*compiled.findings, *(each for each in found if each.rule == remarked)], ""
    except Unusable as refusal:
        return ([], str(refusal)) if refusal.finding is None else ([refusal.finding], "")


@in_turn("name", bad_specs.names)
def test_a_bad_spec_gives_exactly_its_findings(name: str) -> None:
    bad = bad_spec(name)
    remarked = next((each.rule for each in bad.findings if each.rule in REMARKED), "")
    found, refusal = said_of(bad.source, remarked=remarked)
    # As a person reads them first, which shows best what differs.
    assert rendered(found, bad.source) == rendered(bad.findings, bad.source)
    assert (found, refusal) == (bad.findings, bad.refusal)


def rendered(findings: list[Finding], source: Source) -> str:
    return "\n".join(finding.render(source) for finding in findings)


@in_turn("rule", lambda: RULES, ids=lambda rule: rule.id)
def test_every_rule_has_a_bad_spec(rule: AnyRule) -> None:
    found = [each.rule for name in bad_specs.names(rule.id) for each in bad_spec(name).findings]
    assert rule.id in found


def test_a_bad_spec_has_a_name_of_its_own_that_begins_with_its_rule() -> None:
    assert [name for name, times in Counter(bad_specs.names()).items() if times > 1] == []
    for table in bad_specs.tables():
        assert all(f"{name}-".startswith(f"{table}-") for name in bad_specs.names(table)), table


@in_turn("name", bad_specs.base_names)
def test_what_bad_specs_begin_with_is_good(name: str) -> None:
    assert said_of(Source(f"{name}.yaml", bad_specs.base(name))) == ([], "")


def test_no_two_bad_specs_are_the_same() -> None:
    texts = Counter(bad_spec(name).source.text for name in bad_specs.names())
    assert [text for text, times in texts.items() if times > 1] == []


def test_a_bad_spec_and_what_it_begins_with_are_printed_as_files(
    capsysbinary: pytest.CaptureFixture[bytes],
) -> None:
    bad_specs.main(["invisible-character-as-is"])
    text = edited(bad_specs.base("lamps"), ("title: Lamps", "title: La\u200bmps"))
    assert capsysbinary.readouterr().out == text.encode()
    bad_specs.main(["vents"])
    assert capsysbinary.readouterr().out == (bad_specs.BASES / "vents.yaml").read_bytes()


def test_all_bad_specs_are_listed(capsys: pytest.CaptureFixture[str]) -> None:
    bad_specs.main([])
    assert capsys.readouterr().out.split() == bad_specs.names()


def test_an_unknown_bad_spec_gets_a_suggestion(capsys: pytest.CaptureFixture[str]) -> None:
    with pytest.raises(SystemExit):
        bad_specs.main(["emty-element"])
    assert "no bad spec `emty-element`: did you mean `empty-element`?" in capsys.readouterr().err


LINES = """\
lamps:
  one:
    level: 1
    about: A lamp.
  two:
    level: 2
    about: A lamp."""
ONCE = "must be there once, and is there"
BOTH = LINES.rsplit("about", 1)
MARKS = "1 findings and {} places to see are reported, and {} and 0 are marked"
ONE = "  one:\n    level: 1\n    about: A lamp.\n"


@in_turn(
    "edit, text",
    lambda: [
        ({"replace": "level: 1", "with": "level: «3»"}, LINES.replace("level: 1", "level: «3»")),
        ({"mark": "«level: 2»"}, LINES.replace("level: 2", "«level: 2»")),
        ({"under": "two", "replace": "about", "with": "title"}, "title".join(BOTH)),
        ({"remove": "one:"}, LINES.replace(ONE, "")),
        ({"under": "two", "remove": "about:"}, LINES.rpartition("\n")[0]),
        ({"instead": "one:", "add": "three: {}\n"}, LINES.replace(ONE, "  three: {}\n")),
        ({"after": "two:", "add": "three:\n  level: 3\n"}, f"{LINES}\n  three:\n    level: 3"),
        ({"before": "one:", "add": "no: {}"}, LINES.replace("  one:", "  no: {}\n  one:")),
        ({"after": "lamps:", "add": "k_#: #", "times": 2}, f"{LINES}\nk_0: 0\nk_1: 1"),
    ],
)
def test_an_edit_changes_one_place(edit: dict[str, Any], text: str) -> None:
    assert edited(LINES, edit) == text


def test_the_outermost_of_lines_that_begin_alike_is_meant() -> None:
    assert edited("a:\n  b: 1\nb: 2", {"remove": "b:"}) == "a:\n  b: 1"


@in_turn(
    "edit, why",
    lambda: [
        ({"replace": "level: 3", "with": ""}, f"`level: 3` {ONCE} 0 times"),
        ({"replace": "about", "with": ""}, f"`about` {ONCE} 2 times, in the lines 4, 7"),
        ({"mark": "l«e»vel"}, f"`level` {ONCE} 2 times, in the lines 3, 6"),
        ({"remove": "evel:"}, f"`evel:` {ONCE} 0 times"),
        ({"under": "three", "remove": "level:"}, f"`three:` {ONCE} 0 times"),
        ({"under": "one", "mark": "level: 2"}, f"`level: 2` {ONCE} 0 times"),
        ({"unter": "one", "mark": "level: 2"}, "an edit has no `unter`"),
        ({"replace": "level: 1"}, "no edit has `replace` alone"),
    ],
)
def test_an_edit_that_no_longer_applies_is_reported(edit: dict[str, Any], why: str) -> None:
    with pytest.raises(EditError) as refused:
        edited(LINES, edit)
    assert str(refused.value) == why


@in_turn(
    "case, why",
    lambda: [
        ({"edits": [{"mark": "«id»: 7"}], "massage": "is wrong"}, "a case has no `massage`"),
        ({"edits": [{"mark": "id: 7"}], "message": "is wrong"}, MARKS.format(0, 0)),
        ({"edits": [{"mark": "«id»: 7"}], "message": "is it", "see": ["it"]}, MARKS.format(1, 1)),
    ],
)
def test_an_incomplete_case_is_reported(case: dict[str, Any], why: str) -> None:
    with pytest.raises(EditError) as refused:
        bad_specs.made("some-rule", {"name": "some-rule", **case})
    assert str(refused.value) == why


def test_a_spec_that_yaml_readers_disagree_on_is_not_read_further() -> None:
    compiled = compile_spec(bad_spec("yaml-ambiguous-hex").source)
    assert compiled.read is None
    assert [finding.rule for finding in compiled.findings] == ["yaml-ambiguous"]


def test_aliases_that_multiply_cost_no_time() -> None:
    # Written out, they would take for ever.
    started = time.process_time()
    said_of(bad_spec("yaml-anchor-exploding").source)
    assert time.process_time() - started < GENEROUS
