"""Every key of the language is held to the frames: change a fact, and `framegen check` reports it.

The spec has every kind of part and field. What its frames do not show, by nature, is listed in
BLIND, each with the reason, and held to be unseen.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

from pydantic import ValidationError

from tests.factories import DEMO, compiled_of, compiled_values, data_of
from tests.in_turn import in_turn
from tests.mutations.kinds import other_facts
from tests.mutations.places import dotted, facts, with_

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.factories import Steps

Mutation: TypeAlias = "tuple[Steps, Any]"

TREE = data_of(DEMO.with_name("everything.yaml"))

SIGN = "only a number with its highest bit set tells them apart"
NO_MANY = "no example has as many"
NO_END = "no example shows this end of the range, as `framegen check` notes"
# Mutations that no frame shows, each with the reason.
BLIND: dict[str, str] = {
    "direction=": "without an exchange, only the document knows who sends a message",
    "spare.bytes=06": "reserved bytes are read as anything",
    "spare.is=constant": "only another frame shows that these bytes differ",
    "sum.covers=['payload', 'length', 'mark', 'what']": "a sum does not depend on the order",
    **{f"a_u{size}.type=i{size}": SIGN for size in (16, 24, 32, 64)},
    **{f"little_u{size}.type=i{size}": SIGN for size in (16, 32, 64)},
    **{f"{name}.type=i16": SIGN for name in ("mode", "temperature", "mark", "first")},
    "x.type=i24": SIGN,
    "quality.type=i8": "its range is that of both",
    "layout.type=i8": "a constant is the same in both",
    "always_one.type=i8": "a constant is the same in both",
    "padding.type=i8": "reserved bytes have no sign",
    "unused.type=i16": "reserved bytes have no sign",
    "gap.type=i8": "reserved bytes have no sign",
    "nothing.type=i8": "reserved bytes have no sign",
    "little_i16.byte_order=": "the bytes of -1 are the same in both orders",
    "station.range=2..500": NO_END,
    "a_u8.range=3..3": NO_END,
    "an_i16.range=-300..-300": NO_END,
    "little_u16.range=2..1000": NO_END,
    "low_bits.range=1..9": NO_END,
    "quality.range=1..100": NO_END,
    "second.range=1..99": NO_END,
    "second.type=i8": "its range is that of both",
    "a_u8.range=2..3": "the examples show these",
    "second.range=2..3": "the examples show these",
    "readings.count=0..4": NO_MANY,
    "values.count=0..4": NO_MANY,
}


def mutations() -> Iterator[Mutation]:
    """Yield other facts for each key that says something of frames."""
    for path, value in facts(TREE):
        if "examples" not in path:
            yield from ((path, other) for other in other_facts(path, value))


def findings(tree: Any) -> set[str]:
    return {finding.message for finding in compiled_values(tree).findings}


FOUND = findings(TREE)


def is_reported(path: Steps, value: Any) -> bool:
    """Tell whether something is found in a spec, and not in the right one."""
    try:
        return bool(findings(with_(TREE, *path, value)) - FOUND)
    except ValidationError:
        return True


def named(mutation: Mutation) -> str:
    return f"{dotted(mutation[0])}={mutation[1]}"[:100]


def blind(mutation: Mutation) -> str:
    """Return why no frame shows a mutation; empty for one that is to be reported."""
    return next((why for end, why in BLIND.items() if end in named(mutation)), "")


@in_turn("mutation", mutations, ids=named)
def test_a_changed_key_is_reported_unless_no_frame_shows_it(mutation: Mutation) -> None:
    assert is_reported(*mutation) is not bool(blind(mutation))


def test_every_reason_is_one_of_a_mutation() -> None:
    tried = [named(each) for each in mutations()]
    assert [end for end in BLIND if not any(end in each for each in tried)] == []


def test_the_spec_itself_keeps_all_rules() -> None:
    assert {finding.rule for finding in compiled_of(TREE).findings} <= {"unshown-value"}
