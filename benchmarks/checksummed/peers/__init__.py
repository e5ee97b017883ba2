"""The peers that check what they read: one module each, as those without checksums."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks import peers

if TYPE_CHECKING:
    from benchmarks.checksummed.peers.interface import Peer
    from benchmarks.peers import Absent

MODULES = {
    "construct": "construct",
    "kaitai": "Kaitai Struct",
    "lewansoul_lx16a": "lewansoul-lx16a",
    "lewanlib": "lewanlib",
    "dynamixel_sdk": "dynamixel-sdk",
    "pyubx2": "pyubx2",
    "pymodbus": "pymodbus",
}
"""Module of the peer, and how the tables call it when it is not installed."""


def load() -> tuple[list[Peer], list[Absent]]:
    """Return every peer that can be measured, and every one that cannot."""
    return peers.load(MODULES, __name__)
