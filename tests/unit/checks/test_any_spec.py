"""Any spec, however wrong, is checked without a crash, and refused in plain words."""

import copy
import json
from collections.abc import Iterator
from typing import Any

from framegen.compile import compile_spec
from framegen.language import misfit
from framegen.language.spec import Spec
from framegen.reading.source import Source
from framegen.reading.yamltree import Unusable
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError

from tests.factories import BUSSERVO, Steps, data_of, kiln
from tests.in_turn import in_turn
from tests.mutations.places import at, nodes, with_

words = st.sampled_from(
    [
        *("u8", "u17", "i8", "host -> controller", "host", "1..", "0..0", "-5..99999", "55 55"),
        *("length", "id", "servo_count + 3", "vendor", "vendor, 1", "query", "1.0.0"),
        *("ServoMove", "targets.position"),
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
TREE: Any = data_of(BUSSERVO)
TOP_KEYS = list(TREE)
PATHS = [path for path, _ in nodes(TREE)]


def survives(text: str) -> None:
    """Check `text`, show the findings, and derive a clean spec: no step may raise."""
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
    """Yield the path of one value under each key that the guide's spec shows."""
    seen: set[object] = set()
    for here, _ in nodes(value):
        key = here[-1] if isinstance(here[-1], str) else (here[-2], "[0]")
        if key not in seen:
            seen.add(key)
            yield here


@in_turn("value", lambda: ODD)
def test_anything_in_place_of_a_value_is_reported_in_our_words(value: object) -> None:
    """And never in those of the library that reads it."""
    for path in keys_of_the_language(KILN):
        kinds: set[str] = set()
        try:
            Spec.model_validate(with_(KILN, *path, value))
        except ValidationError as error:
            kinds = {each["type"] for each in error.errors(include_url=False)}
        assert kinds <= {*misfit._MESSAGES, "missing", "extra_forbidden"}, path


@given(st.text() | st.text(alphabet="ab01:-?,[]{}&*!|>'\"%@#~ \n\t"))
def test_any_text_is_checked_without_a_crash(text: str) -> None:
    survives(text)


@given(st.dictionaries(st.sampled_from(TOP_KEYS) | st.text(max_size=8), structures))
def test_any_structure_is_checked_without_a_crash(tree: dict[str, Any]) -> None:
    survives(json.dumps(tree))


@st.composite
def mutated(draw: st.DrawFn) -> str:
    """Return the spec of busservo with one to three of its values replaced, removed or doubled."""
    tree = copy.deepcopy(TREE)
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
            around[path[-1]] = copy.deepcopy(at(TREE, draw(st.sampled_from(PATHS))))
        elif action == "remove":
            del around[path[-1]]
        elif isinstance(around, list):
            around.insert(draw(st.integers(0, len(around))), copy.deepcopy(value))
        elif action == "repeat":
            around[draw(words)] = copy.deepcopy(value)
        else:
            around[draw(words)] = around.pop(path[-1])
    return json.dumps(tree)


@given(mutated())
def test_any_mutation_of_a_spec_is_checked_without_a_crash(text: str) -> None:
    survives(text)
