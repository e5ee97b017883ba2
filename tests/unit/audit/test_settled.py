"""What a recording settles: what it shows can be written down, and counts from then on."""

import math
from random import Random
from typing import Any

import pytest
from framegen.audit.evidence import evidence
from framegen.compile import compile_spec
from framegen.model.codec import encode
from framegen.model.model import Model
from framegen.reading.source import Source

from tests.factories import BUSSERVO, FROZEN, ROOT, compiled_file, compiled_of, data_in, data_of
from tests.in_turn import in_turn
from tests.lines.tallied_line import audited, spoken
from tests.mutations.places import having
from tests.protocols.specs import FILES

SPECS = {**FILES, "busservo": BUSSERVO}
SEEN = {"title": "Seen on hardware", "kind": "observation"}
ASK, TELL = "55 55 02 0F", "55 55 04 0F 4C 1D"


ASKING, TELLING = f"{ASK}  # 0 s, host: a\n", f"{TELL}  # 1 s, controller: a\n"


def with_examples(data: dict[str, Any], name: str, yaml: str) -> None:
    """Add examples to a message, as the report writes them."""
    lines = [line.removeprefix("    ") for line in yaml.splitlines()]
    data["messages"][name].setdefault("examples", [])
    added = data_in("\n".join(["examples:", *lines]))
    data["messages"][name]["examples"] += added["examples"]


@in_turn("name", lambda: SPECS)
def test_what_is_pasted_into_the_spec_fits_and_counts(name: str) -> None:
    model = compiled_file(SPECS[name]).model
    tally = spoken(model, Random(5))  # noqa: S311 - the same each time
    found = audited(model, tally.text)
    data = data_of(SPECS[name])
    for each in found.raised:
        data["sources"].setdefault(each.source, SEEN)
        with_examples(data, each.message.name, each.yaml)
    promised = found.evidence.seen + sum(len(each.facts) for each in found.raised)
    after = compiled_of(data)
    assert [each.message for each in after.findings] == []
    assert evidence(after.model).seen == promised
    assert found.raised or promised == len(found.evidence.facts)
    # All that it had to show is known now.
    assert audited(after.model, tally.text).raised == []


def test_a_request_that_nobody_answered_is_no_evidence() -> None:
    model = compiled_file(BUSSERVO).model
    for text, expected in ((ASKING, []), (ASKING + TELLING, ["BatteryVoltageRead"])):
        assert [each.message.name for each in audited(model, text).raised] == expected


WHERE, THERE = "55 55 06 15 03 01 02 06", "55 55 0C 15 03 01 FC 01 02 EC 01 06 FF FF"
ASKED = f"{WHERE}  # 0 s, host: a\n"
ANSWERED = f"{ASKED}{THERE}  # 0.5 s, controller: a\n"
MOVED = "55 55 08 03 01 E8 03 01 20 03  # 0 s, host: a\n"
BY_BOARD, BY_HOST = "sent by the controller", "sent by the host"
CONCERNS = [
    ("{message: ServoPositions}", "positions.position 492, 508, 65535", BY_BOARD),
    ("{message: ServoPositions, field: positions}", "positions 3 elements", BY_BOARD),
    ("{message: ServoPositions, field: positions.servo_id}", "servo_id 1, 2, 6", BY_BOARD),
    ("{message: ServoPositions, parameter: 2}", "parameter 2 was 01", BY_BOARD),
    ("{message: ServoPositions, fact: length}", "in frames of 14 bytes", BY_BOARD),
    ("{message: ServoPositionsRead}", "servo_ids[] 1, 2, 6", BY_HOST),
    ("{message: ServoPositionsRead, parameter: 1}", "parameter 1 was 03", BY_HOST),
    ("{message: BatteryVoltage}", None, ""),
    # That somebody sent it shows nothing of the board.
    ("{message: ServoMove}", None, ""),
    ("{message: ServoMove, field: targets.position}", None, ""),
    ("{message: ServoMove, example: 1}", None, ""),
]


def asking(concerns: str) -> Model:
    """Return busservo with one open question."""
    data = data_of(BUSSERVO)
    text = f"unknowns:\n  - concerns: {concerns}\n    what: Something.\n"
    data["unknowns"] = data_in(text)["unknowns"]
    return compiled_of(data).model


@in_turn("concerns, expected, sender", lambda: CONCERNS)
def test_what_is_seen_of_an_open_question(concerns: str, expected: str | None, sender: str) -> None:
    found = audited(asking(concerns), MOVED + ANSWERED)
    if expected is None:
        assert found.questions == []
    else:
        (question,) = found.questions
        assert expected in question.seen[0]
        assert sender in question.seen[0]


def test_an_example_is_seen_where_the_board_sent_or_answered_it() -> None:
    for name, sender in (("BatteryVoltage", BY_BOARD), ("BatteryVoltageRead", BY_HOST)):
        model = asking(f"{{message: {name}, example: 1}}")
        shown = bytes(model.messages[name].message.examples[0].hex).hex(" ")
        tell = f"{shown}  # 1 s, controller: a\n" if sender == BY_BOARD else TELLING
        (question,) = audited(model, ASKING + tell).questions
        assert f"example 1 was seen as it stands, {sender}" in question.seen[0]


def test_a_question_about_a_request_stays_open_until_it_is_answered() -> None:
    model = asking("{message: ServoPositionsRead}")
    assert audited(model, ASKED).questions == []
    assert audited(model, ANSWERED).questions != []


@pytest.mark.parametrize("origin", [{"cite": "vendor, section 1.5"}, {"constructed": "By hand."}])
def test_an_example_of_the_frame_is_confirmed_and_keeps_its_source(
    origin: dict[str, Any],
) -> None:
    example = {"title": "Ask", "hex": ASK, "values": {}, **origin}
    data = having(data_of(BUSSERVO), {"messages.BatteryVoltageRead.examples": [example]})
    model = compiled_of(data).model
    text = ASKING + TELLING
    raised = {each.message.name: each.yaml for each in audited(model, text).raised}
    yaml = raised["BatteryVoltageRead"]
    confirmed = "# Example 1 is confirmed: leave it and its source as they are."
    assert yaml.splitlines()[0].strip() == confirmed
    with_examples(data, "BatteryVoltageRead", yaml)
    after = compiled_of(data)
    assert [each.message for each in after.findings] == []
    assert data["messages"]["BatteryVoltageRead"]["examples"][0] == example
    raised_after = [each.message.name for each in audited(after.model, text).raised]
    assert "BatteryVoltageRead" not in raised_after


SMALL = """\
framegen: 2
protocol: {name: lamp, title: Lamp, version: "1.0.0", authority: paper, summary: A lamp.}
sources:
  paper: {title: The document, kind: document}
  desk: {title: Seen, kind: observation}
endpoints: {host: Asks., lamp: Answers.}
link: {baud: 9600, cite: paper}
byte_order: little
frame:
  header: {is: constant, bytes: A5}
  size: {is: length, type: u8, counts: [size, command, body]}
  command: {is: id, type: u8}
  body: {is: body}
messages:
  Fade:
    id: 1
    direction: host -> lamp
    summary: Fade.
    cite: paper, page 1
    length: 3
    fields:
      level:
        type: u8
        about: How bright.
        values:
          dark: {value: 0, about: Off.}
          bright: {value: 255, about: On., cite: desk}
        notes:
          - {text: It flickers., cite: desk}
          - {text: It hums., cite: paper}
    examples:
      - {title: Dark, hex: A5 03 01 00, values: {level: 0}, cite: CITE}
"""


@pytest.mark.parametrize(
    ("cite", "seen"),
    [
        # The link, the message, its field, two values and two notes.
        ("paper", {"level = bright", "a note on level"}),
        ("desk", {"Fade", "level", "level = dark", "level = bright", "a note on level"}),
    ],
)
def test_facts_are_counted_by_what_they_are_known_from(cite: str, seen: set[str]) -> None:
    known = evidence(compile_spec(Source("lamp.yaml", SMALL.replace("CITE", cite))).model)
    assert len(known.facts) == 7
    assert {fact.name for fact in known.facts if fact.seen} == seen
    assert known.by_kind == {"document": 5, "observation": 2}
    assert str(known) == (
        f"lamp 1.0.0: 1 message, {len(seen)} of 7 facts seen on hardware, 0 questions open"
    )


def test_the_guide_counts_facts_and_questions() -> None:
    guide = (ROOT / "docs" / "audit-a-recording.md").read_text(encoding="utf-8")
    for file in FROZEN.values():
        assert f"\n{evidence(compiled_file(file).model)}\n" in guide


@pytest.mark.parametrize(("value", "written"), [(1e30, True), (-2.5e-7, True), (math.inf, False)])
def test_a_number_is_written_as_in_a_spec_or_is_no_example(value: float, *, written: bool) -> None:
    model = compiled_file(FILES["mavlink1"]).model
    message = model.messages["Parameter"]
    values = {"sender": 257, "value": value, "count": 1, "index": 1, "name": "A", "type": 9}
    line = f"{encode(message, values).hex()}  # 1 s, {message.direction.sender}: a\n"
    found = audited(model, line)
    assert found.fits
    assert bool(found.raised) is written
    for each in found.raised:
        data = data_of(FILES["mavlink1"])
        data["sources"][each.source] = SEEN
        with_examples(data, each.message.name, each.yaml)
        assert [each.message for each in compiled_of(data).findings] == []
