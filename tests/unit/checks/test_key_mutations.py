"""Each key of the language is held to the examples: a spec that has another value is refused.

One of the specs has every kind of part and field. What the frames of a spec do not show, by nature,
is listed in BLIND, each with the reason, and held to be unseen.
"""

from collections.abc import Iterator
from functools import cache
from typing import Any, TypeAlias

import pytest
from pydantic import ValidationError

from tests.bad_specs import BASES
from tests.factories import DEMO, Data, Steps, compiled_of, compiled_values, data_of
from tests.in_turn import in_turn
from tests.mutations.kinds import OTHER_FACTS, keys_of_the_language, other_facts
from tests.mutations.places import dotted, facts, with_
from tests.rows import Rows

Mutation: TypeAlias = tuple[Steps, Any]

SPECS = {name: data_of(BASES / f"{name}.yaml") for name in ("bus", "scales")}
SPECS["everything"] = data_of(DEMO.with_name("everything.yaml"))

SIGN = "only a number with its highest bit set tells them apart"
DOCUMENT = "without an exchange, only the document knows who sends a message"
NO_ORDER = "a sum does not depend on the order"
ANOTHER_FRAME = "only another frame shows that these bytes differ"
ANYTHING = "reserved bytes are read as anything"
NEVER_CHANGES = "a constant is the same in both"
UNSIGNED = "reserved bytes have no sign"
NO_MANY = "no example has as many"
NO_END = "no example shows this end of the range, as `framegen check` notes"
# By the specs, mutations that no frame shows, each with the reason.
BLIND: dict[tuple[str, ...], dict[str, str]] = {
    ("bus", "scales"): {
        "station.range=1..1": NO_END,
        "length.counts=['payload', 'code', 'family']": NO_ORDER,
        **{f"{name}.type=i8": SIGN for name in ("zero", "reason", "level", "pan")},
        **{f"{name}.type=i16": SIGN for name in ("State.fields.unused", "ages", "wait_s")},
        "grams.type=u24": SIGN,
        "messages.Boil.direction=": DOCUMENT,
        "messages.Note.direction=": DOCUMENT,
        "unused.is=constant": ANOTHER_FRAME,
        "unused.bytes=21": ANYTHING,
    },
    ("everything",): {
        "direction=": DOCUMENT,
        "spare.bytes=06": ANYTHING,
        "spare.is=constant": ANOTHER_FRAME,
        "sum.covers=['payload', 'length', 'mark', 'what']": NO_ORDER,
        **{f"a_u{size}.type=i{size}": SIGN for size in (16, 24, 32, 64)},
        **{f"little_u{size}.type=i{size}": SIGN for size in (16, 32, 64)},
        **{f"{name}.type=i16": SIGN for name in ("mode", "temperature", "mark", "first")},
        "x.type=i24": SIGN,
        **{f"{name}.type=i8": "its range is that of both" for name in ("quality", "second")},
        **{f"{name}.type=i8": NEVER_CHANGES for name in ("layout", "always_one")},
        **{f"{name}.type=i8": UNSIGNED for name in ("padding", "gap", "nothing")},
        "unused.type=i16": UNSIGNED,
        "little_i16.byte_order=": "the bytes of -1 are the same in both orders",
        "a_u8.range=3..3": NO_END,
        "station.range=2..500": NO_END,
        "an_i16.range=-300..-300": NO_END,
        "little_u16.range=2..1000": NO_END,
        "low_bits.range=1..9": NO_END,
        "quality.range=1..100": NO_END,
        "second.range=1..99": NO_END,
        **{f"{name}.range=2..3": "the examples show these" for name in ("a_u8", "second")},
        "readings.count=0..4": NO_MANY,
        "values.count=0..4": NO_MANY,
    },
}


def mutations(name: str) -> Iterator[Mutation]:
    """Yield other facts for each key that says something of frames."""
    for path, value in facts(SPECS[name]):
        if "examples" not in path:
            yield from ((path, other) for other in other_facts(path, value))


def named(mutation: Mutation) -> str:
    return f"{dotted(mutation[0])}={mutation[1]}"


def findings(spec: Data) -> set[str]:
    try:
        return {finding.message for finding in compiled_values(spec).findings}
    except ValidationError:
        return {"it does not fit the language"}


@cache
def found(name: str) -> set[str]:
    return findings(SPECS[name])


@pytest.mark.parametrize("name", Rows(["bus", "scales"], others=["everything"]))
@in_turn("mutation", mutations, ids=named)
def test_another_value_of_a_key_is_refused_or_no_frame_shows_it(
    name: str, mutation: Mutation
) -> None:
    blind = [end for names, seen in BLIND.items() if name in names for end in seen]
    path, value = mutation
    refused = findings(with_(SPECS[name], *path, value)) - found(name)
    assert bool(refused) is not any(end in named(mutation) for end in blind)


def test_each_of_those_that_no_example_shows_is_tried() -> None:
    for names, seen in BLIND.items():
        tried = [named(each) for name in names for each in mutations(name)]
        assert [end for end in seen if not any(end in each for each in tried)] == []


@in_turn("name", lambda: SPECS)
def test_the_specs_themselves_keep_all_rules(name: str) -> None:
    rules = {finding.rule for finding in compiled_of(SPECS[name]).findings}
    assert rules <= ({"unshown-value"} if name == "everything" else set())


def test_every_kind_of_key_is_changed() -> None:
    changed = {path[-1] for name in SPECS for path, _ in mutations(name)}
    assert "seed" in changed
    # A part of an id may be called like anything.
    assert {*OTHER_FACTS} - keys_of_the_language() == {"class"}
    assert {*OTHER_FACTS} <= changed
