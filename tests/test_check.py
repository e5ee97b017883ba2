"""`framegen check`: every rule finds what it is there for, at its place, and nothing else."""

from __future__ import annotations

import json
import re
import time
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pytest
from framegen import checks
from framegen.checks import RULES
from framegen.checks.reading import READING_RULES
from framegen.compile import compile_spec
from framegen.language import misfit
from framegen.language.load import MAX_BYTES, load, read_source
from framegen.language.spec import Spec
from framegen.model import facts
from framegen.model.lookalikes import recognise
from framegen.reading.findings import MOST_FINDINGS, Finding, did_you_mean
from framegen.reading.source import Source, Span
from framegen.reading.yamltree import Unusable
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.factories import BUSSERVO, DEMO, compiled_of, data_of, kiln, layout_of
from tests.timeouts import GENEROUS

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from framegen.checks.rule import AnyRule

    from tests.factories import Steps

ROOT = Path(__file__).parent.parent
SPECS = ROOT / "tests" / "specs"
BAD = sorted((SPECS / "bad").glob("*.yaml"))
GOOD = [ROOT / "spec" / "busservo.yaml", SPECS / "demo.yaml"]
FILED = [rule for rule in RULES if rule not in READING_RULES]

EXPECT = "# expect: "


def said_of(source: Source) -> list[str]:
    """Findings as `rule line:column: message`, and a refusal as `unusable: message`."""
    try:
        findings = compile_spec(source).findings
    except Unusable as refusal:
        if refusal.finding is None:
            return [f"unusable: {refusal}"]
        findings = [refusal.finding]
    return [f"{f.rule} {f.span.line}:{f.span.column}: {f.message}" for f in findings]


def more_of(source: Source) -> list[str]:
    """What else the findings say: at which path, what other place to see, and what to do."""
    lines: list[str] = []
    for finding in findings_of(source):
        lines.append(f"# at: {finding.path}".rstrip())
        lines += [f"# see: {each.span.line}: {each.text}" for each in finding.related]
        lines += [f"# hint: {finding.hint}"] if finding.hint else []
    return lines


def findings_of(source: Source) -> list[Finding]:
    try:
        return compile_spec(source).findings
    except Unusable as refusal:
        return [] if refusal.finding is None else [refusal.finding]


def expected_of(source: Source) -> list[str]:
    return [
        line.removeprefix(EXPECT) for line in source.text.split("\n") if line.startswith(EXPECT)
    ]


def only_finding(name: str) -> tuple[Source, Finding]:
    source = Source(f"{name}.yaml", (SPECS / "bad" / f"{name}.yaml").read_text(encoding="utf-8"))
    [finding] = compile_spec(source).findings
    return source, finding


# ------------------------------------------------------------------ what is found


@pytest.mark.parametrize("file", BAD, ids=lambda file: file.stem)
def test_a_bad_spec_gives_exactly_its_findings(file: Path) -> None:
    source = read_source(file)
    assert expected_of(source), "the first line says what to expect"
    assert expected_of(source) == said_of(source)


@pytest.mark.parametrize("file", BAD, ids=lambda file: file.stem)
def test_a_finding_tells_where_it_is_and_what_to_do(file: Path) -> None:
    """As the last lines of the file have it."""
    source = read_source(file)
    lines = source.text.split("\n")
    assert [line for line in lines if line.startswith(("# at:", "# see: ", "# hint: "))] == (
        more_of(source)
    )


@pytest.mark.parametrize("file", GOOD, ids=lambda file: file.stem)
def test_a_good_spec_is_clean(file: Path) -> None:
    assert said_of(read_source(file)) == []


def test_every_rule_has_a_bad_spec_named_after_it() -> None:
    shown = {
        expected.split()[0]
        for file in BAD
        for expected in expected_of(read_source(file))
        if file.stem.startswith(expected.split()[0])
    }
    assert {rule.id for rule in RULES} <= shown


def test_a_spec_that_yaml_readers_disagree_on_is_not_read_further() -> None:
    compiled = compile_spec(read_source(SPECS / "bad" / "yaml-ambiguous-float.yaml"))
    assert compiled.read is None
    assert [finding.rule for finding in compiled.findings] == ["yaml-ambiguous"]


@pytest.mark.parametrize("slip", ["", "\nnothing: known"], ids=["good", "bad"])
def test_what_is_loaded_keeps_its_text_and_its_places(slip: str) -> None:
    source = Source("demo.yaml", GOOD[1].read_text(encoding="utf-8") + slip)
    compiled = compile_spec(source)
    assert compiled.source is source
    assert compiled.tree.key_at(("protocol",)).line > 1
    assert (compiled.read is None) == bool(slip)


def test_aliases_that_multiply_cost_no_time() -> None:
    # Written out, they would take for ever.
    started = time.process_time()
    said_of(read_source(SPECS / "bad" / "yaml-anchor-exploding.yaml"))
    assert time.process_time() - started < GENEROUS


def test_an_example_that_would_be_encoded_otherwise_is_found(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(checks.example, "encode", lambda *_: b"\x55")
    messages = {
        finding.message for finding in compile_spec(read_source(SPECS / "demo.yaml")).findings
    }
    assert messages == {"its values encode to 55, which is not this"}


ANGLE = ("messages", "VentsOpen", "fields", "vents", "fields", "angle")
SIZE = ("frame", "size")
LONG = "abcdefghij" * 4


@pytest.mark.parametrize(
    ("path", "value", "said", "hint"),
    [
        (("link",), None, "a mapping of keys is expected here, not nothing", ""),
        (("link",), {}, "the key `baud` is missing", "Bits per second."),
        (("link", "baud"), LONG, f"a whole number is expected here, not `{LONG}`", ""),
        (("link", "baud"), f"{LONG}k", f"a whole number is expected here, not `{LONG}...`", ""),
        (
            ("protocol", "title"),
            True,
            "text is expected here, not the truth value `true`",
            'put it in quotes: "true"',
        ),
        (
            ("protocol", "title"),
            {"en": "Greenhouse"},
            "text is expected here, not a mapping",
            "",
        ),
        (
            ("frame", "size"),
            {"is": "id"},
            "the key `type` is missing",
            "The number type, such as u8.",
        ),
        (
            ("frame", "preamble"),
            {"is": "constant"},
            "the key `bytes` is missing",
            "The bytes, in hex.",
        ),
        ((*ANGLE, "unti"), "V", "there is no key `unti` here", "did you mean `unit`?"),
        (
            ("messages", "VentsOpen", "fields", "vents", "elment"),
            "Vent",
            "there is no key `elment` here",
            "did you mean `element`?",
        ),
        (
            ("messages", "VentsOpen", "examples", 0, "titel"),
            "All of them",
            "there is no key `titel` here",
            "did you mean `title`?",
        ),
    ],
)
def test_what_does_not_fit_the_language_is_told_in_its_words(
    path: Steps, value: object, said: str, hint: str
) -> None:
    data = data_of(DEMO)
    around: Any = data
    for step in path[:-1]:
        around = around[step]
    around[path[-1]] = value
    finding = compiled_of(data).findings[0]
    assert (finding.message, finding.hint) == (said, hint)
    steps = [f"[{step}]" if isinstance(step, int) else f".{step}" for step in path]
    assert f".{finding.path}".startswith("".join(steps))


def test_a_key_that_is_no_number_is_told_once_however_its_value_looks() -> None:
    data = data_of(DEMO)
    data["lookalikes"]["old_stations"]["commands"] = {"lit": {"what": "It shines."}}
    found = [(f.path, f.message) for f in compiled_of(data).findings]
    path = "lookalikes.old_stations.commands.lit"
    assert found[0] == (path, "a whole number is expected here, not `lit`")
    assert {each for each, _ in found} == {path}


# ------------------------------------------------------------------ the rules themselves


@pytest.mark.parametrize("rule", RULES, ids=lambda rule: rule.id)
def test_a_rule_says_what_it_is_for(rule: AnyRule) -> None:
    assert re.fullmatch(r"[a-z]+(?:-[a-z]+)*", rule.id)
    assert rule.title
    assert not rule.title.endswith(".")
    assert rule.why.endswith(".")
    assert rule.bad
    assert rule.good
    assert rule.bad != rule.good


def test_no_two_rules_share_an_id() -> None:
    ids = [rule.id for rule in RULES]
    assert sorted(set(ids)) == sorted(ids)


@pytest.mark.parametrize("rule", FILED, ids=lambda rule: rule.id)
def test_a_rule_is_a_file_of_its_own(rule: AnyRule) -> None:
    module = getattr(checks, rule.id.replace("-", "_"))
    assert module.RULE is rule


# ------------------------------------------------------------------ how it is shown


def test_a_finding_is_shown_with_its_line_and_a_caret() -> None:
    source, finding = only_finding("unknown-type")
    assert finding.render(source) == (
        "unknown-type.yaml:59:21: unknown-type: unknown type `u17`\n"
        "59 |       level: {type: u17, about: How bright.}\n"
        "   |                     ^^^\n"
        "   = at: messages.LampState.fields.level.type\n"
        "   = hint: did you mean `u16`?"
    )


def test_a_finding_in_two_places_is_shown_with_both() -> None:
    source, finding = only_finding("duplicate-id")
    assert finding.render(source) == (
        "duplicate-id.yaml:42:9: duplicate-id: LampsSet and LampRead are both 7, host -> lamp\n"
        "42 |     id: 7\n"
        "   |         ^\n"
        "   = LampsSet has it first, at duplicate-id.yaml:21:5\n"
        "21 |     id: 7\n"
        "   |     ^^\n"
        "   = at: messages.LampRead.id\n"
        "   = hint: mend one of the codes, or the direction"
    )


@pytest.mark.parametrize(
    ("found", "rule"),
    [
        ("type: u16", "unknown-type"),
        ("authority: vendor", "unknown-source"),
        ("element: ServoTarget", "identifier"),
        ("is: id", "wrong-value"),
    ],
)
@pytest.mark.parametrize(
    "value", ["x" * 200_000, "x " * 100_000, "x`y " * 50_000, "`.x " * 50_000, "9" * 4000]
)
def test_a_finding_repeats_no_more_of_a_value_than_can_be_read(
    found: str, rule: str, value: str
) -> None:
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


def test_no_more_findings_are_told_than_can_be_mended_and_how_many_more_there_are() -> None:
    known = data_of(DEMO)
    findings = compiled_of({**known, **{f"key_{each}": 1 for each in range(20_000)}}).findings
    assert [finding.rule for finding in findings] == [
        *["unknown-key"] * MOST_FINDINGS,
        "many-findings",
    ]
    assert findings[-1].message == f"not shown: {20_000 - MOST_FINDINGS} findings from here down"
    assert findings[-1].path == f"key_{MOST_FINDINGS}"


def unknown_keys(data: Any, words: list[str]) -> None:
    data.update(dict.fromkeys(words, 1))


def unknown_replies(data: Any, words: list[str]) -> None:
    question = data["messages"]["StationRead"]
    data["messages"].update({f"Ask{word}": {**question, "reply": word} for word in words})


def unknown_sources(data: Any, words: list[str]) -> None:
    note = {"text": "It is so.", "cite": "manual"}
    readings = data["messages"]["StationState"]["fields"]["readings"]
    readings["notes"] = [{**note, "cite": word} for word in words]


def unknown_facts(data: Any, words: list[str]) -> None:
    data["unknowns"] = [{"concerns": {"message": word}, "what": "All."} for word in words]


@pytest.mark.parametrize(
    ("change", "searching"),
    [
        (unknown_keys, misfit),
        (unknown_replies, checks.reply),
        (unknown_sources, checks.unknown_source),
        (unknown_facts, facts),
    ],
)
def test_only_what_is_shown_is_searched_for_what_it_was_to_be(
    change: Callable[[Any, list[str]], None], searching: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    searched: list[str] = []

    def noted(word: str, known: Iterable[str], *, otherwise: str = "") -> str:
        searched.append(word)
        return did_you_mean(word, known, otherwise=otherwise)

    monkeypatch.setattr(searching, "did_you_mean", noted)
    data, words = data_of(DEMO), [f"Odd{number}" for number in range(1000, 1500)]
    change(data, words)
    findings = compiled_of(data).findings
    assert findings[-1].rule == "many-findings"
    assert set(searched) <= set(words[:MOST_FINDINGS])
    assert len(searched) == sum(f"`{word}`" in f.message for f in findings for word in words)


@pytest.mark.parametrize(
    ("line", "column", "length", "shown", "carets"),
    [
        ("a: u17", 4, 3, "a: u17", "   ^^^"),
        ("\ta: u17", 5, 3, " a: u17", "    ^^^"),
        ("a\u200b: u17", 5, 3, "a\N{REPLACEMENT CHARACTER}: u17", "    ^^^"),
        ("a: u17   ", 4, 3, "a: u17", "   ^^^"),
        ("a:", 3, 1, "a:", "  ^"),  # what is missing behind the end of a line
        ("a: u17", 4, 80, "a: u17", "   ^^^"),
        ("a: u17", 4, 0, "a: u17", "   ^"),
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


@pytest.mark.parametrize(
    ("word", "known", "otherwise", "hint"),
    [
        ("u17", ["u8", "u16", "u32"], "", "did you mean `u16`?"),
        ("u17", ["u16"], "declare it", "did you mean `u16`?"),
        ("size", ["u8", "u16"], "", "choose one of `u8`, `u16`"),
        ("size", ["u8", "u16"], "declare it", "declare it"),
        (
            "size",
            [f"u{n}" for n in range(22)],
            "",
            f"choose one of {', '.join(f'`u{n}`' for n in range(20))} or 2 others",
        ),
        ("size", [], "declare it", "declare it"),
        ("size", [], "", ""),
    ],
)
def test_a_misspelt_word_is_guessed_or_the_choices_are_named(
    word: str, known: list[str], otherwise: str, hint: str
) -> None:
    assert did_you_mean(word, known, otherwise=otherwise) == hint


def test_where_nothing_is_known_nothing_is_guessed() -> None:
    assert did_you_mean("size", []) == ""


def test_findings_come_from_the_top_of_the_file_down() -> None:
    text = (SPECS / "demo.yaml").read_text(encoding="utf-8")
    broken = text.replace("cite: manual, section 2\n", "cite: manaul, section 2\n")
    findings = compile_spec(Source("demo.yaml", broken)).findings
    assert len(findings) > 1
    assert [f.span for f in findings] == sorted(f.span for f in findings)


# ------------------------------------------------------------------ look-alikes


@pytest.mark.parametrize(
    ("hex_", "name", "command", "meaning"),
    [
        ("C3 5A A5 04 02 20 01 D8", "orchard", 0x20, ""),
        ("C3 5A A5 04 01 20 DA", "orchard", 0x20, ""),
        ("C3 5A A5 04 02 20 02 D7", "orchard", 0x20, ""),
        ("C3 5A A5 21 00 00", "old_stations", 0x21, "asks for the firmware"),
        ("C3 5A A5 22 00 00", None, None, None),  # no code of theirs
        ("C3 5A A5 04 02 20 01 D9", None, None, None),  # a wrong checksum
        ("C3 5A A5 04 03 20 01 D7", None, None, None),  # a wrong length
        ("C3 5A A5 04 02 20 01 D8 00", None, None, None),  # a byte too many
        ("C3 5A A6 04 02 20 01 D8", None, None, None),  # a wrong preamble
        ("C3 5A", None, None, None),  # too short for any frame
        ("", None, None, None),
    ],
)
def test_a_lookalike_is_recognised(
    hex_: str, name: str | None, command: int | None, meaning: str | None
) -> None:
    found = recognise(layout_of(data_of(DEMO)), bytes.fromhex(hex_))
    told = (None, None, None) if found is None else (found.name, found.command, found.meaning)
    assert told == (name, command, meaning)


@pytest.mark.parametrize(("order", "size"), [("big", "00 01"), ("little", "01 00")])
def test_a_lookalike_is_cut_into_its_parts_in_the_byte_order(order: str, size: str) -> None:
    model = compiled_of({**data_of(DEMO), "byte_order": order}).derived
    assert model is not None
    data = bytes.fromhex(f"C3 5A A5 21 {size} FF")
    found = recognise(model, data)
    assert found is not None
    assert {placed.path: placed.of(data) for placed in found.parts} == {
        "preamble": b"\xc3\x5a\xa5",
        "kind": b"\x21",
        "size": bytes.fromhex(size),
        "payload": b"\xff",
    }


# ------------------------------------------------------------------ what is no spec at all


@pytest.mark.parametrize(
    ("data", "refusal"),
    [
        (b"", "the file is empty, where a spec is a mapping of keys"),
        (b"\n\n", "the file is empty, where a spec is a mapping of keys"),
        (b"framegen: 1\n\xff", "is not UTF-8 text: byte 12 is 0xFF"),
        (bytes(range(128, 256)), "is not UTF-8 text: byte 0 is 0x80"),
        (b"\x7fELF\x02\x01\x00", "the file is not YAML"),
        (b"#" * (MAX_BYTES + 1), "has 1.0 MB, and a spec has at most 1 MB"),
    ],
    ids=["empty", "blank", "half text", "binary", "a program", "huge"],
)
def test_a_file_that_is_no_spec_is_refused(tmp_path: Path, data: bytes, refusal: str) -> None:
    file = tmp_path / "spec.yaml"
    file.write_bytes(data)
    with pytest.raises(Unusable, match=re.escape(refusal)):
        compile_spec(read_source(file))


def test_a_file_that_is_not_there_is_refused(tmp_path: Path) -> None:
    with pytest.raises(Unusable, match="does not exist"):
        read_source(tmp_path / "spec.yaml")
    with pytest.raises(Unusable, match="is not a file"):
        read_source(tmp_path)


@pytest.mark.parametrize(
    ("data", "said", "hint"),
    [
        (None, "does not exist", "name a spec file, or run this where spec/*.yaml is"),
        (b"\xff", "is not UTF-8 text: byte 0 is 0xFF", "save it as UTF-8"),
        (
            b"#" * (MAX_BYTES + 1),
            "has 1.0 MB, and a spec has at most 1 MB",
            "is it the right file?",
        ),
    ],
    ids=["absent", "binary", "huge"],
)
def test_a_file_that_is_refused_is_named_with_what_to_do(
    tmp_path: Path, data: bytes | None, said: str, hint: str
) -> None:
    file = tmp_path / "spec.yaml"
    if data is not None:
        file.write_bytes(data)
    with pytest.raises(Unusable) as refused:
        read_source(file)
    assert (str(refused.value), refused.value.hint) == (f"{file.as_posix()} {said}", hint)


@pytest.mark.parametrize(
    ("error", "reason"),
    [
        (PermissionError(13, "Permission denied"), "Permission denied"),
        (ValueError("embedded null byte"), "embedded null byte"),
    ],
)
def test_a_file_that_cannot_be_read_is_refused_with_the_reason(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, error: Exception, reason: str
) -> None:
    def unreadable(_: Path) -> bytes:
        raise error

    file = tmp_path / "spec.yaml"
    file.write_bytes(b"framegen: 1")
    monkeypatch.setattr(Path, "read_bytes", unreadable)
    with pytest.raises(Unusable) as refused:
        read_source(file)
    assert str(refused.value) == f"{file.as_posix()} cannot be read: {reason}"


def test_a_folder_is_refused_with_what_to_name_instead(tmp_path: Path) -> None:
    with pytest.raises(Unusable) as refused:
        read_source(tmp_path)
    assert str(refused.value) == f"{tmp_path.as_posix()} is not a file"
    assert refused.value.hint == "name the spec itself, such as spec/busservo.yaml"


def test_a_file_of_the_largest_size_is_read(tmp_path: Path) -> None:
    file = tmp_path / "spec.yaml"
    file.write_bytes(b"#" * MAX_BYTES)
    source = read_source(file)
    assert (source.name, len(source.text)) == (file.as_posix(), MAX_BYTES)


@pytest.mark.parametrize("start", [b"", b"\xef\xbb\xbf"], ids=["plain", "byte order mark"])
@pytest.mark.parametrize("end", [b"\n", b"\r\n"], ids=["lf", "crlf"])
def test_line_ends_and_a_byte_order_mark_change_nothing(
    tmp_path: Path, start: bytes, end: bytes
) -> None:
    plain = (SPECS / "bad" / "duplicate-id.yaml").read_bytes()
    file = tmp_path / "spec.yaml"
    file.write_bytes(start + plain.replace(b"\n", end))
    source = read_source(file)
    assert source.text.encode() == plain
    assert expected_of(source) == said_of(source)


# ------------------------------------------------------------------ whatever comes

brisk = settings(max_examples=100, deadline=None)

words = st.sampled_from(
    [
        "u8",
        "u17",
        "i8",
        "host -> controller",
        "host",
        "1..",
        "0..0",
        "-5..99999",
        "55 55",
        "length",
        "id",
        "servo_count + 3",
        "vendor",
        "vendor, 1",
        "query",
        "1.0.0",
        "ServoMove",
        "targets.position",
    ]
)
scalars = (
    st.none() | st.booleans() | st.integers(-2, 300) | st.integers() | words | st.text(max_size=20)
)
structures = st.recursive(
    scalars,
    lambda inner: (
        st.lists(inner, max_size=4)
        | st.dictionaries(words | st.text(max_size=8), inner, max_size=4)
    ),
    max_leaves=20,
)
TREE: Any = load(read_source(GOOD[0])).tree.data
TOP_KEYS = list(TREE)


def paths(value: Any, path: tuple[str | int, ...] = ()) -> list[tuple[str | int, ...]]:
    steps: list[tuple[str | int, Any]] = []
    if isinstance(value, dict):
        steps = list(value.items())
    elif isinstance(value, list):
        steps = list(enumerate(value))
    return [path, *(found for step, inner in steps for found in paths(inner, (*path, step)))]


PATHS = paths(TREE)[1:]


def at(tree: Any, path: tuple[str | int, ...]) -> Any:
    for step in path:
        tree = tree[step]
    return tree


def copied(tree: Any) -> Any:
    return json.loads(json.dumps(tree))


def survives(text: str) -> None:
    """Checks `text`, shows what is found, and derives what is clean: no step may raise."""
    source = Source("spec.yaml", text)
    try:
        compiled = compile_spec(source)
        findings = compiled.findings
    except Unusable as refusal:
        findings = [] if refusal.finding is None else [refusal.finding]
    else:
        assert findings or compiled.read is not None
        if compiled.read is not None and not findings:
            assert all(message.counts for message in compiled.model.messages.values())
    for finding in findings:
        assert finding.render(source)


ODD = [None, True, -1, 0, 2**64, 10**30, "x", "", [], {}, [None], {"a": 1}]
KILN = kiln()


def keys_of_the_language(value: Any) -> Iterator[Steps]:
    """The path of one value under each key that the guide's spec shows."""
    seen: set[object] = set()
    for here in paths(value)[1:]:
        key = here[-1] if isinstance(here[-1], str) else (here[-2], "[0]")
        if key not in seen:
            seen.add(key)
            yield here


@pytest.mark.parametrize("value", ODD, ids=repr)
def test_whatever_stands_in_place_of_a_value_is_told_in_our_words(value: object) -> None:
    """And never in those of the library that reads it."""
    for path in keys_of_the_language(KILN):
        data = copied(KILN)
        around = at(data, path[:-1])
        around[path[-1]] = value
        kinds: set[str] = set()
        try:
            Spec.model_validate(data)
        except ValidationError as error:
            kinds = {each["type"] for each in error.errors(include_url=False)}
        assert kinds <= {*misfit._MESSAGES, "missing", "extra_forbidden"}, path


@brisk
@given(st.text() | st.text(alphabet="ab01:-?,[]{}&*!|>'\"%@#~ \n\t"))
def test_any_text_is_checked_without_a_crash(text: str) -> None:
    survives(text)


@brisk
@given(st.dictionaries(st.sampled_from(TOP_KEYS) | st.text(max_size=8), structures))
def test_any_structure_is_checked_without_a_crash(tree: dict[str, Any]) -> None:
    survives(json.dumps(tree))


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """The spec of busservo with one to three of its values replaced, removed or put in twice."""
    tree = copied(TREE)
    for _ in range(draw(st.integers(1, 3))):
        path = draw(st.sampled_from(PATHS))
        try:
            around = at(tree, path[:-1])
            value = around[path[-1]]
        except (KeyError, IndexError, TypeError):
            continue
        action = draw(st.sampled_from(["replace", "borrow", "remove", "repeat", "rename"]))
        if action == "replace":
            around[path[-1]] = draw(structures)
        elif action == "borrow":
            around[path[-1]] = copied(at(TREE, draw(st.sampled_from(PATHS))))
        elif action == "remove":
            del around[path[-1]]
        elif isinstance(around, list):
            around.insert(draw(st.integers(0, len(around))), copied(value))
        elif action == "repeat":
            around[draw(words)] = copied(value)
        else:
            around[draw(words)] = around.pop(path[-1])
    return json.dumps(tree)


@brisk
@given(mutated())
def test_any_mutation_of_a_spec_is_checked_without_a_crash(text: str) -> None:
    survives(text)


def shaped(name: str, type_: str) -> dict[str, Any]:
    parts: dict[str, dict[str, Any]] = {
        "header": {"is": "constant", "bytes": "AA 55"},
        "length": {"is": "length", "type": type_, "counts": ["parameters", "length"]},
        "command": {"is": "id", "type": type_},
        "parameters": {"is": "body"},
        "address": {"is": "address", "type": type_},
    }
    return parts[name]


types = st.sampled_from(["u8", "u16", "u32", "i8", "i16", "i32"])
counts = st.builds("{}..{}".format, st.integers(-1, 90), st.integers(0, 300) | st.just(""))
plain = st.fixed_dictionaries({"type": types, "about": st.just("A number.")})
groups = st.fixed_dictionaries(
    {
        "element": st.just("Item"),
        "about": st.just("Items."),
        "fields": st.dictionaries(st.sampled_from("xyz"), plain, max_size=3),
    }
)
lists = st.builds(
    lambda field, counter, count: {**field, **counter, **count},
    plain | groups,
    st.sampled_from("abc").map(lambda name: {"counted_by": name}) | st.just({}),
    counts.map(lambda count: {"count": count}) | st.just({}),
)
whole = ["header", "length", "command", "parameters"]
orders = st.just(whole) | st.permutations(whole) | st.lists(st.sampled_from([*whole, "address"]))
frames = st.builds(
    lambda order, type_: {name: shaped(name, type_) for name in order},
    orders,
    st.sampled_from(["u8", "u8", "u16", "u32", "i8"]),
)


@settings(max_examples=200, deadline=None)
@given(frames, st.dictionaries(st.sampled_from("abc"), plain), st.none() | lists)
def test_any_frame_with_any_fields_is_checked_without_a_crash(
    frame: dict[str, Any], fields: dict[str, Any], last: dict[str, Any] | None
) -> None:
    tree = {key: TREE[key] for key in TREE if key not in ("errata", "unknowns", "lookalikes")}
    message = {**TREE["messages"]["ActionGroupStop"], "reports": [], "examples": []}
    message["fields"] = fields if last is None else {**fields, "last": last}
    survives(json.dumps({**tree, "frame": frame, "messages": {"Ask": message}}))


@pytest.mark.parametrize(
    ("key", "said", "told"),
    [
        ("targets", None, "the frame says a list, not nothing"),
        ("targets", {}, "the frame says a list, not an element"),
        ("time_ms", True, "the frame says 1000, not true"),
        ("time_ms", [1000], "the frame says 1000, not a list"),
    ],
)
def test_a_value_of_another_kind_is_told_by_its_kind(key: str, said: object, told: str) -> None:
    data = data_of(BUSSERVO)
    data["messages"]["ServoMove"]["examples"][0]["values"][key] = said
    assert [finding.message for finding in compiled_of(data).findings][:1] == [told]
