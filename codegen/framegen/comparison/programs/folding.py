"""Folding: one effect for each thing that becomes of what is at a path, with all its names."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from framegen.comparison.effect import Effect

_TOLD = re.compile(r"`([^`]+)`(.*)", re.DOTALL)
_WORD = re.compile(r"\w+")
# What can be said of several names at once.
_PLURALS = {" is gone": " are gone", " is new": " are new", " is refused:": " are refused:"}
# So many names are told of one thing; whoever has these finds the others.
_MOST = 5


def folded(effects: Iterable[Effect]) -> list[Effect]:
    """Return effects with those as one that are of the same things, where the first of them was."""
    found: dict[object, list[Effect]] = {}
    for effect in effects:
        key = (effect.outcome, effect.old, effect.new, effect.breaks, _said(effect))
        found.setdefault(key, []).append(effect)
    return _with_meanings([_as_one(each) for each in found.values()])


def _said(effect: Effect) -> str:
    """Return what an effect says but for the name that it says it of."""
    told = _TOLD.fullmatch(effect.text)
    if effect.outcome == "renamed" or told is None:
        return effect.outcome if told else effect.text
    said = told[2]
    return said if said.startswith((": ", "()", *_PLURALS)) else effect.text


def _as_one(effects: Sequence[Effect]) -> Effect:
    # A class is told before what goes with it.
    first, *others = sorted(effects, key=lambda each: _name(each).count("."))
    if not others:
        return first
    if first.outcome == "renamed":
        return replace(first, text=_shortened([each.text for each in (first, *others)], ", "))
    said = _said(first)
    for one, several in _PLURALS.items():
        if said.startswith(one):
            said = several + said.removeprefix(one)
    names = [f"`{_name(each)}`" for each in (first, *others)]
    return replace(first, text=_shortened(names, " and ") + said)


def _name(effect: Effect) -> str:
    told = _TOLD.fullmatch(effect.text)
    return "" if told is None else told[1]


def _shortened(parts: Sequence[str], last: str) -> str:
    if len(parts) > _MOST:
        parts = [*parts[: _MOST - 1], f"{len(parts) - _MOST + 1} more"]
        last = " and "
    return f"{', '.join(parts[:-1])}{last}{parts[-1]}"


def _with_meanings(effects: list[Effect]) -> list[Effect]:
    """Tell of a named value or bit that moved what its field is taken for, in one effect."""
    for meaning in [each for each in effects if each.outcome == "meaning"]:
        words = {*_WORD.findall(meaning.text)}
        for at, effect in enumerate(effects):
            if effect.outcome == "value" and _is_of(effect, meaning) and _names(effect) & words:
                so = meaning.text.partition(": ")[2]
                effects[at] = replace(effect, text=f"{effect.text}, so {so}")
                effects.remove(meaning)
                break
    return effects


def _is_of(value: Effect, field: Effect) -> bool:
    """Tell whether a named value or bit is one of a field."""
    path, around = value.path, field.path
    return path[: len(around)] == around and path[len(around) : -1] in (("values",), ("bits",))


def _names(effect: Effect) -> set[str]:
    return {str(path[-1]) for path in (effect.old, effect.new) if path}
