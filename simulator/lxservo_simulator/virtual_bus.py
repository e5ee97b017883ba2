"""A virtual bus of servos with its line and port: in the same process, behind a pty or TCP port."""

from __future__ import annotations

from typing import TYPE_CHECKING, Literal

from lxservo.runtime import simulator

from lxservo_simulator.bus import DEFAULT_SERVOS, ServoBus

if TYPE_CHECKING:
    from collections.abc import Iterable

    from typing_extensions import Unpack

    from lxservo_simulator.servo import BusServo


class VirtualBus(simulator.VirtualLine):
    """Virtual servos on one wire, their line and its port; a context manager.

    `via` is "memory" (`port` is then a transport), "pty" (a name such as /dev/pts/3, or `link`) or
    "tcp" (a name such as socket://127.0.0.1:40123, with `host` and `tcp_port`). `baud`,
    `local_echo`, `clock` and `faults` are those of any VirtualLine, which tells what they do.
    """

    def __init__(
        self,
        via: Literal["memory", "pty", "tcp"] = "memory",
        *,
        servos: Iterable[int] = DEFAULT_SERVOS,
        **line: Unpack[simulator.LineSettings],
    ) -> None:
        self.bus = ServoBus(servos)
        super().__init__(self.bus, via, **line)

    @property
    def servos(self) -> dict[int, BusServo]:
        """The servos by number, as they are at this moment."""
        self._nudge()
        return self.bus.servos
