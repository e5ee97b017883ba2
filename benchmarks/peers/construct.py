"""construct: declarative structures, interpreted, or compiled by `.compile()`."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from construct import (
    Array,
    Byte,
    Const,
    Int16ul,
    Rebuild,
    Struct,
    len_,
    this,
)

from benchmarks import floor
from benchmarks.peers.interface import Peer

if TYPE_CHECKING:
    from collections.abc import Sequence

_SERVO = Struct("servo_id" / Byte, "position" / Int16ul)

_MOVE = Struct(
    "header" / Const(b"\x55\x55"),
    "length" / Rebuild(Byte, 3 * len_(this.targets) + 5),
    "command" / Const(b"\x03"),
    "count" / Rebuild(Byte, len_(this.targets)),
    "time_ms" / Int16ul,
    "targets" / Array(this.count, _SERVO),
)


def _group(command: int) -> Any:
    return Struct(
        "header" / Const(b"\x55\x55"),
        "length" / Const(b"\x05"),
        "command" / Const(bytes([command])),
        "group" / Byte,
        "times" / Int16ul,
    )


_REPLIES = {
    floor.ACTION_GROUP_STARTED: _group(floor.ACTION_GROUP_STARTED),
    floor.ACTION_GROUP_STOPPED: Struct("frame" / Const(b"\x55\x55\x02\x07")),
    floor.ACTION_GROUP_COMPLETED: _group(floor.ACTION_GROUP_COMPLETED),
    floor.BATTERY: Struct(
        "header" / Const(b"\x55\x55"),
        "length" / Const(b"\x04"),
        "command" / Const(b"\x0f"),
        "voltage_mv" / Int16ul,
    ),
    floor.POSITIONS: Struct(
        "header" / Const(b"\x55\x55"),
        "length" / Byte,
        "command" / Const(b"\x15"),
        "count" / Byte,
        "positions" / Array(this.count, _SERVO),
    ),
}


class Construct(Peer):
    """Structures as they are declared."""

    name = "construct"
    distribution = "construct"
    import_statement = "import construct"

    def __init__(self, move: Any = _MOVE, replies: dict[int, Any] = _REPLIES) -> None:
        super().__init__()
        self._move = move
        self.parsers = {command: reply.parse for command, reply in replies.items()}

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode by `build` of a dictionary."""
        servos = [{"servo_id": servo_id, "position": position} for servo_id, position in targets]
        frame: bytes = self._move.build({"time_ms": time_ms, "targets": servos})
        return frame

    def plain(self, command: int, message: Any) -> object:
        """Return a container's values, read by attribute."""
        if command == floor.POSITIONS:
            return tuple((servo.servo_id, servo.position) for servo in message.positions)
        if command == floor.BATTERY:
            return message.voltage_mv
        if command == floor.ACTION_GROUP_STOPPED:
            return None
        return message.group, message.times


class CompiledConstruct(Construct):
    """The same structures, compiled to Python by construct itself."""

    name = "construct, compiled"

    def __init__(self) -> None:
        replies = {command: reply.compile() for command, reply in _REPLIES.items()}
        super().__init__(_MOVE.compile(), replies)


def peers() -> list[Peer]:
    """Return the peers of construct: interpreted and compiled."""
    return [Construct(), CompiledConstruct()]
