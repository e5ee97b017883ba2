"""caterpillar: structures written as annotated classes."""

# Annotations are not postponed in this module: caterpillar reads them as objects.

from collections.abc import Sequence
from functools import partial
from typing import Annotated, Any

from caterpillar.py import LittleEndian, pack, struct, this, uint8, uint16, unpack

from benchmarks import floor
from benchmarks.peers.interface import Peer


@struct(order=LittleEndian)
class Servo:
    """An element of a move or of a position reply."""

    servo_id: Annotated[int, uint8]
    position: Annotated[int, uint16]


@struct(order=LittleEndian)
class ServoMove:
    """The request; the time lies between the count and what it counts."""

    header: Annotated[bytes, b"\x55\x55"]
    length: Annotated[int, uint8]
    command: Annotated[bytes, b"\x03"]
    count: Annotated[int, uint8]
    time_ms: Annotated[int, uint16]
    targets: Annotated[list[Servo], Servo[this.count]]


@struct(order=LittleEndian)
class ServoPositions:
    """The reply; its elements are prefixed by their count."""

    header: Annotated[bytes, b"\x55\x55"]
    length: Annotated[int, uint8]
    command: Annotated[bytes, b"\x15"]
    positions: Annotated[list[Servo], Servo[uint8::]]


@struct(order=LittleEndian)
class BatteryVoltage:
    """The battery reply."""

    header: Annotated[bytes, b"\x55\x55\x04\x0f"]
    voltage_mv: Annotated[int, uint16]


@struct(order=LittleEndian)
class GroupReport:
    """The report that an action group started or completed."""

    header: Annotated[bytes, b"\x55\x55\x05"]
    command: Annotated[int, uint8]
    group: Annotated[int, uint8]
    times: Annotated[int, uint16]


@struct(order=LittleEndian)
class GroupStopped:
    """The report that an action group was stopped."""

    frame: Annotated[bytes, b"\x55\x55\x02\x07"]


# To a type checker the classes have no constructor: it is the decorator that makes one.
_new_servo: Any = Servo
_new_move: Any = ServoMove


class Caterpillar(Peer):
    """`pack` and `unpack` of caterpillar's own classes."""

    name = "caterpillar"
    distribution = "caterpillar-py"
    import_statement = "import caterpillar.py"

    def __init__(self) -> None:
        super().__init__()
        self.parsers = {
            floor.ACTION_GROUP_STARTED: partial(unpack, GroupReport),
            floor.ACTION_GROUP_STOPPED: partial(unpack, GroupStopped),
            floor.ACTION_GROUP_COMPLETED: partial(unpack, GroupReport),
            floor.BATTERY: partial(unpack, BatteryVoltage),
            floor.POSITIONS: partial(unpack, ServoPositions),
        }

    def encode_move(self, time_ms: int, targets: Sequence[tuple[int, int]]) -> bytes:
        """Encode by `pack` of an instance; constants are derived, length and count given."""
        count = len(targets)
        move = _new_move(
            length=3 * count + 5,
            count=count,
            time_ms=time_ms,
            targets=[
                _new_servo(servo_id=servo_id, position=position) for servo_id, position in targets
            ],
        )
        frame: bytes = pack(move)
        return frame

    def plain(self, command: int, message: Any) -> object:
        """Return an instance's values, read by attribute."""
        if command == floor.POSITIONS:
            return tuple((servo.servo_id, servo.position) for servo in message.positions)
        if command == floor.BATTERY:
            return message.voltage_mv
        if command == floor.ACTION_GROUP_STOPPED:
            return None
        return message.group, message.times


def peers() -> list[Peer]:
    """Return the peers of caterpillar."""
    return [Caterpillar()]
