"""The maker's own library for DYNAMIXEL actuators, from the package index."""

from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

from tests.protocols.peer import Narrowed, Peer, Values, with_values


def to_one(values: Values) -> Values:
    """Return the values, sent to a single device."""
    return values | {"servo_id": min(values["servo_id"], 253)}


@dataclass
class Port:
    """A port as the SDK has it, on a line that ends here."""

    written: bytes = b""
    waiting: bytes = b""
    is_using: bool = False

    def clearPort(self) -> None:  # noqa: N802 - the SDK's own name
        """Forget what has come, which is nothing yet."""

    def writePort(self, packet: list[int]) -> int:  # noqa: N802
        """Take a packet."""
        self.written = bytes(packet)
        return len(packet)

    def readPort(self, length: int) -> bytes:  # noqa: N802
        """Return what has come."""
        found, self.waiting = self.waiting[:length], self.waiting[length:]
        return found

    def setPacketTimeout(self, _length: float) -> None:  # noqa: N802
        """Wait for nothing: all has come."""

    def isPacketTimeout(self) -> bool:  # noqa: N802
        """Tell whether all has been read."""
        return not self.waiting


# The longest packet that it takes, without header, address, length, instruction and checksum.
_ROOM = 240


def _short(name: str) -> Callable[[Values], Values]:
    return with_values(**{name: lambda data: data[:_ROOM]})


_WRITES: Narrowed = {
    "Ping": to_one,
    "Read": to_one,
    "Write": _short("data"),
    "SyncWrite": lambda values: _short("data")(values) | {"servo_id": 254},
    "BulkRead": lambda values: values | {"items": values["items"][:80], "servo_id": 254},
}


class DynamixelSdk(Peer):
    """The maker's own library, `dynamixel-sdk`."""

    protocol = "dynamixel1"
    package = "dynamixel_sdk"
    writes = _WRITES
    reads: ClassVar[Narrowed] = {"Status": _short("data")}

    def __init__(self) -> None:
        super().__init__()
        self.port = Port()
        self.handler = self.module.PacketHandler(1.0)

    def write(self, message: str, values: Values) -> bytes:
        self.port = port = Port()
        handler, to = self.handler, values["servo_id"]
        match message:
            case "Ping":
                handler.ping(port, to)
            case "Read":
                handler.readTx(port, to, values["start"], values["size"])
            case "Write":
                data = values["data"]
                handler.writeTxOnly(port, to, values["start"], len(data), data)
            case "SyncWrite":
                data = values["data"]
                handler.syncWriteTxOnly(port, values["start"], values["size"], data, len(data))
            case "BulkRead":
                asked = [
                    number
                    for item in values["items"]
                    for number in (item["size"], item["servo_id"], item["start"])
                ]
                handler.bulkReadTx(port, asked, len(asked))
        return port.written

    def read(self, message: str, frame: bytes) -> Values:
        assert message == "Status"
        packet, result = self.handler.rxPacket(Port(waiting=frame))
        assert result == self.module.COMM_SUCCESS
        return {"servo_id": packet[2], "error": packet[4], "data": packet[5:-1]}
