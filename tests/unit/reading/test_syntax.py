"""Text that is no YAML: what is wrong, where, and what to do, whichever parser stopped."""

import pytest
import yaml
from framegen.reading import yamltree
from framegen.reading.findings import Finding
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable, read_tree
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn

PARSERS = [yaml.SafeLoader, *([yaml.CSafeLoader] if hasattr(yaml, "CSafeLoader") else [])]
QUOTED = "a text with a colon and a blank in it needs quotes"
BEGINS = "a text without quotes cannot begin with `{}`"
FLOW = "put commas between entries, and quotes around a text that has a colon or a quote"
TAB = ("a tab stands here, and YAML is indented with blanks", "write blanks in its place")
LOST = "this line is indented by {}, as nothing is that it could belong to"
HAS_A_VALUE = "this line is indented by 3, and the one above it by 2 has a value already"
FURTHER = "indent it further than the key that it belongs to"
BY_4 = "indent it by 4, if it belongs to the element above"
BEHIND, OPEN = "text stands behind the closing quote", "close the text above that is open"
AT_THE_END, IN_QUOTES = "close it at the end of the text", "put it in quotes"
OF_ITS_OWN = "begin it on a line of its own, or write it in brackets: [a, b]"

# A text, the place at which it is no YAML, what is wrong there, and what to do.
SLIPS = [
    ("a:\n\tb: 1", "2:1", *TAB),
    ("a:\n  \tb: 1", "2:3", *TAB),
    ("a:\n  b: 1\n\tc: 2", "3:1", *TAB),
    ("a:\n  b: Ask: now", "2:9", QUOTED, 'write `b: "Ask: now"`'),
    ("b: Ask: now: go", "1:7", QUOTED, 'write `b: "Ask: now: go"`'),
    ("a:\n  - b: Ask: now", "2:11", QUOTED, 'write `- b: "Ask: now"`'),
    ('b: Ask: "now"', "1:7", QUOTED, "put all of it in quotes"),
    # Blanks too many and too few.
    ("a:\n  b: 1\n   c: 2", "3:4", HAS_A_VALUE, "indent it by 2"),
    ("a:\n  b:\n    c: 1\n   d: 2", "4:4", LOST.format(3), "indent it by 2 or 4"),
    ("a:\n  b: 1\n c: 2", "3:2", LOST.format(1), "indent it by 0 or 2"),
    ("a:\n  b: 1\n # of c\n\n c: 2", "5:2", LOST.format(1), "indent it by 0 or 2"),
    (" a: 1\nb: 2", "2:1", LOST.format(0), "indent it by 1"),
    ("a:\n  b: 1\n  - c", "3:3", "an element of a list stands among keys", FURTHER),
    ("a:\n  - b: 1\n  c: 2", "3:3", "a key stands among the elements of a list", BY_4),
    # Brackets and quotes.
    ("a: {b: 1\nc: 2", "2:2", "a comma or `}` is expected here", FLOW),
    ("a: [b\nc: 2", "2:2", "a comma or `]` is expected here", FLOW),
    ("a: {b: 1}}", "1:10", "`}` closes nothing", "remove it, or put the text in quotes"),
    ('a: "b\nc: 2', "1:4", "the quote that opens here is not closed", AT_THE_END),
    ("a: 'it's'", "1:8", BEHIND, f"write a quote within the text as '', or {OPEN}"),
    ('a: "b" c', "1:8", BEHIND, f'write a quote within the text as \\", or {OPEN}'),
    *((f"a: {each}", "1:4", BEGINS.format(each[0]), IN_QUOTES) for each in ("@b", "`b`", "%b")),
    ("a: * b", "1:4", BEGINS.format("*"), IN_QUOTES),
    # Keys and what stands behind them.
    ("a: 1\nb\nc: 2", "2:1", "`b` is no key with a value", "write `b: ...`"),
    ("a: 1\nb 2\nc: 3", "2:1", "`b 2` is no key with a value", "write `b: 2`"),
    ("a: | b", "1:6", "the text behind `|` begins on the next line", "move it there"),
    ("a: - b", "1:4", "a list does not begin behind its key", OF_ITS_OWN),
]


@in_turn("parser", lambda: PARSERS, ids=lambda parser: parser.__name__)
@in_turn("text, place, message, hint", lambda: SLIPS)
def test_a_mistake_is_reported_with_a_hint(
    text: str, place: str, message: str, hint: str, parser: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(yamltree, "_Loader", parser)
    found = finding_of(text + "\n")
    shown = f"{found.span.line}:{found.span.column}", found.message, found.hint
    assert shown == (place, message, hint)


def finding_of(text: str) -> Finding:
    with pytest.raises(Unusable) as refused:
        read_tree(Source("spec.yaml", text))
    assert refused.value.finding is not None
    return refused.value.finding


def test_an_invalid_escape_is_reported() -> None:
    found = finding_of('a: "\\d"')
    assert found.message == "a backslash in double quotes begins an escape, and this is none"
    assert found.hint == "write two of them, or put the text in single quotes"


def test_an_unknown_error_is_reported_in_the_words_of_the_parser() -> None:
    said = finding_of("a: ? b").message
    assert said.startswith("this is not YAML: mapping keys are not allowed ")


@given(st.text(alphabet="ab:-|>#{}[]'\"@%*&! \t\n\\", max_size=40))
def test_invalid_yaml_is_reported_with_a_place_in_it(text: str) -> None:
    source = Source("spec.yaml", text)
    finding = None
    try:
        read_tree(source)
    except Unusable as refused:
        finding = refused.finding
    if finding is not None:
        assert 1 <= finding.span.line <= len(source.lines)
        assert finding.message
        assert finding.render(source)
