"""What values, errors and calls of a library are in words: the same on each machine and Python."""

from __future__ import annotations

import random
import re
from enum import Enum
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator
    from types import ModuleType

    # Rows, each a name and a text.
    Rows = Iterator[tuple[str, str]]

_OS = {"characters_written", "filename2", "winerror"}


def chance(*seed: object) -> random.Random:
    """Return random numbers that are the same for the same seed."""
    return random.Random(" ".join(map(str, seed)))  # noqa: S311 - no secret


def told(value: Any) -> str:
    """Return a value in words: whatever of it is public, messages with their bytes."""
    if isinstance(value, (list, tuple)) and type(value) in {list, tuple}:
        return "[" + ", ".join(map(told, value)) + "]"
    if isinstance(value, AttributeError):  # each Python has its own words
        return type(value).__name__
    if isinstance(value, BaseException):
        return f"{type(value).__name__}: {value}{_attributes(value)}"
    if hasattr(value, "to_dict"):
        return f"{value!r} = {value.encode().hex(' ')}"
    if type(value).__module__ == "builtins" or isinstance(value, (Enum, type)):
        return repr(value)
    return f"{value!r}{_attributes(value)}"


def outcome(call: Callable[..., Any], *given: Any, **more: Any) -> str:
    """Return what a call returns, or raises, in words."""
    try:
        return told(call(*given, **more))
    except Exception as error:  # noqa: BLE001 - whatever it is, it is written down
        return told(error)


def lines(texts: Iterable[str]) -> str:
    """Return texts one below the other."""
    return "\n".join(texts)


def normalised(made: ModuleType, text: str) -> str:
    """Return a text without modules that nobody imports, addresses, and what Python guesses."""
    private = rf"\b(?:{made.__name__}\._\w+|framewire)(?:\.\w+)*\."
    text = re.sub(rf"{private}| at 0x[0-9A-Fa-f]+", "", text)
    return re.sub(r"(unexpected keyword argument '\w+')\. Did you mean '\w+'\?", r"\1", text)


def ways(made: ModuleType) -> list[Any]:
    """Return each direction of a library, and None for both."""
    return [None, *made.Direction]


def _attributes(value: Any) -> str:
    # Those of OSError are not the same everywhere, nor are they ours.
    names = (each for each in dir(value) if each[0] != "_" and each not in _OS)
    found = ((each, getattr(value, each, None)) for each in names)
    return "".join(f" {name}={_short(it)}" for name, it in found if not callable(it))


def _short(value: Any) -> str:
    return f"{type(value).__name__}: {value}" if isinstance(value, BaseException) else repr(value)
