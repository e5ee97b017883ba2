"""The peers: one module each, loaded if it is installed and named if it is not."""

from __future__ import annotations

import importlib
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from benchmarks.peers.interface import Peer

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


def load() -> tuple[list[Peer], list[Absent]]:
    """Return every peer that can be measured, and every one that cannot."""
    present: list[Peer] = []
    absent: list[Absent] = []
    for module, name in MODULES.items():
        loaded = _load(module)
        if isinstance(loaded, str):
            absent.append(Absent(name, loaded))
        else:
            present += loaded
    return present, absent


def _load(module: str) -> list[Peer] | str:
    """Return the peers of a module, or why there are none."""
    try:
        found: list[Peer] = importlib.import_module(f"benchmarks.peers.{module}").peers()
    except ModuleNotFoundError as error:
        if (error.name or "").startswith("benchmarks"):
            raise
        return NOT_INSTALLED
    except UnavailableError as error:
        return str(error)
    return found
