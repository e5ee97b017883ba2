"""A virtual board with its line and port: in the same process, or behind a pty or TCP port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from framewire.simulator.virtual_line import VirtualLine

from busservo_simulator.board import DEFAULT_SERVOS, Board

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from framewire.simulator.virtual_line import LineSettings
    from typing_extensions import Unpack

    from busservo_simulator.action_group import ActionGroup
    from busservo_simulator.battery import Battery
    from busservo_simulator.servo import Servo


class VirtualController(VirtualLine):
    """A virtual board, its line and its port; a context manager.

    `via` is "memory" (`port` is then a transport), "pty" (a name such as /dev/pts/3, or `link`) or
    "tcp" (a name such as socket://127.0.0.1:40123, with `host` and `tcp_port`). `baud`,
    `local_echo`, `clock` and `faults` are those of any VirtualLine, which tells what they do.
    """

    def __init__(
        self,
        via: Literal["memory", "pty", "tcp"] = "memory",
        *,
        servos: Iterable[int] = DEFAULT_SERVOS,
        groups: Mapping[int, ActionGroup] | None = None,
        battery_mv: int = 7500,
        start_report: bool = True,
        **line: Unpack[LineSettings],
    ) -> None:
        self.board = Board(servos, groups, battery_mv=battery_mv, start_report=start_report)
        super().__init__(self.board, via, **line)

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

    def press_button(self, group: int | None, times: int = 1) -> None:
        """Start a group on the board itself, so that unsolicited reports come; None stops it."""
        with self._now():
            if group is None:
                self.board.stop_group()
            else:
                self.board.start_group(group, times)
