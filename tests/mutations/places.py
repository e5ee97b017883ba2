"""The engine of all mutations: the places of a spec, and the spec with something else in one.

A place is the steps to it. What else can stand there, by its key, is in `kinds`; those who ask for
a change say what must become of it.
"""

import copy
import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from typing import Any

from tests.factories import Data, Steps

GONE = "(gone)"


def nodes(value: Any, path: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every value inside a value with its place: mappings and lists before what they hold."""
    for step, inner in _inside(value):
        yield (*path, step), inner
        yield from nodes(inner, (*path, step))


def leaves(value: Any, path: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every text and number with its place; a leaf itself has the place that is given."""
    if not isinstance(value, dict | list):
        yield path, value
    for step, inner in _inside(value):
        yield from leaves(inner, (*path, step))


def having(data: Data, values: Mapping[str, Any]) -> Data:
    """Return a copy with a value at each of these dotted places, or without it where it is GONE."""
    for place, value in values.items():
        steps = (int(step) if step.isdigit() else step for step in place.split("."))
        data = with_(data, *steps, value)
    return data


def texts(value: Any) -> Iterator[tuple[Steps, str]]:
    yield from ((path, leaf) for path, leaf in leaves(value) if isinstance(leaf, str))


def facts(value: Any, path: Steps = ()) -> Iterator[tuple[Steps, Any]]:
    """Yield every fact with its place: leaves, and lists of leaves as one."""
    if isinstance(value, dict) or (isinstance(value, list) and isinstance([*value, 0][0], dict)):
        for step, inner in _inside(value):
            yield from facts(inner, (*path, step))
    else:
        yield path, value


def _inside(value: Any) -> Iterable[tuple[Any, Any]]:
    if isinstance(value, dict):
        return value.items()
    return enumerate(value) if isinstance(value, list) else ()


def at(data: Any, path: Iterable[str | int]) -> Any:
    for step in path:
        data = data[step]
    return data


def with_(data: Data, *path_and_value: Any) -> Data:
    """Return a copy with a value at a place, or without what is GONE; all else is shared."""
    *steps, last, value = path_and_value
    changed = copy.copy(data)
    around: Any = changed
    for step in steps:
        around[step] = copy.copy(around[step])
        around = around[step]
    if isinstance(value, str) and value == GONE:
        del around[last]
    else:
        around[last] = value
    return changed


def changed(value: Any, change: Callable[[Steps, str], str], path: Steps = ()) -> Any:
    """Return a copy in which every text is what `change` makes of it."""
    if isinstance(value, dict):
        return {key: changed(item, change, (*path, key)) for key, item in value.items()}
    if isinstance(value, list):
        return [changed(item, change, (*path, index)) for index, item in enumerate(value)]
    return change(path, value) if isinstance(value, str) else value


def renamed(value: Any, old: str, new: str) -> Any:
    """Return a copy with the name `old` replaced by `new`, keys and formulas included."""
    if isinstance(value, dict):
        # What is typed in a shell is no name of the spec, though it may be the same word.
        return {
            renamed(key, old, new): item
            if key == "verb" and isinstance(item, str)
            else renamed(item, old, new)
            for key, item in value.items()
        }
    if isinstance(value, list):
        return [renamed(item, old, new) for item in value]
    if isinstance(value, str):
        return re.sub(rf"\b{re.escape(old)}\b", lambda _: new, value)
    return value


def differs(one: Any, other: Any) -> bool:
    return json.dumps(one) != json.dumps(other)


def reordered(data: Data, path: Steps, order: Iterable[str]) -> Data:
    """Return a copy in which the keys of the mapping at a place have another order."""
    here = at(data, path)
    return with_(data, *path, {name: here[name] for name in order})


def swaps(names: Iterable[str]) -> Iterator[list[str]]:
    whole = [*names]
    for second in range(1, len(whole)):
        yield [*whole[: second - 1], whole[second], whole[second - 1], *whole[second + 1 :]]


def other_way(direction: str) -> str:
    return " -> ".join(reversed(direction.split(" -> ")))


def dotted(path: Iterable[str | int]) -> str:
    return ".".join(map(str, path))
