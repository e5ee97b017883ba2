"""Each key of the language is held to the examples: a spec that has another value is refused."""

from __future__ import annotations

import copy
import json
from typing import TYPE_CHECKING, Any, TypeAlias

import pytest
from framegen.compile import compile_spec
from framegen.language.number_types import NUMBER_TYPES
from framegen.model.checksums import CHECKSUMS
from framegen.reading.source import Source

from tests.bad_specs import BASES
from tests.factories import data_of
from tests.in_turn import in_turn

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

    from tests.factories import Steps

Mutation: TypeAlias = "tuple[Steps, Any]"

SPECS = {name: data_of(BASES / f"{name}.yaml") for name in ("bus", "scales")}
GONE = object()


def nodes(value: Any, steps: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every value with its place."""
    yield steps, value
    inside = value.items() if isinstance(value, dict) else ()
    for step, inner in inside:
        yield from nodes(inner, (*steps, step))


def shorter(names: list[str]) -> list[list[str]]:
    """Leave out one name after the other."""
    return [names[:at] + names[at + 1 :] for at in range(len(names))]


def of_other_sizes(type_: str) -> list[str]:
    size = NUMBER_TYPES[type_].size if type_ in NUMBER_TYPES else 0
    return [name for name, each in NUMBER_TYPES.items() if each.size != size]


def methods(method: str) -> list[str]:
    """Return the other methods of the same width."""
    widths = CHECKSUMS[method].widths
    return [name for name, row in CHECKSUMS.items() if name != method and row.widths == widths]


def flipped(data: str) -> list[str]:
    first, *rest = bytes.fromhex(data)
    return [bytes([first ^ 1, *rest]).hex(" "), f"{data} 00"]


# Other values of a key that say something else.
OTHERS: dict[str, Callable[[Any], list[Any]]] = {
    "type": of_other_sizes,
    "covers": lambda names: [*shorter(names), names[:1], names[::-1]],
    "counts": shorter,
    "method": methods,
    "bytes": flipped,
    "id": lambda number: [number + 1],
    "always": lambda value: [value + 1],
    "count": lambda count: [count - 1, count + 1] if isinstance(count, int) else ["0..4"],
    "length": lambda rule: [rule + 1 if isinstance(rule, int) else f"{rule} + 1"],
    "range": lambda _: ["2..3"],
    "byte_order": lambda order: ["big" if order == "little" else "little"],
    "text": lambda _: [GONE],
    "optional": lambda _: [GONE],
    "sized_by": lambda _: [GONE],
    "sent": lambda _: [True],
}


def mutations(name: str) -> Iterator[Mutation]:
    for steps, value in nodes(SPECS[name]):
        # An id of several is a mapping, and a part or a field may be called like a key.
        key = "id" if steps[-2:-1] == ("id",) else steps[-1] if steps else ""
        if key in OTHERS and not isinstance(value, dict):
            found = OTHERS[str(key)](value)
            # Whatever is reserved may be anything, of the same size.
            reserved = "unused" in steps and key == "bytes"
            yield from ((steps, other) for other in found[reserved:])


def mutated(name: str, steps: Steps, value: Any) -> str:
    """Return a spec with another value, or without that key."""
    data = copy.deepcopy(SPECS[name])
    around: Any = data
    for step in steps[:-1]:
        around = around[step]
    if value is GONE:
        del around[steps[-1]]
    else:
        around[steps[-1]] = value
    return json.dumps(data)


def named(mutation: Mutation) -> str:
    steps, value = mutation
    return f"{'.'.join(map(str, steps))}={'gone' if value is GONE else value}"


@pytest.mark.parametrize("name", SPECS)
@in_turn("mutation", mutations, ids=named)
def test_another_value_of_a_key_is_refused(name: str, mutation: Mutation) -> None:
    assert compile_spec(Source("mutated.yaml", mutated(name, *mutation))).findings


def test_every_kind_of_key_is_changed() -> None:
    assert {steps[-1] for name in SPECS for steps, _ in mutations(name)} >= {*OTHERS, "seed"}
