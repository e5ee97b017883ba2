"""A virtual bus of servos with its line and port: in the same process, behind a pty or TCP port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from framewire.simulator.tcp_end import LOOPBACK
from framewire.simulator.virtual_line import VirtualLine

from lxservo_simulator.bus import DEFAULT_SERVOS, ServoBus

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable

    from framewire.simulator.clock import Clock
    from framewire.simulator.line_faults import LineFaults

    from lxservo_simulator.servo import BusServo


class VirtualBus(VirtualLine):
    """Virtual servos on one wire, their line and its port; a context manager.

    `via` is "memory" (`port` is then a transport), "pty" (a name such as /dev/pts/3, or `link`) or
    "tcp" (a name such as socket://127.0.0.1:40123). With `baud`, bytes take the time both ways that
    they take on a wire; without it none, for quick tests, unlike the command, whose rate is that of
    the protocol. With `local_echo`, the adapter returns what the host sends, as on a wire
    that both ends share. With a VirtualClock, time stands still until `advance`.
    """

    def __init__(
        self,
        via: Literal["memory", "pty", "tcp"] = "memory",
        *,
        servos: Iterable[int] = DEFAULT_SERVOS,
        baud: float | None = None,
        local_echo: bool = False,
        clock: Clock | None = None,
        faults: LineFaults | None = None,
        link: str | os.PathLike[str] | None = None,
        host: str = LOOPBACK,
        tcp_port: int = 0,
    ) -> None:
        self.bus = ServoBus(servos)
        super().__init__(
            self.bus,
            via,
            baud=baud,
            local_echo=local_echo,
            clock=clock,
            faults=faults,
            link=link,
            host=host,
            tcp_port=tcp_port,
        )

    @property
    def servos(self) -> dict[int, BusServo]:
        """The servos by number, as they are at this moment."""
        self._nudge()
        return self.bus.servos
