"""Rows of what a library makes public: names, members, signatures and what is said of each."""

from __future__ import annotations

import inspect
import re
from enum import Enum
from importlib import import_module
from typing import TYPE_CHECKING, Any

from tests.characterised.texts import lines

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from types import ModuleType

    from tests.characterised.texts import Rows

SPECIAL = ["iter", "next", "len", "getitem", "enter", "exit", "aenter", "aexit", "aiter", "anext"]
SPECIAL += ["eq", "hash", "repr", "str", "reduce", "call", "contains", "del"]
MODULES = ("messages", "device", "recordings", "strategies", "tables")
_PLAIN = (int, float, str, bytes, tuple, frozenset, dict, Enum, type(None))


def surface_rows(made: ModuleType, files: Mapping[str, str]) -> Rows:
    yield "surface/package", lines([made.__doc__ or "", *made.__all__, *_listed(made)])
    stub = files[f"generated/{made.__name__}/__init__.pyi"]
    told = (re.sub(r"^from \S+ import", "from", each) for each in stub.splitlines())
    yield "surface/stub", lines(sorted(told))
    for name in made.__all__:
        yield f"surface/{name}", _thing(made, name, getattr(made, name))
    for each in MODULES:
        module = import_module(f"{made.__name__}.{each}")
        names = getattr(module, "__all__", None) or _own(module)
        yield f"surface/{each}", lines([module.__doc__ or "", *names])
        for name in names:
            if name not in made.__all__:
                yield f"surface/{each}.{name}", _thing(made, name, getattr(module, name))


def _listed(made: ModuleType) -> list[str]:
    # What has been imported meanwhile is there as well.
    return [each for each in dir(made) if each in made.__all__]


def _own(module: ModuleType) -> list[str]:
    home = module.__name__
    return [
        name
        for name, it in vars(module).items()
        if name[0] != "_" and getattr(it, "__module__", "") == home
    ]


def _home(made: ModuleType, thing: Any) -> str:
    """Return the module that a thing says it is of, unless nobody imports it from there."""
    module: str = getattr(thing, "__module__", None) or ""
    return "" if module.startswith((f"{made.__name__}._", "framewire")) else module


def _thing(made: ModuleType, name: str, thing: Any) -> str:
    if name == "__version__":
        return type(thing).__name__
    if not isinstance(thing, type):
        return lines([_home(made, thing), *_described(name, thing)])
    ours = [each for each in thing.__mro__ if _is_ours(made, each)]
    own = {each for kind in ours for each in vars(kind)}
    public = {each for each in own if each[0] != "_"} | {*getattr(thing, "__members__", ())}
    return lines(
        [
            f"{name} in {_home(made, thing)!r}: {thing.__name__} {thing.__qualname__}",
            " ".join(each.__name__ for each in thing.__mro__),
            _said(thing) if "__doc__" in vars(thing) else "",
            "" if issubclass(thing, Enum) else _signature(thing),
            " ".join(each for each in SPECIAL if f"__{each}__" in own),
            repr(getattr(thing, "__match_args__", None)),
            *(
                line
                for each in sorted(public)
                for line in _described(each, inspect.getattr_static(thing, each), thing)
            ),
        ]
    )


def _is_ours(made: ModuleType, kind: type) -> bool:
    return kind.__module__.partition(".")[0] in {made.__name__, "framewire"}


def _described(name: str, thing: Any, owner: Any = None) -> Iterator[str]:
    """Yield what a member is, or what a package has."""
    bound = thing if owner is None else getattr(owner, name)
    if isinstance(thing, property):
        getter = thing.fget if inspect.isfunction(thing.fget) else None
        yield f".{name}: a property{_signature(getter)}"
    elif inspect.isroutine(bound):
        is_static = isinstance(thing, (staticmethod, classmethod))
        way = "async " if inspect.iscoroutinefunction(bound) else ""
        yield f".{name}: {way}{type(thing).__name__ if is_static else ''}{_signature(bound)}"
    elif isinstance(bound, _PLAIN):
        yield f".{name} = {bound!r}"
        return
    else:
        yield f".{name}: {type(bound).__name__}"
        # What an alias stands for, in its own words.
        if type(bound).__module__ in {"types", "typing"}:
            yield repr(bound)
            return
    yield _said(thing)


def _said(thing: Any) -> str:
    return inspect.cleandoc(getattr(thing, "__doc__", None) or "")


def _signature(thing: Any) -> str:
    try:
        return str(inspect.signature(thing))
    except (TypeError, ValueError):
        return "(?)"
