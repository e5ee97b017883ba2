"""pymodbus: the messages of Modbus, and the framer of its serial lines."""

from __future__ import annotations

from typing import Any

from pymodbus.framer.rtu import FramerRTU
from pymodbus.pdu import DecodePDU
from pymodbus.pdu.register_message import ReadHoldingRegistersRequest

from benchmarks.checksummed.peers.interface import Peer, Work
from benchmarks.checksummed.rows import ROWS


class Pymodbus(Peer):
    """`handleFrame` and `buildFrame` of its framer for serial lines, as client and as device."""

    name = "pymodbus"
    distribution = "pymodbus"
    remark = "its framer takes one frame at a time; in a stream, the floor's loop finds them"

    def __init__(self) -> None:
        self._client = FramerRTU(DecodePDU(is_server=False))
        self._device = FramerRTU(DecodePDU(is_server=True))
        self.works = {
            "modbus-encode": Work(self._ask),
            "modbus-question": Work(
                lambda frame: self._device.handleFrame(frame, 0, 0)[1],
                lambda pdu: (pdu.dev_id, pdu.address, pdu.count),
            ),
            "modbus-decode": Work(self._reply, _plain),
            "modbus-stream": Work(self._stream, lambda found: [*map(_plain, found)]),
        }

    def _ask(self, unit: int, start: int, quantity: int) -> bytes:
        pdu = ReadHoldingRegistersRequest(address=start, count=quantity, dev_id=unit)
        return self._client.buildFrame(pdu)

    def _reply(self, frame: bytes) -> Any:
        _, pdu = self._client.handleFrame(frame, 0, 0)
        if pdu is None:
            raise ValueError
        return pdu

    def _stream(self, data: bytes) -> list[Any]:
        loop = ROWS["modbus-stream"].loop
        assert loop is not None
        found: list[Any] = loop.frames(data, self._reply)
        return found


def _plain(pdu: Any) -> tuple[int, tuple[int, ...]]:
    return pdu.dev_id, tuple(pdu.registers)


def peers() -> list[Peer]:
    """Return the peers of pymodbus."""
    return [Pymodbus()]
