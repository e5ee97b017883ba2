"""A device at the end of a line on which bytes take their time and faults happen. No port."""

from __future__ import annotations

import math
from bisect import insort
from operator import itemgetter
from random import Random
from typing import TYPE_CHECKING

from .channel import Channel
from .uart import sampled

if TYPE_CHECKING:
    from .fault_injector import Report
    from .line_faults import LineFaults
    from .virtual_device import VirtualDevice

# How long a frame waits for another one with which to come at once.
COALESCING = 0.02


class Line:
    """A line: bytes of the host go in by `write`; `read` returns those for the host.

    Times are those of the board, which advances event by event as far as it is asked for. With
    `baud`, bytes take their time; without, the rate is that of the protocol all the same, and a
    host that has set another one receives garbage and sends garbage. With `local_echo`, the host's
    adapter returns what the host sends.
    """

    def __init__(
        self,
        board: VirtualDevice,
        *,
        baud: float | None = None,
        local_echo: bool = False,
        faults: LineFaults | None = None,
    ) -> None:
        self.board = board
        self.hung_up = False
        self.local_echo = local_echo
        self._link = board.library.link
        self.baud = self._link.baud if baud is None or math.isinf(baud) else baud
        self._host_baud = self.baud
        seconds_per_byte = 0.0 if baud is None else self._link.bits_per_byte / baud
        self._to_board = Channel(seconds_per_byte)
        self._to_host = Channel(seconds_per_byte)
        self._injector = board.injector(faults)
        self._phase = Random(self.faults.seed)  # noqa: S311 - to be repeated, not to be secret
        # Replies that the board keeps back, and when they go out.
        self._late: list[tuple[float, Report]] = []
        self._coalesced = b""
        self._waits_until = 0.0
        self._hangs_up_at: float | None = None
        self._babble = b""
        self._babble_pause = 0.0
        self._babbles_at: float | None = None
        self._ignores_input = False

    @property
    def faults(self) -> LineFaults:
        """The faults that happen; setting them restarts from their seed."""
        return self._injector.faults

    @faults.setter
    def faults(self, faults: LineFaults) -> None:
        self._injector = self.board.injector(faults)
        self._phase = Random(faults.seed)  # noqa: S311 - to be repeated, not to be secret

    @property
    def host_baud(self) -> float:
        """The rate that the host has set; the board's if no other is known."""
        return self._host_baud

    @host_baud.setter
    def host_baud(self, baud: float | None) -> None:
        known = self.baud if baud is None else baud
        if known == self._host_baud:
            return
        self._host_baud = known
        self.board.event_log.add(
            self.board.now, "line", f"the host is at {known:g} baud, the board at {self.baud:g}"
        )

    @property
    def next_event(self) -> float | None:
        """When something happens next, to the board or to bytes; None while nothing will."""
        moments = (self._next_inside, self._to_host.next_event, self._hangs_up_at)
        return min((moment for moment in moments if moment is not None), default=None)

    @property
    def in_transit(self) -> int:
        """How many bytes of the host are still on their way."""
        return self._to_board.held

    def write(self, data: bytes, moment: float) -> None:
        """Take the bytes that the host sends."""
        if self.hung_up or not data:
            return
        if self.local_echo:
            self._to_host.put(data, moment, self._link.bits_per_byte / self._host_baud)
        read, seconds_per_byte = self._sampled(data, self._host_baud, self.baud)
        for pause, piece in self._injector.hearing(read):
            start = max(moment, self._to_board.free_at) + pause if pause else moment
            self._to_board.put(piece, start, seconds_per_byte)

    def read(self, moment: float) -> list[bytes]:
        """Advance to a moment, and return the pieces that reached the host."""
        while (event := self._next_inside) is not None and event <= moment:
            self._live(event)
        self._live(moment)
        pieces = self._to_host.take(moment)
        if self._hangs_up_at is not None and self._hangs_up_at <= moment:
            self.cut()
        return pieces

    def send(self, data: bytes, moment: float) -> None:
        """Send bytes to the host as they are."""
        if not self.hung_up:
            read, seconds_per_byte = self._sampled(data, self.baud, self._host_baud)
            self._to_host.put(read, moment, seconds_per_byte)

    def reboot(self, seconds: float) -> None:
        """Switch the board off and on: what it has kept back is never sent."""
        self._late.clear()
        self._coalesced = b""
        self.board.reboot(seconds)

    def spurious_output(
        self, data: bytes, per_second: float, moment: float, *, ignore_input: bool
    ) -> None:
        """Send `data` again and again; b"" ends that."""
        self._ignores_input = ignore_input and bool(data)
        self._babble = data
        self._babble_pause = 1 / per_second
        self._babbles_at = moment if data else None

    def cut(self) -> None:
        """Cut the line: the bytes on their way are lost."""
        self.hung_up = True
        self._hangs_up_at = None
        self._coalesced = b""
        self._to_board.clear()
        self._to_host.clear()

    def mend(self) -> None:
        """Repair the line, also if it was only about to be cut."""
        self.hung_up = False
        self._hangs_up_at = None

    @property
    def _next_inside(self) -> float | None:
        """When something happens next in front of the last wire."""
        moments = (
            self._to_board.next_event,
            self.board.next_event,
            self._babbles_at,
            self._waits_until if self._coalesced else None,
            self._late[0][0] if self._late else None,
        )
        return min((moment for moment in moments if moment is not None), default=None)

    def _live(self, moment: float) -> None:
        self.board.advance_to(moment)
        self._send_reports(moment)
        for data in self._to_board.take(moment):
            if not self._ignores_input:
                self.board.hear(data)
                self._send_reports(moment)
        while self._late and self._late[0][0] <= moment:
            self._send_frame(self._late.pop(0)[1], moment)
        if self._coalesced and self._waits_until <= moment:
            self._send_coalesced(moment)
        if self._babbles_at is not None and self._babbles_at <= moment:
            self.send(self._babble, moment)
            self._babbles_at += self._babble_pause

    def _send_reports(self, moment: float) -> None:
        for report in self.board.take():
            for sent in self._injector.reports(report):
                if lateness := self._injector.lateness(sent):
                    insort(self._late, (moment + lateness, sent), key=itemgetter(0))
                else:
                    self._send_frame(sent, moment)

    def _send_frame(self, report: Report, moment: float) -> None:
        if self.hung_up or self._hangs_up_at is not None:
            return
        sending = self._injector.sending(report)
        if sending.waits:
            self._coalesced += b"".join(data for _, data in sending.pieces)
            self._waits_until = moment + COALESCING
            return
        pending, self._coalesced = self._coalesced, b""
        # It is late from when it was due, whatever is still in front of it.
        start = moment
        for pause, data in sending.pieces:
            self.send(pending + data, start + pause)
            start, pending = self._to_host.free_at, b""
        if sending.hangs_up:
            self._hangs_up_at = self._to_host.free_at

    def _send_coalesced(self, moment: float) -> None:
        pending, self._coalesced = self._coalesced, b""
        self.send(pending, moment)

    def _sampled(self, data: bytes, sent_at: float, read_at: float) -> tuple[bytes, float]:
        """Return the bytes that are read for those sent, and the seconds that each takes."""
        bits = self._link.bits_per_byte
        if sent_at == read_at:
            return data, bits / read_at
        read = sampled(data, sent_at, read_at, self._link, self._phase)
        return read, len(data) * bits / sent_at / max(1, len(read))
