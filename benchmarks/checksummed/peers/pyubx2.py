"""pyubx2: the messages of u-blox receivers, by name, with a reader of streams."""

from __future__ import annotations

from io import BytesIO
from typing import Any

from pyubx2 import GET, SET, UBX_PROTOCOL, UBXMessage, UBXReader

from benchmarks.checksummed.peers.interface import Peer, Work


class Pyubx2(Peer):
    """`UBXReader.parse`, `UBXMessage.serialize`, and a `UBXReader` of a stream."""

    name = "pyubx2"
    distribution = "pyubx2"

    def __init__(self) -> None:
        self.works = {
            "ubx-encode": Work(_set_rate),
            "ubx-decode": Work(lambda frame: UBXReader.parse(frame, msgmode=GET), _plain),
            "ubx-stream": Work(_read, lambda found: [*map(_plain, found)]),
        }


def _set_rate(period_ms: int, solutions: int, time_reference: int) -> bytes:
    message = UBXMessage(
        "CFG",
        "CFG-RATE",
        SET,
        measRate=period_ms,
        navRate=solutions,
        timeRef=time_reference,
    )
    return bytes(message.serialize())


def _read(data: bytes) -> list[Any]:
    return [message for _, message in UBXReader(BytesIO(data), protfilter=UBX_PROTOCOL)]


def _plain(message: Any) -> tuple[int, int]:
    return message.clsID, message.msgID


def peers() -> list[Peer]:
    """Return the peers of pyubx2."""
    return [Pyubx2()]
