"""The rules of `framegen check`: their descriptions, and findings that no bad spec shows."""

import re
import textwrap

import pytest
from framegen import checks
from framegen.checks import RULES
from framegen.checks.reading import READING_RULES
from framegen.checks.rule import AnyRule
from framegen.compile import compile_spec
from framegen.reading.source import Source

from tests import bad_specs
from tests.factories import BUSSERVO, DEMO, ROOT, compiled_of, data_of
from tests.in_turn import in_turn
from tests.mutations.places import having
from tests.mutations.spec_edits import Edit, edited

FILED = [rule for rule in RULES if rule not in READING_RULES]


@in_turn("rule", lambda: RULES)
def test_a_rule_says_what_it_is_for(rule: AnyRule) -> None:
    assert re.fullmatch(r"[a-z]+(?:-[a-z]+)*", rule.id)
    assert re.search(r"[^.]$", rule.title)
    assert rule.why.endswith(".")
    assert rule.bad != rule.good
    assert all((rule.bad, rule.good))


def test_no_two_rules_share_an_id() -> None:
    ids = [rule.id for rule in RULES]
    assert sorted(set(ids)) == sorted(ids)


@in_turn("rule", lambda: FILED)
def test_a_rule_is_a_file_of_its_own(rule: AnyRule) -> None:
    module = getattr(checks, rule.id.replace("-", "_"))
    assert module.RULE is rule


def test_an_example_that_would_be_encoded_otherwise_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(checks.example, "encode", lambda *_: b"\x55")
    messages = {finding.message for finding in compiled_of(data_of(DEMO)).findings}
    assert messages == {"its values encode to 55, which is not this"}


@pytest.mark.parametrize(
    ("key", "said", "expected"),
    [
        ("targets", None, "the frame has a list, not nothing"),
        ("targets", {}, "the frame has a list, not an element"),
        ("time_ms", True, "the frame has 1000, not true"),
        ("time_ms", [1000], "the frame has 1000, not a list"),
    ],
)
def test_a_value_of_another_kind_is_told_by_its_kind(key: str, said: object, expected: str) -> None:
    data = having(data_of(BUSSERVO), {f"messages.ServoMove.examples.0.values.{key}": said})
    assert [finding.message for finding in compiled_of(data).findings][:1] == [expected]


def test_the_guide_shows_a_case_as_it_is() -> None:
    guide = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    [shown] = re.findall(r"   ```yaml\n(.*?)   ```\n", guide, re.DOTALL)
    table = (bad_specs.FOLDER / "empty-element.yaml").read_text(encoding="utf-8")
    assert textwrap.dedent(shown) in table


LAMPS = bad_specs.base("lamps")


def test_messages_of_the_same_id_are_told_apart_by_lengths_of_their_own() -> None:
    """Those of one are 4, 6, 8 and so on, and that of the other is between them."""
    edits: list[Edit] = [
        {"under": "LampRead", "replace": "id: 8", "with": "id: 7"},
        {"under": "LampRead", "replace": "length: 2", "with": "length: 5"},
        {"under": "LampRead", "replace": "type: u8", "with": "type: u32"},
        {"replace": "AA 55 02 08 01", "with": "AA 55 05 07 01 00 00 00"},
    ]
    assert compile_spec(Source("lamps.yaml", edited(LAMPS, *edits))).findings == []


@in_turn(
    "one, other, are_told",
    lambda: [
        ("u8, range: 0..99", "u8, range: 100..200", True),
        ("u8, range: 0..99", "u8, range: 99..200", False),
        ("u16, range: 0..0x7F", "u16, range: 0x80..0xFF", True),
        ("u16, range: 0..0x17F", "u16, range: 0x180..0x200", False),
        ("i8, range: -5..-1", "u8, range: 0..250", True),
        ("i8, range: -5..1", "u8, range: 2..250", False),
        ("u8, count: 2, text: ascii", "u16, range: 0x8080..", True),
        ("u8, always: 5", "u8, range: 6..", True),
    ],
)
def test_fields_that_have_no_byte_in_common_tell_messages_apart(
    one: str, other: str, are_told: bool
) -> None:
    """As long as a byte by itself does: whole numbers are not compared."""
    text = LAMPS[: LAMPS.index("  LampsSet:")]
    for name, field in (("One", one), ("Other", other)):
        size = 4 if "16" in field or "count" in field else 3
        text += f"""\
  {name}: {{id: 1, direction: host -> lamp, summary: X., cite: manual, length: {size - 1},
    fields: {{value: {{type: {field}, about: X.}}}}}}
"""
    found = compile_spec(Source("lamps.yaml", text)).findings
    assert ("duplicate-id" not in {finding.rule for finding in found}) == are_told
    assert {finding.rule for finding in found} <= {"duplicate-id", "no-example"}


BUS = bad_specs.base("bus")
COVERS = "covers: [station, length, family, code, serial, payload, seed]"


def hints_of(text: str) -> set[str]:
    return {finding.hint for finding in compile_spec(Source("bus.yaml", text)).findings}


@pytest.mark.parametrize(
    ("wrong", "right"),
    [
        (("crc-16/modbus", "crc-16/arc"), "method: crc-16/modbus"),
        (("byte_order: little", "byte_order: big"), "byte_order: little"),
        ((COVERS, COVERS.replace("station, ", "")), COVERS),
        ((COVERS, COVERS.replace(", seed", "").replace("code", "code, seed")), COVERS),
    ],
    ids=["method", "byte order", "a part less", "another order"],
)
def test_what_all_examples_agree_with_is_found(wrong: tuple[str, str], right: str) -> None:
    assert hints_of(BUS.replace(*wrong)) == {f"all 5 examples would agree with `{right}`"}


def test_an_unusual_sum_is_not_told_of_where_a_usual_one_agrees() -> None:
    pumps = ROOT / "tests/unit/conformance/device/pumps_of_two_kinds.yaml"
    wrong = pumps.read_text(encoding="utf-8").replace("method: sum,", "method: crc-8/smbus,")
    assert "all 3 examples would agree with `method: sum`" in hints_of(wrong)
    # These agree with no plain sum.
    carried = wrong.replace("E8 03 EF", "E8 83 70").replace("flow: 1000", "flow: 33768")
    assert "all 3 examples would agree with `method: carried sum`" in hints_of(carried)


def test_a_frame_that_was_made_up_is_no_evidence_for_a_checksum() -> None:
    cited = "hex: A5 5A 01 02 01 02 00 D9 A0 7F, values: {station: 1, serial: 0}, cite: manual"
    made_up = cited.replace("D9 A0", "00 00").replace("cite: manual", "constructed: By hand.")
    made_up = edited(BUS, (cited, made_up))
    told = hints_of(made_up.replace("crc-16/modbus", "crc-16/arc"))
    assert told == {"all 4 published examples would agree with `method: crc-16/modbus`"}


def test_what_one_short_checksum_agrees_with_by_chance_is_not_told() -> None:
    text = BUS.replace("type: u16, method: crc-16/modbus", "type: u8, method: sum")
    one = text[: text.index("  State:\n")].replace("    reply: State\n    refusal: Refused\n", "")
    wrong = one.replace("00 D9 A0 7F", "00 D9 7F")
    (hint,) = hints_of(wrong)
    assert hint.startswith("if the frame was made up, write CE there; ")


ANSWERED = {
    "the same": ("range: 1..9", "range: 1..9"),
    "more": ("range: 1..9", "range: 0..9"),
    "by name": ("range: 1..9", "range: 1..8, values: {last: {value: 9}}"),
    "silent": ("range: 0..9, values: {all: {value: 0, silent: true}}", "range: 1..9"),
    "silent behind": ("range: 1..9, values: {all: {value: 254, silent: true}}", "range: 1..9"),
}


@pytest.mark.parametrize(("asked", "answered"), ANSWERED.values(), ids=ANSWERED)
def test_an_address_that_is_answered_or_silent_is_no_finding(asked: str, answered: str) -> None:
    text = bad_specs.base("scales")
    for frame, part in (("request", asked), ("answer", answered)):
        added = f"station: {{is: address, type: u8, {part}}}"
        text = edited(text, {"under": frame, "after": "mark:", "add": added})
    # Its lengths and examples have no address: they are looked at only where all else is well.
    findings = compile_spec(Source("scales.yaml", text)).findings
    assert {finding.rule for finding in findings} == {"length-rule", "example"}
