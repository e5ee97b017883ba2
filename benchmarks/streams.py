"""Rows of a stream: ten megabytes in pieces and chunks, clean and disturbed."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import partial
from typing import TYPE_CHECKING, Any

from benchmarks import captures, floor, sampling
from benchmarks.results import FLOOR, Results, WrongResultError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from benchmarks.peers.interface import Peer

CHUNKS = (65536, 64, 1)
"""Bytes that one call of `feed` gets: from a file, from a busy port, from a slow one."""

ROWS = {f"stream-{kind}-{chunk}": (kind, chunk) for kind in captures.KINDS for chunk in CHUNKS}

NOISE_ROWS = {f"noise-{kind}": (kind, 64) for kind in captures.KINDS if kind != "clean"}

PIECES = 10
"""The rounds walk through so many pieces of a megabyte, and then begin again."""

_CHECKED = 1 << 15
# Zeros behind a stream let every decoder decide on what it would still hold back at its end.
_TAIL = bytes(260)
_SMALLEST = 1 << 13


@dataclass(frozen=True)
class Case:
    """One contender in the stream rows."""

    contender: str
    decoder: Callable[[], Any]
    """Makes a new decoder with a `feed(data)`."""

    plain: Callable[[list[Any]], list[tuple[int, object]]]
    """The events of a stream as the floor lists them."""

    statement: str = "for chunk in chunks:\n    feed(chunk)"
    """What is timed."""

    names: Mapping[str, Any] = field(default_factory=dict)
    """What the statement reads beside `feed` and `chunks`."""

    whole: bool = False
    """Whether a sample decodes all that it may, or only what fits its time."""

    def messages(self, data: bytes, chunk: int) -> list[tuple[int, object]]:
        """Return all messages of a stream, in the form of the floor."""
        feed = self.decoder().feed
        events: list[Any] = []
        for start in range(0, len(data), chunk):
            events += feed(data[start : start + chunk])
        return self.plain(events)

    def seconds(self, number: int, *, kind: str, chunk: int, size: int) -> float:
        """Return the CPU seconds for the first `size` bytes of a piece."""
        chunks = captures.chunks(kind, number % PIECES, size, chunk)
        names = {**self.names, "decoder": self.decoder, "chunks": chunks}
        return sampling.statement_seconds(self.statement, names, 1, "feed = decoder().feed")


def floor_case() -> Case:
    """Return the floor's case: the framing loop with the floor's own parsers."""
    return Case(FLOOR, floor.FramingLoop, lambda events: events)


def peer_case(peer: Peer) -> Case:
    """Return a peer's case: the same framing loop with its parsers."""
    return Case(
        peer.name,
        partial(floor.FramingLoop, peer.parsers),
        lambda events: [(command, peer.plain(command, message)) for command, message in events],
    )


def measure(
    row: str, cases: Iterable[Case], rounds: int, seconds: float, largest: int, into: Results
) -> None:
    """Measure these contenders in this row.

    A sample is the first `largest` bytes of a piece, or what fits into so many seconds.
    The floor decodes the same bytes before and after.
    """
    kind, chunk = ROWS[row]
    base = floor_case()
    checked = captures.piece(kind, 0)[:_CHECKED] + _TAIL
    expected = base.messages(checked, chunk)
    for case in cases:
        given = case.messages(checked, chunk)
        if given != expected:
            error = WrongResultError(f"finds {len(given)} messages, not the same {len(expected)}")
            into.refuse(row, case.contender, error)
            continue
        size = largest
        if not case.whole:
            taken = case.seconds(0, kind=kind, chunk=chunk, size=_SMALLEST)
            size = min(largest, max(_SMALLEST, int(_SMALLEST * seconds / taken)))
        into.sizes[case.contender] = min(size, into.sizes.get(case.contender, size))
        pairs = sampling.between(
            partial(base.seconds, kind=kind, chunk=chunk, size=size),
            partial(case.seconds, kind=kind, chunk=chunk, size=size),
            rounds,
        )
        into.measurements[row, case.contender] = sampling.ratio(pairs)


def measure_noise(
    row: str, cases: Iterable[Case], rounds: int, largest: int, into: Results
) -> None:
    """Measure what noise costs: each contender against itself on a clean stream of equal size."""
    kind, chunk = NOISE_ROWS[row]
    for case in cases:
        pairs = sampling.between(
            partial(case.seconds, kind="clean", chunk=chunk, size=largest),
            partial(case.seconds, kind=kind, chunk=chunk, size=largest),
            rounds,
        )
        into.measurements[row, case.contender] = sampling.ratio(pairs)
