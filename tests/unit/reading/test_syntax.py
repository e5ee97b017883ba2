"""Text that is no YAML: what is wrong, where, and what to do, whichever parser stopped."""

from __future__ import annotations

import pytest
import yaml
from framegen.reading import yamltree
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
OPEN = "close the text above that is open"

SLIPS: dict[str, tuple[str, str, str, str]] = {
    "a tab": ("a:\n\tb: 1", "2:1", *TAB),
    "a tab behind blanks": ("a:\n  \tb: 1", "2:3", *TAB),
    "a tab further down": ("a:\n  b: 1\n\tc: 2", "3:1", *TAB),
    "a colon": ("a:\n  b: Ask: now", "2:9", QUOTED, 'write `b: "Ask: now"`'),
    "two colons": ("b: Ask: now: go", "1:7", QUOTED, 'write `b: "Ask: now: go"`'),
    "a colon in a list": ("a:\n  - b: Ask: now", "2:11", QUOTED, 'write `- b: "Ask: now"`'),
    "a colon and quotes": ('b: Ask: "now"', "1:7", QUOTED, "put all of it in quotes"),
    "a blank too many": (
        "a:\n  b: 1\n   c: 2",
        "3:4",
        "this line is indented by 3, and the one above it by 2 has a value already",
        "indent it by 2",
    ),
    "a blank too many behind a mapping": (
        "a:\n  b:\n    c: 1\n   d: 2",
        "4:4",
        LOST.format(3),
        "indent it by 2 or 4",
    ),
    "a blank too few": ("a:\n  b: 1\n c: 2", "3:2", LOST.format(1), "indent it by 0 or 2"),
    "a blank too few and a comment": (
        "a:\n  b: 1\n # of c\n\n c: 2",
        "5:2",
        LOST.format(1),
        "indent it by 0 or 2",
    ),
    "a blank before the first key": (" a: 1\nb: 2", "2:1", LOST.format(0), "indent it by 1"),
    "an element among keys": (
        "a:\n  b: 1\n  - c",
        "3:3",
        "an element of a list stands among keys",
        "indent it further than the key that it belongs to",
    ),
    "a key among elements": (
        "a:\n  - b: 1\n  c: 2",
        "3:3",
        "a key stands among the elements of a list",
        "indent it by 4, if it belongs to the element above",
    ),
    "an open brace": ("a: {b: 1\nc: 2", "2:2", "a comma or `}` is expected here", FLOW),
    "an open bracket": ("a: [b\nc: 2", "2:2", "a comma or `]` is expected here", FLOW),
    "a brace too many": (
        "a: {b: 1}}",
        "1:10",
        "`}` closes nothing",
        "remove it, or put the text in quotes",
    ),
    "an open quote": (
        'a: "b\nc: 2',
        "1:4",
        "the quote that opens here is not closed",
        "close it at the end of the text",
    ),
    "a single quote within": (
        "a: 'it's'",
        "1:8",
        "text stands behind the closing quote",
        f"write a quote within the text as '', or {OPEN}",
    ),
    "a double quote within": (
        'a: "b" c',
        "1:8",
        "text stands behind the closing quote",
        f'write a quote within the text as \\", or {OPEN}',
    ),
    "an at sign": ("a: @b", "1:4", BEGINS.format("@"), "put it in quotes"),
    "a backtick": ("a: `b`", "1:4", BEGINS.format("`"), "put it in quotes"),
    "a percent sign": ("a: %b", "1:4", BEGINS.format("%"), "put it in quotes"),
    "a star": ("a: * b", "1:4", BEGINS.format("*"), "put it in quotes"),
    "a key without a value": (
        "a: 1\nb\nc: 2",
        "2:1",
        "`b` is no key with a value",
        "write `b: ...`",
    ),
    "a key without a colon": (
        "a: 1\nb 2\nc: 3",
        "2:1",
        "`b 2` is no key with a value",
        "write `b: 2`",
    ),
    "a text behind its sign": (
        "a: | b",
        "1:6",
        "the text behind `|` begins on the next line",
        "move it there",
    ),
    "a list behind its key": (
        "a: - b",
        "1:4",
        "a list does not begin behind its key",
        "begin it on a line of its own, or write it in brackets: [a, b]",
    ),
}


@in_turn("parser", lambda: PARSERS, ids=lambda parser: parser.__name__)
@in_turn("slip", lambda: SLIPS)
def test_a_mistake_is_reported_with_a_hint(
    slip: str, parser: type, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(yamltree, "_Loader", parser)
    text, place, message, hint = SLIPS[slip]
    with pytest.raises(Unusable) as refused:
        read_tree(Source("spec.yaml", text + "\n"))
    found = refused.value.finding
    assert found is not None
    shown = f"{found.span.line}:{found.span.column}", found.message, found.hint
    assert shown == (place, message, hint)


def test_an_invalid_escape_is_reported() -> None:
    with pytest.raises(Unusable) as refused:
        read_tree(Source("spec.yaml", 'a: "\\d"'))
    found = refused.value.finding
    assert found is not None
    assert found.message == "a backslash in double quotes begins an escape, and this is none"
    assert found.hint == "write two of them, or put the text in single quotes"


def test_an_unknown_error_is_reported_in_the_words_of_the_parser() -> None:
    with pytest.raises(Unusable) as refused:
        read_tree(Source("spec.yaml", "a: ? b"))
    found = refused.value.finding
    assert found is not None
    assert found.message.startswith("this is not YAML: mapping keys are not allowed ")


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
