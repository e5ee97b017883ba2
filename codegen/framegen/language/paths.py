"""Paths into a spec as people write them: `messages.ServoMove.fields.time_ms`."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING, Annotated, Any, get_args, get_origin

from framegen.language.notation import Ids
from framegen.language.spec import Part, Spec
from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.reading.yamltree import KeyPath

_STEP = re.compile(r"(?:^|(?<=.)\.)([^.\[\]]+)|\[([0-9]{1,9})\]")


class NoPath(ValueError):  # noqa: N818 - says what the text is
    """Text that is no path into a spec. `known` are the keys that could stand at its `step`."""

    def __init__(self, message: str, step: str = "", known: tuple[str, ...] = ()) -> None:
        super().__init__(message)
        self.step = step
        self.known = known


def read_path(text: str) -> KeyPath:
    """Read what `dotted` writes. Raises NoPath for what is no path."""
    steps: list[str | int] = []
    at = 0
    while found := _STEP.match(text, at):
        steps.append(found[1] if found[2] is None else int(found[2]))
        at = found.end()
    if at < len(text) or not steps or isinstance(steps[0], int):
        raise NoPath(f"`{text}` is no path into a spec")
    return tuple(steps)


def expect_place(path: KeyPath) -> None:
    """Follow a path through the keys of the language. Raises NoPath where a spec has none such.

    Whatever a mapping may hold under a name of the author's can be there.
    """
    types = {Spec}
    for number, step in enumerate(path):
        found = {inner for each in types for inner in _inside(each, step)}
        if not found:
            known = tuple(dict.fromkeys(key for each in types for key in _keys(each)))
            where = dotted(path[:number])
            what = f"`{where}` has no `{step}`" if where else f"a spec has no `{step}`"
            raise NoPath(what, str(step), known)
        types = found


def _keys(type_: Any) -> Iterator[str]:
    if isinstance(type_, type) and issubclass(type_, Part):
        for name, key in type_.model_fields.items():
            yield key.alias or name


def _inside(type_: Any, step: str | int) -> Iterator[Any]:
    """Yield the types that a value can have at one step into a value of a type."""
    if type_ in (Any, Ids):
        yield Any
    elif get_origin(type_) is dict and isinstance(step, str):
        yield from _plain(get_args(type_)[1])
    elif get_origin(type_) is list and isinstance(step, int):
        yield from _plain(get_args(type_)[0])
    elif isinstance(type_, type) and issubclass(type_, Part):
        for name, key in type_.model_fields.items():
            if step == (key.alias or name):
                yield from _plain(key.annotation)


def _plain(type_: Any) -> Iterator[Any]:
    """Yield the types of a union, without what is said beside them."""
    if get_origin(type_) is Annotated:
        yield from _plain(get_args(type_)[0])
    elif get_origin(type_) in (dict, list) or not get_args(type_):
        yield type_
    else:
        for each in get_args(type_):
            yield from _plain(each)
