"""A second opinion: editions that authors might publish, and what they know that they changed.

`editions("busservo")` is a strategy; `after(spec, names, seed)` is one of its results, made again.
"""

import json
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cache, partial

from framegen.comparison.edition import Edition
from hypothesis import strategies as st

from tests.factories import BUSSERVO, Data, data_of
from tests.mutations.authors import Author, edition_of, marked
from tests.mutations.desk import Desk, Inapplicable
from tests.mutations.field_mutations import FIELD_MUTATIONS
from tests.mutations.frame_mutations import FRAME_MUTATIONS
from tests.mutations.list_mutations import LIST_MUTATIONS
from tests.mutations.message_mutations import MESSAGE_MUTATIONS
from tests.mutations.value_mutations import VALUE_MUTATIONS
from tests.mutations.word_mutations import WORD_MUTATIONS
from tests.protocols.specs import FILES

MUTATIONS: dict[str, Callable[[Desk], None]] = {
    **(FIELD_MUTATIONS | VALUE_MUTATIONS | LIST_MUTATIONS),
    **(MESSAGE_MUTATIONS | FRAME_MUTATIONS | WORD_MUTATIONS),
}
# So many changes are made at once, at most.
AT_ONCE = 3
_FOLDER = BUSSERVO.parents[1] / "tests" / "specs"
SPECS = {
    "busservo": BUSSERVO,
    **FILES,
    **{name: _FOLDER / f"{name}.yaml" for name in ("demo", "blinds", "lamp", "weather")},
}


@dataclass(frozen=True, eq=False)
class Editions:
    """Two editions of a spec, and who made the one from the other."""

    name: str
    old: Edition
    new: Edition
    author: Author

    def __repr__(self) -> str:
        return self.name

    @property
    def turned(self) -> "Editions":
        return Editions(f"{self.name}, turned", self.new, self.old, self.author.turned)


@cache
def _first(spec: str) -> tuple[str, Edition]:
    """Return a spec as it is, marked, and its edition."""
    data = marked(data_of(SPECS[spec]))
    edition = edition_of(data, "old")
    assert edition is not None, spec
    return json.dumps(data), edition


def after(spec: str, names: Sequence[str], seed: int = 0) -> Editions | None:
    """Return a spec before and after some mutations; None where they do not fit it."""
    text, old = _first(spec)
    return _mutated(spec, json.loads(text), old, names, seed)


def after_data(data: Data, names: Sequence[str], seed: int = 0) -> Editions | None:
    before = marked(data)
    old = edition_of(before, "old")
    return None if old is None else _mutated("made up", before, old, names, seed)


def _mutated(
    spec: str, before: Data, old: Edition, names: Sequence[str], seed: int
) -> Editions | None:
    changed: Data = json.loads(json.dumps(before))
    desk = Desk(changed, random.Random(f"{seed} {names}"))  # noqa: S311 - no secret
    try:
        for name in names:
            MUTATIONS[name](desk)
    except Inapplicable:
        return None
    new = edition_of(changed, "new")
    title = f"after({spec!r}, {[*names]!r}, {seed})"
    return None if new is None else Editions(title, old, new, Author(before, changed))


def places(name: str, seed: int) -> Iterator[Editions]:
    """Yield what a mutation makes of the specs in which it has a place, in an order by lot.

    Of each, the one or the other edition comes first.
    """
    chance = random.Random(f"{seed} {name}")  # noqa: S311 - no secret
    for spec in chance.sample([*SPECS], len(SPECS)):
        made = after(spec, [name], chance.randrange(100)) or after(spec, [name], 0)
        if made is not None:
            yield made.turned if chance.randrange(2) else made


@st.composite
def editions(draw: st.DrawFn, spec: str) -> Editions:
    """Draw two editions of a spec, one to three mutations apart, either way round."""
    several = st.lists(st.sampled_from([*MUTATIONS]), min_size=1, max_size=AT_ONCE)
    any_ = st.builds(partial(after, spec), several, st.integers(0, 999))
    made = draw(any_.filter(lambda each: each is not None))
    assert made is not None
    return made.turned if draw(st.booleans()) else made
