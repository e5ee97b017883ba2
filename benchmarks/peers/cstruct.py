"""dissect.cstruct: structures written as C declarations."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from dissect.cstruct import cstruct

from benchmarks import floor
from benchmarks.peers.interface import Peer

if TYPE_CHECKING:
    from collections.abc import Sequence

_C = cstruct(endian="<")
_C.load(
    """
    struct servo { uint8 servo_id; uint16 position; };
    struct servo_move {
        uint16 header; uint8 length; uint8 command;
        uint8 count; uint16 time_ms; servo targets[count];
    };
    struct servo_positions {
        uint16 header; uint8 length; uint8 command; uint8 count; servo positions[count];
    };
    struct battery_voltage { uint16 header; uint8 length; uint8 command; uint16 voltage_mv; };
    struct group_report {
        uint16 header; uint8 length; uint8 command; uint8 group; uint16 times;
    };
    struct group_stopped { uint16 header; uint8 length; uint8 command; };
    """
)


class Cstruct(Peer):
    """Structures compiled by dissect.cstruct, which is its default."""

    name = "dissect.cstruct"
    distribution = "dissect.cstruct"
    import_statement = "import dissect.cstruct"

    def __init__(self) -> None:
        super().__init__()
        self.parsers = {
            floor.ACTION_GROUP_STARTED: _C.group_report,
            floor.ACTION_GROUP_STOPPED: _C.group_stopped,
            floor.ACTION_GROUP_COMPLETED: _C.group_report,
            floor.BATTERY: _C.battery_voltage,
            floor.POSITIONS: _C.servo_positions,
        }

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode by `dumps` of an instance; count and length are given, as nothing is derived."""
        count = len(targets)
        servo = _C.servo
        move = _C.servo_move(
            header=0x5555,
            length=3 * count + 5,
            command=floor.MOVE,
            count=count,
            time_ms=time_ms,
            targets=[servo(servo_id=servo_id, position=position) for servo_id, position in targets],
        )
        frame: bytes = move.dumps()
        return frame

    def plain(self, command: int, message: Any) -> object:
        """Return a structure's values, read by attribute."""
        if command == floor.POSITIONS:
            return tuple((servo.servo_id, servo.position) for servo in message.positions)
        if command == floor.BATTERY:
            return message.voltage_mv
        if command == floor.ACTION_GROUP_STOPPED:
            return None
        return message.group, message.times


def peers() -> list[Peer]:
    """Return the peers of dissect.cstruct."""
    return [Cstruct()]
