"""A virtual board with its line and port: in the same process, or behind a pty or TCP port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from framewire.simulator.tcp_end import LOOPBACK
from framewire.simulator.virtual_line import VirtualLine

from busservo_simulator.board import DEFAULT_SERVOS, Board

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Mapping

    from busservo.device import Report
    from framewire.codec.rejects import Rejects
    from framewire.simulator.clock import Clock

    from busservo_simulator.action_group import ActionGroup
    from busservo_simulator.battery import Battery
    from busservo_simulator.faults import Faults
    from busservo_simulator.servo import Servo


class VirtualController(VirtualLine):
    """A virtual board, its line and its port; a context manager.

    `via` is "memory" (`port` is then a transport), "pty" (a name such as /dev/pts/3, or `link`) or
    "tcp" (a name such as socket://127.0.0.1:40123). With `baud`, bytes take the time both ways
    that they take on a wire; without it none, for quick tests, unlike the command, whose rate is
    that of the protocol. A host that sets another rate on the pty than `baud`, or than that of
    the protocol, receives garbage and sends garbage; "memory" and "tcp" have no rate to set.
    With `local_echo`, the adapter returns what the host sends, in front of what the board sends.
    With a VirtualClock, time stands still until `advance`.
    """

    def __init__(
        self,
        via: Literal["memory", "pty", "tcp"] = "memory",
        *,
        servos: Iterable[int] = DEFAULT_SERVOS,
        groups: Mapping[int, ActionGroup] | None = None,
        battery_mv: int = 7500,
        start_report: bool = True,
        baud: float | None = None,
        local_echo: bool = False,
        clock: Clock | None = None,
        faults: Faults | None = None,
        link: str | os.PathLike[str] | None = None,
        host: str = LOOPBACK,
        tcp_port: int = 0,
    ) -> None:
        self.board = Board(servos, groups, battery_mv=battery_mv, start_report=start_report)
        super().__init__(
            self.board,
            via,
            baud=baud,
            local_echo=local_echo,
            clock=clock,
            faults=faults,
            link=link,
            host=host,
            tcp_port=tcp_port,
        )

    # ---------------------------------------------------------------- what a test looks at

    @property
    def servos(self) -> dict[int, Servo]:
        """The servos by number, as they are at this moment."""
        self._nudge()
        return self.board.servos

    @property
    def battery(self) -> Battery:
        """The battery, as it is at this moment."""
        self._nudge()
        return self.board.battery

    @property
    def rejects(self) -> Rejects:
        """The board's counts of rejected input, by reason."""
        self._nudge()
        return self.board.rejects

    # ---------------------------------------------------------------- what a test can do

    def press_button(self, group: int | None, times: int = 1) -> None:
        """Start a group on the board itself, so that unsolicited reports come; None stops it."""
        with self._changed:
            self._live()
            if group is None:
                self.board.stop_group()
            else:
                self.board.start_group(group, times)
        self._nudge()

    def report(self, report: Report) -> None:
        """Send a report of the board's own."""
        with self._changed:
            self._live()
            self.board.send(report)
        self._nudge()
