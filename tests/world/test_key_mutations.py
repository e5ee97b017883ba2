"""Every key of the language is held to the frames: change a fact, and `framegen check` reports it.

The spec has every kind of part and field. What its frames do not show, by nature, is listed in
BLIND, each with the reason, and held to be unseen.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest
from framegen.reading.yamltree import Unusable

from tests.factories import DEMO, compiled_of, data_of

if TYPE_CHECKING:
    from collections.abc import Iterator

Steps: TypeAlias = "tuple[str | int, ...]"
Mutation: TypeAlias = "tuple[Steps, Any]"

TREE = data_of(DEMO.with_name("everything.yaml"))
GONE = "(gone)"

NO_END = "no example shows this end of the range, as `framegen check` notes"
# Mutations that no frame shows, each with the reason.
BLIND: dict[str, str] = {
    "direction=": "without an exchange, only the document knows who sends a message",
    "spare.bytes=06": "reserved bytes are read as anything",
    "spare.is=constant": "only another frame shows that these bytes differ",
    "sum.covers=['payload', 'length', 'what']": "a sum does not depend on the order",
    "a_u24.type=i24": "only a number with its highest bit set tells them apart",
    "x.type=i24": "only a number with its highest bit set tells them apart",
    "quality.type=i8": "its range is that of both",
    "layout.type=i8": "a constant is the same in both",
    "always_one.type=i8": "a constant is the same in both",
    "padding.type=i8": "reserved bytes have no sign",
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
}


def mutations() -> Iterator[Mutation]:
    """Yield other facts for each key that says something of frames."""
    for steps, value in leaves(TREE):
        if "examples" in steps:
            continue
        for other in others(steps, value):
            yield steps, other


def leaves(value: Any, steps: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every fact; a list of names is one."""
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*steps, key))
    elif isinstance(value, list) and value and isinstance(value[0], dict):
        for index, inner in enumerate(value):
            yield from leaves(inner, (*steps, index))
    else:
        yield steps, value


def others(steps: Steps, value: Any) -> list[Any]:
    """Return what else a fact could be, right or wrong."""
    key = steps[-1]
    if key in ("covers", "counts"):
        fewer = [[each for each in value if each != one] for one in value]
        return fewer + ([value[::-1]] if len(value) > 1 else [])
    if key == "length" and isinstance(value, list):
        return [value[:1], value[1:], [each + 1 for each in value]]
    if key == "length":
        return [f"{value} + 1", f"2 * {value}"] if isinstance(value, str) else [value + 1]
    if key == "range":
        low, high = map(int, value.split(".."))
        return [f"{low + 1}..{high}", f"{low}..{low}"]
    if key == "bytes":
        flipped = bytes(byte ^ 1 for byte in bytes.fromhex(value))
        return [flipped.hex(" ").upper(), f"{value} 00"]
    found: list[Any] = _OTHERS.get(str(key), lambda _: [])(value)
    return found


_SAME_SIZE = {"u8": ("i8",), "i16": ("u16",), "u24": ("i24",), "f32": ("u32",), "u32": ("f32",)}
_OTHERS: dict[str, Any] = {
    "type": lambda value: [
        each for each in (*_SAME_SIZE.get(value, ()), "u8", "u16", "u32") if each != value
    ],
    "byte_order": lambda value: ["big" if value == "little" else "little", GONE],
    "method": lambda _: ["crc-16/umts", "inverted sum", "crc-8/smbus"],
    "sent": lambda _: [GONE],
    "is": lambda value: {"counter": ["address"], "reserved": ["constant"]}.get(value, []),
    "id": lambda value: [value + 1],
    "class": lambda value: [value + 1],
    "kind": lambda value: [value + 1] if isinstance(value, int) else [],
    "version": lambda value: [value + 1] if isinstance(value, int) else [],
    "frame": lambda value: ["tell" if value == "ask" else "ask"],
    "always": lambda value: [value + 1, GONE],
    "reserved": lambda _: [GONE],
    "count": lambda value: [value + 1, value - 1] if isinstance(value, int) else ["0..0"],
    "sized_by": lambda _: [GONE],
    "counted_by": lambda _: [GONE],
    "text": lambda _: [GONE],
    "optional": lambda _: [GONE],
    "direction": lambda value: [" -> ".join(reversed(value.split(" -> ")))],
}


def mutated(steps: Steps, value: Any) -> Any:
    tree = json.loads(json.dumps(TREE))
    around = tree
    for step in steps[:-1]:
        around = around[step]
    if value == GONE:
        del around[steps[-1]]
    else:
        around[steps[-1]] = value
    return tree


def reported(tree: Any) -> set[str]:
    """Return what is found in a spec, and not in the right one."""
    return findings(tree) - findings(TREE)


def findings(tree: Any) -> set[str]:
    try:
        return {finding.message for finding in compiled_of(tree).findings}
    except Unusable as error:
        return {str(error)}


def named(mutation: Mutation) -> str:
    return f"{'.'.join(map(str, mutation[0]))}={mutation[1]}"[:100]


def blind(mutation: Mutation) -> str:
    """Return why no frame shows a mutation; empty for one that is to be reported."""
    return next((why for end, why in BLIND.items() if end in named(mutation)), "")


MUTATIONS = {named(each): each for each in mutations()}
SEEN = [each for each in MUTATIONS.values() if not blind(each)]
UNSEEN = [each for each in MUTATIONS.values() if blind(each)]


@pytest.mark.parametrize("mutation", SEEN, ids=map(named, SEEN))
def test_a_changed_key_is_reported(mutation: Mutation) -> None:
    assert reported(mutated(*mutation)) != set()


@pytest.mark.parametrize("mutation", UNSEEN, ids=map(named, UNSEEN))
def test_what_no_frame_shows_is_listed(mutation: Mutation) -> None:
    assert reported(mutated(*mutation)) == set()


def test_every_reason_is_one_of_a_mutation() -> None:
    assert {*map(blind, UNSEEN)} == {*BLIND.values()}


def test_the_spec_itself_keeps_all_rules() -> None:
    assert {finding.rule for finding in compiled_of(TREE).findings} <= {"unshown-value"}
