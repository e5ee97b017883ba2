"""Rule: a former name belongs to one thing, and to nothing of today."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.named import families, former_names
from framegen.checks.rule import Problem, StructureRule

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

    from framegen.language.spec import Spec
    from framegen.reading.yamltree import KeyPath


def _look(spec: Spec) -> Iterator[Problem]:
    for path, named in families(spec):
        yield from _family(path, named)


def _family(path: KeyPath, named: Mapping[str, object]) -> Iterator[Problem]:
    first: dict[str, tuple[KeyPath, str]] = {}
    for name, thing in named.items():
        for place, former in former_names((*path, name), thing):
            there, owner = first.setdefault(former, (place, name))
            if former == name:
                what = f"`{name}` has that name still"
                yield Problem(place, what, "leave it out: `was` is for names of earlier editions")
            elif former in named:
                what = f"`{former}` is the name of another one, beside `{name}`"
                also = ((*path, former), f"`{former}` is here")
                hint = f"keep one: either `{name}` was called so, or this is `{former}` still"
                yield Problem(place, what, hint, also=also)
            elif there != place:
                what = (
                    f"`{former}` is listed twice"
                    if owner == name
                    else f"`{owner}` and `{name}` cannot both have been called `{former}`"
                )
                hint = "keep it once" if owner == name else "keep it where the meaning went"
                yield Problem(place, what, hint, also=(there, "the first is here"))


RULE = StructureRule(
    id="former-name",
    title="A former name belongs to one thing, and to nothing of today",
    why="`was` tells `framegen diff` what something was called in earlier editions. Of two that "
    "claim a name, only one can have had it, and a name that is in use says nothing of the past.",
    bad="fields: {time_ms: {...}, duration_ms: {was: time_ms, ...}}",
    good="fields: {duration_ms: {was: time_ms, ...}}",
    look=_look,
)
