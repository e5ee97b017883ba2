"""The peers: one module each, loaded if it is installed and named if it is not."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Mapping

# Module of the peer, and how the tables call it when it is not installed.
MODULES = {
    "construct": "construct",
    "kaitai": "Kaitai Struct",
    "cstruct": "dissect.cstruct",
    "caterpillar": "caterpillar",
    "bitstruct": "bitstruct",
    "xarm": "xarm",
}

NOT_INSTALLED = "not installed"


class UnavailableError(Exception):
    """A peer is installed, but something that it needs is not; the text says what."""


@dataclass(frozen=True)
class Absent:
    """A peer that cannot be measured here, and why."""

    name: str
    reason: str


def load(
    modules: Mapping[str, str] = MODULES, package: str = __name__
) -> tuple[list[Any], list[Absent]]:
    """Return every peer in a package that can be measured, and every one that cannot."""
    present: list[Any] = []
    absent: list[Absent] = []
    for module, name in modules.items():
        loaded = _load(f"{package}.{module}")
        if isinstance(loaded, str):
            absent.append(Absent(name, loaded))
        else:
            present += loaded
    return present, absent


def _load(module: str) -> list[Any] | str:
    """Return the peers of a module, or why there are none."""
    try:
        found: list[Any] = importlib.import_module(module).peers()
    except ModuleNotFoundError as error:
        if (error.name or "").startswith("benchmarks"):
            raise
        return NOT_INSTALLED
    except UnavailableError as error:
        return str(error)
    return found
