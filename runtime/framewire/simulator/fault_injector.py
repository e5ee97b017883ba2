"""The fault injector: applies faults to what passes on any line."""

from __future__ import annotations

from random import Random
from typing import TYPE_CHECKING, NamedTuple, Protocol

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..client.library import Library
    from .line_faults import LineFaults


class Report(Protocol):
    """What a device sends."""

    def encode(self) -> bytes:
        """Return its frame."""
        ...


class Sending(NamedTuple):
    """A frame on its way: pieces, each behind a pause in seconds, and what happens after."""

    pieces: list[tuple[float, bytes]]
    waits: bool = False
    hangs_up: bool = False


class FaultInjector:
    """One run of faults, repeatable by their seed, on the line of a library."""

    def __init__(self, faults: LineFaults, library: Library) -> None:
        self.faults = faults
        # What answers a question, and what no noise holds.
        self._replies = tuple(library.answers)
        self._headers = sorted(library.codec.heads.telling)
        self._random = Random(faults.seed)  # noqa: S311 - to be repeated, not to be secret

    def reports(self, report: Report) -> Iterator[Report]:
        """Yield the reports that are sent in place of `report`."""
        if isinstance(report, self._replies) and self._happens(self.faults.dropped):
            return
        report = self.changed(report)
        yield report
        if isinstance(report, self._replies) and self._happens(self.faults.duplicated):
            yield report

    def changed(self, report: Report) -> Report:
        """Return what is sent in place of a report."""
        return report

    def frame(self, report: Report) -> bytes:
        """Return the frame of a report, which need not be right."""
        return report.encode()

    def lateness(self, report: Report) -> float:
        """Return how many seconds the board keeps `report` back, 0.0 for none."""
        late = isinstance(report, self._replies) and self._happens(self.faults.late)
        return self.faults.late_by if late else 0.0

    def sending(self, report: Report) -> Sending:
        """Return how the frame of `report` goes out."""
        faults, pause = self.faults, 0.0
        data = self.frame(report)
        if self._happens(faults.delays):
            pause = self._random.uniform(0.0, faults.longest_delay)
        data = self._shortened(self._flipped(data, faults.bit_flips), faults.lost_bytes)
        if self._happens(faults.noise):
            data = self._noise() + data
        if self._happens(faults.hang_up):
            return Sending([(pause, data[: len(data) // 2])], hangs_up=True)
        if len(data) > 1 and self._happens(faults.splits):
            return Sending(self._split(data, pause))
        return Sending([(pause, data)], waits=self._happens(faults.coalesced))

    def hearing(self, data: bytes) -> list[tuple[float, bytes]]:
        """Return how bytes of the host arrive: pieces, each behind a pause in seconds."""
        faults = self.faults
        data = self._flipped(data, faults.bit_flips_to_board)
        if self._happens(faults.noise_to_board):
            data = self._noise() + data
        if len(data) > 1 and self._happens(faults.splits_to_board):
            return self._split(data, 0.0)
        return [(0.0, data)]

    def _happens(self, chance: float) -> bool:
        # Nothing is drawn for what cannot happen: one fault more leaves the others where they were.
        return chance > 0 and self._random.random() < chance

    def _split(self, data: bytes, pause: float) -> list[tuple[float, bytes]]:
        cut = self._random.randrange(1, len(data))
        rest = self._random.uniform(0.001, 0.02)
        return [(pause, data[:cut]), (rest, data[cut:])]

    def _flipped(self, frame: bytes, chance: float) -> bytes:
        if not chance:
            return frame
        data = bytearray(frame)
        for at in range(len(data)):
            if self._happens(chance):
                data[at] ^= 1 << self._random.randrange(8)
        return bytes(data)

    def _shortened(self, frame: bytes, chance: float) -> bytes:
        """Return the frame without the bytes that are lost."""
        if not chance:
            return frame
        return bytes(byte for byte in frame if not self._happens(chance))

    def _noise(self) -> bytes:
        """Return up to eight bytes without a header; a single byte of one may be among them."""
        data = self._random.randbytes(self._random.randrange(1, 9))
        for header in self._headers:
            data = data.replace(header, header[:-1] + bytes([header[-1] ^ 0xFF]))
        return data
