"""The board at the end of a line on which bytes take their time and faults happen. No port."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo_simulator.faults import Faults
from busservo_simulator.mischief import Mischief
from busservo_simulator.wire import Wire

if TYPE_CHECKING:
    from busservo_simulator.board import Board

# How long a frame waits for another one with which to come at once.
COALESCING = 0.02


class Line:
    """Bytes of the host go in by `write`; `read` gives those that the host has by then.

    Times are those of the board, which lives as far as it is asked about, event by event.
    """

    def __init__(
        self, board: Board, *, seconds_per_byte: float = 0.0, faults: Faults | None = None
    ) -> None:
        self.board = board
        self.hung_up = False
        self._to_board = Wire(seconds_per_byte)
        self._to_host = Wire(seconds_per_byte)
        self._mischief = Mischief(faults or Faults())
        self._waiting = b""
        self._waits_until = 0.0
        self._hangs_up_at: float | None = None
        self._babble = b""
        self._babble_pause = 0.0
        self._babbles_at: float | None = None
        self._deaf = False

    @property
    def faults(self) -> Faults:
        """The faults that happen; setting them starts anew from their seed."""
        return self._mischief.faults

    @faults.setter
    def faults(self, faults: Faults) -> None:
        self._mischief = Mischief(faults)

    @property
    def next_event(self) -> float | None:
        """When something happens next, to the board or to bytes; None while nothing will."""
        moments = (self._next_inside, self._to_host.next_event, self._hangs_up_at)
        return min((moment for moment in moments if moment is not None), default=None)

    @property
    def unheard(self) -> int:
        """How many bytes of the host are still under way."""
        return self._to_board.held

    def write(self, data: bytes, moment: float) -> None:
        """Takes the bytes that the host sends."""
        if self.hung_up or not data:
            return
        for pause, piece in self._mischief.hearing(data):
            start = max(moment, self._to_board.free_at) + pause if pause else moment
            self._to_board.put(piece, start)

    def read(self, moment: float) -> list[bytes]:
        """Lives until then, and gives the pieces that reached the host; `hung_up` may follow."""
        while (event := self._next_inside) is not None and event <= moment:
            self._live(event)
        self._live(moment)
        pieces = self._to_host.take(moment)
        if self._hangs_up_at is not None and self._hangs_up_at <= moment:
            self.cut()
        return pieces

    def send(self, data: bytes, moment: float) -> None:
        """Sends bytes to the host as they are."""
        if not self.hung_up:
            self._to_host.put(data, moment)

    def babble(self, data: bytes, per_second: float, moment: float, *, deaf: bool) -> None:
        """Sends `data` again and again; without any, ends that."""
        self._deaf = deaf and bool(data)
        self._babble = data
        self._babble_pause = 1 / per_second
        self._babbles_at = moment if data else None

    def cut(self) -> None:
        """Cuts the line: what is under way is lost."""
        self.hung_up = True
        self._hangs_up_at = None
        self._waiting = b""
        self._to_board.clear()
        self._to_host.clear()

    def mend(self) -> None:
        """Makes it whole again, also where it was only about to be cut."""
        self.hung_up = False
        self._hangs_up_at = None

    @property
    def _next_inside(self) -> float | None:
        """When something happens next in front of the last wire."""
        moments = (
            self._to_board.next_event,
            self.board.next_event,
            self._babbles_at,
            self._waits_until if self._waiting else None,
        )
        return min((moment for moment in moments if moment is not None), default=None)

    def _live(self, moment: float) -> None:
        self.board.advance_to(moment)
        self._send_reports(moment)
        for data in self._to_board.take(moment):
            if not self._deaf:
                self.board.hear(data)
                self._send_reports(moment)
        if self._waiting and self._waits_until <= moment:
            self._send_waiting(moment)
        if self._babbles_at is not None and self._babbles_at <= moment:
            self.send(self._babble, moment)
            self._babbles_at += self._babble_pause

    def _send_reports(self, moment: float) -> None:
        for report in self.board.take():
            for told in self._mischief.reports(report):
                self._send_frame(told.encode(), moment)

    def _send_frame(self, frame: bytes, moment: float) -> None:
        if self.hung_up or self._hangs_up_at is not None:
            return
        sending = self._mischief.sending(frame)
        if sending.waits:
            self._waiting += b"".join(data for _, data in sending.pieces)
            self._waits_until = moment + COALESCING
            return
        waiting, self._waiting = self._waiting, b""
        # It is late from when it was due, whatever is still in front of it.
        start = moment
        for pause, data in sending.pieces:
            self._to_host.put(waiting + data, start + pause)
            start, waiting = self._to_host.free_at, b""
        if sending.hangs_up:
            self._hangs_up_at = self._to_host.free_at

    def _send_waiting(self, moment: float) -> None:
        waiting, self._waiting = self._waiting, b""
        self.send(waiting, moment)
