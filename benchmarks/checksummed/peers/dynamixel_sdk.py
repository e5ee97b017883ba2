"""dynamixel-sdk: the maker's own library, whose packet handler reads from a port in memory."""

from __future__ import annotations

from typing import Any

import dynamixel_sdk

from benchmarks.checksummed.peers.interface import Peer, Port, Work


class SdkPort(Port):
    """A port with the names that the SDK has for it."""

    readPort = Port.read  # noqa: N815
    writePort = Port.write  # noqa: N815

    def clearPort(self) -> None:  # noqa: N802
        """Forget what has come: nothing has, before it asks."""

    def setPacketTimeout(self, _length: float) -> None:  # noqa: N802
        """Wait for nothing: all has come."""

    def isPacketTimeout(self) -> bool:  # noqa: N802
        """Tell whether all has been read."""
        return self.is_empty


class DynamixelSdk(Peer):
    """`rxPacket` and `writeTxOnly` of its packet handler."""

    name = "dynamixel-sdk"
    distribution = "dynamixel-sdk"

    def __init__(self) -> None:
        self._handler = dynamixel_sdk.PacketHandler(1.0)
        self.works = {
            "dynamixel1-encode": Work(self._write),
            "dynamixel1-decode": Work(self._status, _plain),
            "dynamixel1-stream": Work(self._stream, lambda found: [*map(_plain, found)]),
        }

    def _write(self, servo_id: int, start: int, data: list[int]) -> bytes:
        port = SdkPort()
        self._handler.writeTxOnly(port, servo_id, start, len(data), data)
        return port.written

    def _status(self, frame: bytes) -> Any:
        return self._handler.rxPacket(SdkPort(frame))

    def _stream(self, data: bytes) -> list[Any]:
        port, found = SdkPort(data), []
        while not port.is_empty:
            found.append(self._handler.rxPacket(port))
        return found


def _plain(read: tuple[list[int], int]) -> object:
    packet, result = read
    if result != dynamixel_sdk.COMM_SUCCESS:
        return result
    return packet[2], packet[4], tuple(packet[5:-1])


def peers() -> list[Peer]:
    """Return the peers of dynamixel-sdk."""
    return [DynamixelSdk()]
