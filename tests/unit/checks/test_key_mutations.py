"""Each key of the language is held to the examples: a spec that has another value is refused."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, TypeAlias

import pytest
from pydantic import ValidationError

from tests.bad_specs import BASES
from tests.factories import compiled_values, data_of
from tests.in_turn import in_turn
from tests.mutations.kinds import OTHER_FACTS, keys_of_the_language, other_facts
from tests.mutations.places import dotted, facts, with_

if TYPE_CHECKING:
    from collections.abc import Iterator

    from tests.factories import Steps

Mutation: TypeAlias = "tuple[Steps, Any]"

SPECS = {name: data_of(BASES / f"{name}.yaml") for name in ("bus", "scales")}
# What no example shows, each with the reason.
SIGN = "only a number with its highest bit set tells them apart"
BLIND: dict[str, str] = {
    "station.range=1..1": "nothing shows this end of the range, as `framegen check` notes",
    "length.counts=['payload', 'code', 'family']": "a sum does not depend on the order",
    **{f"{name}.type=i8": SIGN for name in ("zero", "reason", "level", "pan")},
    **{f"{name}.type=i16": SIGN for name in ("State.fields.unused", "ages", "wait_s")},
    "grams.type=u24": SIGN,
    **{
        f"messages.{name}.direction=kettle -> host": "without an exchange, only the document knows"
        for name in ("Boil", "Note")
    },
    "unused.is=constant": "only another frame shows that these bytes differ",
    "unused.bytes=21": "reserved bytes are read as anything",
}


def mutations(name: str) -> Iterator[Mutation]:
    for path, value in facts(SPECS[name]):
        if "examples" not in path:
            yield from ((path, other) for other in other_facts(path, value))


def named(mutation: Mutation) -> str:
    return f"{dotted(mutation[0])}={mutation[1]}"


def is_refused(name: str, path: Steps, value: Any) -> bool:
    try:
        return bool(compiled_values(with_(SPECS[name], *path, value)).findings)
    except ValidationError:
        return True


@pytest.mark.parametrize("name", SPECS)
@in_turn("mutation", mutations, ids=named)
def test_another_value_of_a_key_is_refused_unless_no_frame_shows_it(
    name: str, mutation: Mutation
) -> None:
    blind = any(named(mutation).endswith(end) for end in BLIND)
    assert is_refused(name, *mutation) is not blind


def test_each_of_those_that_no_example_shows_is_tried() -> None:
    tried = {named(each) for name in SPECS for each in mutations(name)}
    assert [end for end in BLIND if not any(each.endswith(end) for each in tried)] == []


def test_every_kind_of_key_is_changed() -> None:
    changed = {path[-1] for name in SPECS for path, _ in mutations(name)}
    assert "seed" in changed
    # A part of an id may be called like anything.
    assert {*OTHER_FACTS} - keys_of_the_language() == {"class"}
    # Those of ids of other specs, and a list that is counted, are in tests/world.
    assert {*OTHER_FACTS} - changed == {"class", "kind", "version", "counted_by"}
