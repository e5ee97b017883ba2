"""Findings: their text, their number, and their suggestions."""

from collections.abc import Callable, Iterable

import pytest
from framegen import checks
from framegen.compile import compile_spec
from framegen.language import misfit
from framegen.model import facts
from framegen.reading.findings import MOST_FINDINGS, Finding, did_you_mean, slip_of
from framegen.reading.source import Source, Span

from tests.bad_specs import bad_spec
from tests.factories import BUSSERVO, DEMO, Data, compiled_of, data_of
from tests.in_turn import in_turn
from tests.mutations.places import having


def test_a_finding_is_shown_with_its_line_and_a_caret() -> None:
    bad = bad_spec("unknown-type")
    [finding] = compile_spec(bad.source).findings
    assert finding.render(bad.source) == (
        "unknown-type.yaml:58:21: unknown-type: unknown type `v16`\n"
        "58 |       level: {type: v16, about: How bright.}\n"
        "   |                     ^^^\n"
        "   = at: messages.LampState.fields.level.type\n"
        "   = hint: did you mean `u16`?"
    )


def test_a_finding_in_two_places_is_shown_with_both() -> None:
    bad = bad_spec("duplicate-id")
    [finding] = compile_spec(bad.source).findings
    assert finding.render(bad.source) == (
        "duplicate-id.yaml:41:9: duplicate-id: LampsSet and LampRead are both 7, host -> lamp, "
        "and both can have 7 bytes\n"
        "41 |     id: 7\n"
        "   |         ^\n"
        "   = LampsSet has it first, at duplicate-id.yaml:20:5\n"
        "20 |     id: 7\n"
        "   |     ^^\n"
        "   = at: messages.LampRead.id\n"
        "   = hint: mend one of the codes, or the direction; where both are right, only an "
        "`always`, a `range` or a size tells them apart"
    )


@in_turn(
    "found, rule",
    lambda: [
        ("type: u16", "unknown-type"),
        ("authority: vendor", "unknown-source"),
        ("element: ServoTarget", "identifier"),
        ("is: id", "wrong-value"),
    ],
)
@in_turn(
    "value", lambda: ["x" * 200_000, "x " * 100_000, "x`y " * 50_000, "`.x " * 50_000, "9" * 4000]
)
def test_a_finding_repeats_of_a_value_what_can_be_read(found: str, rule: str, value: str) -> None:
    key, _, _ = found.partition(" ")
    text = BUSSERVO.read_text(encoding="utf-8")
    assert found in text
    source = Source("long.yaml", text.replace(found, f'{key} "{value}"', 1))
    findings = compile_spec(source).findings
    assert rule in {finding.rule for finding in findings}
    assert max(len(finding.render(source)) for finding in findings) < 2000


@pytest.mark.parametrize("key", ["x" * 200_000, "x " * 100_000, "x`y " * 50_000, "x." * 100_000])
def test_a_finding_repeats_no_more_of_a_key_than_can_be_read(key: str) -> None:
    text = DEMO.read_text(encoding="utf-8") + f'? "{key}"\n: {{}}\n? "{key}"\n: 1\n'
    source = Source("long.yaml", text)
    shown = [finding.render(source) for finding in compile_spec(source).findings]
    assert len(shown) == 2
    assert max(map(len, shown)) < 5000


def test_findings_are_limited_and_the_rest_is_counted() -> None:
    known = data_of(DEMO)
    findings = compiled_of({**known, **{f"key_{each}": 1 for each in range(2_000)}}).findings
    rules = [finding.rule for finding in findings]
    assert rules == [*["unknown-key"] * MOST_FINDINGS, "many-findings"]
    assert findings[-1].message == f"not shown: {2_000 - MOST_FINDINGS} findings from here down"
    assert findings[-1].path == f"key_{MOST_FINDINGS}"


def unknown_keys(words: list[str]) -> Data:
    return dict.fromkeys(words, 1)


def unknown_replies(words: list[str]) -> Data:
    question = data_of(DEMO)["messages"]["StationRead"]
    return {f"messages.Ask{word}": {**question, "reply": word} for word in words}


def unknown_sources(words: list[str]) -> Data:
    notes = [{"text": "It is so.", "cite": word} for word in words]
    return {"messages.StationState.fields.readings.notes": notes}


def unknown_facts(words: list[str]) -> Data:
    return {"unknowns": [{"concerns": {"message": word}, "what": "All."} for word in words]}


@pytest.mark.parametrize(
    ("change", "searching", "search"),
    [
        (unknown_keys, misfit, did_you_mean),
        (unknown_replies, checks.reply, did_you_mean),
        (unknown_sources, checks.unknown_source, did_you_mean),
        (unknown_facts, facts, slip_of),
    ],
)
def test_only_what_is_shown_is_searched_for_what_it_was_to_be(
    change: Callable[[list[str]], Data],
    searching: object,
    search: Callable[..., str],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    searched: list[str] = []

    def noted(word: str, known: Iterable[str], **more: str) -> str:
        searched.append(word)
        return search(word, known, **more)

    monkeypatch.setattr(searching, search.__name__, noted)
    words = [f"Odd{number}" for number in range(1000, 1500)]
    findings = compiled_of(having(data_of(DEMO), change(words))).findings
    assert findings[-1].rule == "many-findings"
    assert set(searched) <= set(words[:MOST_FINDINGS])
    assert len(searched) == sum(f"`{word}`" in f.message for f in findings for word in words)


@in_turn(
    "line, column, length, shown, carets",
    lambda: [
        ("a: v16", 4, 3, "a: v16", "   ^^^"),
        ("\ta: v16", 5, 3, " a: v16", "    ^^^"),
        ("a\u200b: v16", 5, 3, "a\N{REPLACEMENT CHARACTER}: v16", "    ^^^"),
        ("a: v16   ", 4, 3, "a: v16", "   ^^^"),
        ("a:", 3, 1, "a:", "  ^"),  # what is missing behind the end of a line
        ("a: v16", 4, 80, "a: v16", "   ^^^"),
        ("a: v16", 4, 0, "a: v16", "   ^"),
        # The 75th character of a long line is shown from its beginning; the next is shown with
        # the 50 characters before it.
        ("0123456789" * 20, 75, 2, "0123456789" * 10, " " * 74 + "^^"),
        ("0123456789" * 20, 76, 2, ("0123456789" * 20)[25:125], " " * 50 + "^^"),
        ("0123456789" * 20, 111, 80, ("0123456789" * 20)[60:160], " " * 50 + "^" * 50),
        ("0123456789" * 20, 191, 30, ("0123456789" * 20)[140:], " " * 50 + "^" * 10),
    ],
)
def test_a_caret_stands_under_its_place(
    line: str, column: int, length: int, shown: str, carets: str
) -> None:
    finding = Finding("some-rule", Span(1, column, length), "", "is wrong")
    assert finding.render(Source("spec.yaml", line)).split("\n") == [
        f"spec.yaml:1:{column}: some-rule: is wrong",
        f"1 | {shown}",
        f"  | {carets}",
    ]


TWENTY = ", ".join(f"`u{n}`" for n in range(20))


@in_turn(
    "word, known, otherwise, hint",
    lambda: [
        ("v16", ["u8", "u16", "u32"], "", "did you mean `u16`?"),
        ("v16", ["u16"], "declare it", "did you mean `u16`?"),
        ("size", ["u8", "u16"], "", "choose one of `u8`, `u16`"),
        ("size", ["u8", "u16"], "declare it", "declare it"),
        ("size", [f"u{n}" for n in range(22)], "", f"choose one of {TWENTY} or 2 others"),
        ("size", [], "declare it", "declare it"),
        ("size", [], "", ""),
    ],
)
def test_a_misspelt_word_gets_a_suggestion_or_the_choices(
    word: str, known: list[str], otherwise: str, hint: str
) -> None:
    assert did_you_mean(word, known, otherwise=otherwise) == hint


def test_findings_come_from_the_top_of_the_file_down() -> None:
    text = DEMO.read_text(encoding="utf-8")
    broken = text.replace("cite: manual, section 2\n", "cite: manaul, section 2\n")
    findings = compile_spec(Source("demo.yaml", broken)).findings
    assert len(findings) > 1
    assert [f.span for f in findings] == sorted(f.span for f in findings)
