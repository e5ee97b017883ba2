"""Rows of one message: encode a MOVE, decode a reply."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from benchmarks import captures, floor, sampling
from benchmarks.results import FLOOR, Results, WrongResultError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from benchmarks.peers.interface import Peer

ENCODE_ROWS = {"encode-1": 1, "encode-6": 6, "encode-32": 32}
"""MOVE for so many servos."""

DECODE_ROWS = {"decode-6": floor.POSITIONS, "decode-battery": floor.BATTERY}
"""A reply of this command; the position reply holds six servos."""

ROWS = (*ENCODE_ROWS, *DECODE_ROWS)

TIME_MS = 1000
FRAMES = {
    floor.POSITIONS: captures.positions_frame([(servo_id, 500) for servo_id in range(1, 7)]),
    floor.BATTERY: captures.battery_frame(7500),
}


@dataclass(frozen=True)
class Case:
    """One contender in one row."""

    contender: str
    statement: str
    """What is timed."""

    result: str
    """The expression for what the statement arrives at."""

    names: Mapping[str, Any]
    """What both of them read."""

    plain: Callable[[Any], object] = lambda value: value
    """The result as the floor gives it."""

    def evaluate(self) -> object:
        """Evaluate the contender's result, in the form of the floor."""
        return self.plain(eval(self.result, dict(self.names)))


def targets(count: int) -> list[tuple[int, int]]:
    """Return the targets from which a MOVE of `count` servos is encoded."""
    return [(servo_id, 500 + servo_id) for servo_id in range(1, count + 1)]


def floor_case(row: str) -> Case:
    """Return the floor's case for this row."""
    if row in ENCODE_ROWS:
        return _encode(FLOOR, floor.encode_move, ENCODE_ROWS[row])
    command = DECODE_ROWS[row]
    return _decode(FLOOR, floor.PARSERS[command], command, lambda value: value)


def peer_case(row: str, peer: Peer) -> Case:
    """Return a peer's case for this row."""
    if row in ENCODE_ROWS:
        return _encode(peer.name, peer.encode_move, ENCODE_ROWS[row])
    command = DECODE_ROWS[row]
    return _decode(
        peer.name, peer.parsers[command], command, lambda message: peer.plain(command, message)
    )


def _encode(contender: str, encode: Callable[..., bytes], count: int) -> Case:
    names = {"encode": encode, "time_ms": TIME_MS, "targets": targets(count)}
    return Case(contender, "encode(time_ms, targets)", "encode(time_ms, targets)", names)


def _decode(
    contender: str, decode: Callable[[bytes], Any], command: int, plain: Callable[[Any], object]
) -> Case:
    names = {"decode": decode, "frame": FRAMES[command]}
    return Case(contender, "decode(frame)", "decode(frame)", names, plain)


def measure(
    row: str, base: Case, cases: Iterable[Case], rounds: int, seconds: float, into: Results
) -> None:
    """Measure these contenders in this row beside the floor, by samples of about `seconds`."""
    expected = base.evaluate()
    floor_sample = sampling.statement_sample(base.statement, base.names, seconds)
    for case in cases:
        given = case.evaluate()
        if given != expected:
            error = WrongResultError(f"gives {given!r}, not {expected!r}")
            into.refuse(row, case.contender, error)
            continue
        sample = sampling.statement_sample(case.statement, case.names, seconds)
        pairs = sampling.between(floor_sample, sample, rounds)
        into.measurements[row, case.contender] = sampling.ratio(pairs)
