"""Edits of YAML text: what is written is read back, and nothing else changes."""

from typing import Any

import pytest
from framegen.reading.source import Source
from framegen.reading.yamledit import NoPlace, YamlEditor
from framegen.reading.yamltext import block, flow
from framegen.reading.yamltree import read_tree
from hypothesis import given
from hypothesis import strategies as st

VISIBLE = st.characters(blacklist_categories=["C", "Z", "M"]) | st.sampled_from(
    " \n:#-'\"{}[],&*!?|>%@`~"
)
TEXTS = (
    st.text(VISIBLE, max_size=12)
    | st.sampled_from(["no", "1.0", "010", "1:30", "null", "~", "a: b", "a #b", "2020-01-01", "<<"])
    | st.sampled_from(["true", "0x1F", "- a", "a:", " a", "a ", "messages.X.fields.y", "=", "1_0"])
)
VALUES = st.recursive(
    TEXTS | st.integers(-(10**6), 10**6) | st.booleans() | st.none(),
    lambda inner: st.lists(inner, max_size=3) | st.dictionaries(TEXTS, inner, max_size=3),
    max_leaves=8,
)


def value_of(text: str) -> Any:
    tree, findings = read_tree(Source("made_up.yaml", text))
    assert findings == []
    return tree.data


@given(st.dictionaries(TEXTS, VALUES, min_size=1, max_size=3))
def test_what_is_written_is_read_back(value: dict[str, Any]) -> None:
    assert value_of("\n".join(block(value))) == value
    assert value_of(flow(value)) == value


def test_text_is_written_without_quotes_where_it_can_be() -> None:
    entry = {"version": "1.0.0", "changes": ["LampFade is new.", "A: b"], "id": 7, "none": []}
    assert flow(entry) == '{version: "1.0.0", changes: [LampFade is new., "A: b"], id: 7, none: []}'
    assert list(block([entry])) == [
        '- version: "1.0.0"',
        "  changes:",
        "    - LampFade is new.",
        '    - "A: b"',
        "  id: 7",
        "  none: []",
    ]


OLD = {"version": "1.0.0", "changes": ["It."]}
NEW = {"version": "1.1.0", "changes": ["More."]}
LAYOUTS = [
    "a: 1\nhistory:\n  # the latest first\n  - version: '1.0.0'  # so\n    changes: [It.]\nb: 2",
    'a: 1\nhistory:\n- {version: "1.0.0", changes: [It.]}\nb: 2',
    "a: 1\nhistory:\n      -   version: 1.0.0\n          changes: [It.]\nb: 2\n# the end\n",
    'a: 1\nhistory: [{version: "1.0.0", changes: [It.]}]\nb: 2\n',
    'a: 1\nhistory: [\n  {version: "1.0.0",\n   changes: [It.]},\n]\nb: 2\n',
]


def edited(text: str, *edits: tuple[str, Any, Any]) -> str:
    source = Source("made_up.yaml", text)
    editor = YamlEditor(source, read_tree(source)[0])
    for how, path, value in edits:
        getattr(editor, how)(path, value)
    return editor.text()


@pytest.mark.parametrize("text", LAYOUTS)
def test_edits_of_any_layout_say_what_they_should_and_leave_the_rest(text: str) -> None:
    first, version = ("history",), ("history", 0, "version")
    breaks = {"breaks": {"link.baud": "Faster: 9600."}}
    done = edited(
        text,
        ("put_first", first, [NEW]),
        ("replace", version, "1.0.1"),
        ("put_behind", version, breaks),
        ("put_first", (*version[:2], "changes"), ["That."]),
    )
    changed = {"version": "1.0.1", "changes": ["That.", "It."], **breaks}
    assert value_of(done) == {"a": 1, "b": 2, "history": [NEW, changed]}
    for word in ("# the latest first", "# so", "# the end", "b: 2"):
        assert done.count(word) == text.count(word)
    again = edited(done, ("put_in", ("history", 1, "breaks"), {"frame": "Longer."}))
    assert value_of(again)["history"][1]["breaks"] == {"frame": "Longer.", **breaks["breaks"]}


@pytest.mark.parametrize("end", ["", "\n", "\n\n", "\n# the end"])
def test_a_list_that_is_not_there_begins_at_the_end(end: str) -> None:
    done = edited(f"a: 1{end}", ("put_first", ("b",), [7]), ("put_first", ("history",), [OLD]))
    assert value_of(done) == {"a": 1, "b": [7], "history": [OLD]}
    assert done.startswith(f"a: 1{end}")
    assert value_of(edited("a: []", ("put_first", ("a",), ["x", 1]))) == {"a": ["x", 1]}


def test_what_has_no_place_is_refused() -> None:
    for text, how, path in (
        ("a: 1", "replace", ("b",)),
        ("a:\n  - - 1", "put_first", ("a", 0)),
        ("a: {b: 1}", "put_first", ("a", "c")),
    ):
        with pytest.raises(NoPlace):
            edited(text, (how, path, [2]))
