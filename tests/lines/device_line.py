"""A line to the Device of any library, in virtual time, and a client on it."""

import importlib
from typing import Any


class DeviceLine:
    """A transport: what the device sends waits here to be read."""

    name = "line"

    def __init__(self, device: Any) -> None:
        self.device = device
        self.now = 0.0

    def clock(self) -> float:
        return self.now

    def read(self, timeout: float) -> bytes:
        data = b"".join(message.encode() for message in self.device.take())
        self.now += 0.0 if data else max(timeout, 1e-6)
        return data

    def write(self, data: bytes) -> None:
        self.device.accept(data)

    def drain(self, _timeout: float) -> None:
        pass

    def close(self) -> None:
        pass


def client_of(device: Any, **given: Any) -> Any:
    """Return a client of the device's library; nothing in it sleeps."""
    package = next(
        kind.__module__.partition(".")[0]
        for kind in type(device).__mro__
        if kind.__name__ == "Device"
    )
    line = DeviceLine(device)
    library = importlib.import_module(package)
    return library.Controller(line, background=False, clock=line.clock, settle=0, **given)
