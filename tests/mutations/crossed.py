"""Specs crossed with each other: one to three changes, most of them taken from another spec.

`crossed(seed)` is always the same spec, and one that `framegen check` accepts: lengths and examples
are made to match, and what is refused all the same is drawn anew.
"""

import json
import random
from dataclasses import dataclass
from functools import cache

from framegen.compile import Compiled
from framegen.reading.yamltree import Unusable

from tests.bad_specs import BASES
from tests.factories import compiled_of, data_of
from tests.mutations import mutations
from tests.mutations.authors import edition_of, marked
from tests.mutations.desk import Desk, Inapplicable
from tests.mutations.field_mutations import FIELD_MUTATIONS
from tests.mutations.frame_mutations import FRAME_MUTATIONS
from tests.mutations.list_mutations import LIST_MUTATIONS
from tests.mutations.splices import SPLICES

SPECS = {
    **mutations.SPECS,
    **{name: BASES / f"{name}.yaml" for name in ("bus", "lamps", "scales", "vents")},
}
# So many changes are made at once, at most; every so many is one that no other spec gives.
AT_ONCE, OWN = 3, 4
# What says something else of the same frames is compared elsewhere.
CHANGES = {**FIELD_MUTATIONS, **LIST_MUTATIONS, **FRAME_MUTATIONS}
_MOST = 500


@dataclass(frozen=True)
class Crossed:
    """A spec that was crossed, in words; `tries` is how many were made until one was accepted."""

    seed: int
    words: str
    compiled: Compiled
    tries: int


@cache
def crossed(seed: int) -> Crossed:
    chance = random.Random(f"crossed {seed}")  # noqa: S311 - no secret
    for tries in range(1, _MOST):
        words, compiled = _tried(chance)
        if compiled is not None:
            return Crossed(seed, words, compiled, tries)
    raise AssertionError(f"none of {_MOST} specs is accepted")


def _tried(chance: random.Random) -> tuple[str, Compiled | None]:
    """Return a crossed spec in words; None where `check` refuses it, or there was no place."""
    names = [*SPECS]
    mine = chance.choice(names)
    host = Desk(_spec(mine), chance)
    said = []
    try:
        for _ in range(chance.randint(1, AT_ONCE)):
            if chance.randrange(OWN):
                theirs = chance.choice(names)
                what = SPLICES[chance.choice([*SPLICES])](host, Desk(_spec(theirs), chance))
                said.append(f"gets from {theirs} {what}")
            else:
                name = chance.choice([*CHANGES])
                CHANGES[name](host)
                said.append(f"has a change, {name}")
    except Inapplicable:
        return "", None
    edition = edition_of(host.spec, "crossed")
    if edition is None:
        return "", None
    return f"{mine} {', and '.join(said)}", _accepted(edition.compiled.tree.data)


def _spec(name: str) -> dict[str, object]:
    spec: dict[str, object] = json.loads(_text(name))
    return spec


@cache
def _text(name: str) -> str:
    return json.dumps(marked(data_of(SPECS[name])))


def _accepted(data: dict[str, object]) -> Compiled | None:
    try:
        compiled = compiled_of(data)
    except Unusable:
        return None
    return None if compiled.findings else compiled
