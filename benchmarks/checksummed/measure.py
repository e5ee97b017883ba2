"""Measuring frames with checksums: the generated library and its peers against the floor."""

from __future__ import annotations

from typing import TYPE_CHECKING

from benchmarks import messages
from benchmarks.checksummed import library
from benchmarks.checksummed.rows import ROWS
from benchmarks.messages import Case
from benchmarks.results import FLOOR

if TYPE_CHECKING:
    from collections.abc import Sequence

    from benchmarks.checksummed.peers.interface import Peer
    from benchmarks.checksummed.rows import Row
    from benchmarks.results import Results


def measure(name: str, present: Sequence[Peer], rounds: int, seconds: float, into: Results) -> None:
    """Measure all contenders in a row, by samples of about `seconds`."""
    row = ROWS[name]
    cases = library.cases(row)
    cases += [_peer_case(row, peer) for peer in present if name in peer.works]
    base = Case(FLOOR, _statement(row), _statement(row), {**row.given, "work": row.by_hand})
    messages.measure(name, base, cases, rounds, seconds, into)


def _peer_case(row: Row, peer: Peer) -> Case:
    work = peer.works[row.name]
    names = {**row.given, "work": work.do}
    return Case(peer.name, _statement(row), _statement(row), names, work.plain)


def _statement(row: Row) -> str:
    return f"work({', '.join(row.given)})"
