"""A question that has just left: of a session alone, without a client and a line."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo import BatteryVoltageRead, Message

if TYPE_CHECKING:
    from framewire.client.request import Request
    from framewire.client.session import Session


def ask(line: Session, now: float, message: Message | None = None, retries: int = 0) -> Request:
    """Have a session ask, by default for the voltage, and return its request."""
    request = line.submit(message or BatteryVoltageRead(), retries=retries)
    assert line.outgoing(now) == [request.message.encode()]
    line.written(request, now)
    return request
