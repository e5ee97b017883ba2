"""The messages of `pymodbus`, from the package index: as client, and as device."""

from collections.abc import Callable
from typing import Any

import pytest
from framegen.model.layout import MessageLayout

from tests.protocols.peer import Peer, Values, as_is, with_values
from tests.protocols.specs import messages_of


def _bits(values: list[int]) -> list[bool]:
    return [bool(value >> bit & 1) for value in values for bit in range(8)]


def _whole(name: str) -> Callable[[Values], Values]:
    """Return what makes all bits of a list coils, and keeps to the most that there may be."""

    def narrowed(values: Values) -> Values:
        coils = values[name][:246]
        return (
            values | {name: coils} | ({"quantity": 8 * len(coils)} if "quantity" in values else {})
        )

    return narrowed


def _in_memory(values: Values) -> Values:
    """Return a range that ends within the memory of a device."""
    return values | {"start": min(values["start"], 0xFFFF - values["quantity"])}


_COIL = with_values(value=lambda value: 0xFF00 if value & 1 else 0)
# Names of its classes that write and read a message, with its own names of values.
_RANGE, _LIST = {"start": "address", "quantity": "count"}, {"registers": "registers"}
_BIT, _REGISTER = {"start": "address", "value": "bits"}, {"start": "address", "value": "registers"}
_MODBUS: dict[str, tuple[str, dict[str, str]]] = {
    "CoilsRead": ("bit_message.ReadCoilsRequest", _RANGE),
    "Coils": ("bit_message.ReadCoilsResponse", {"coils": "bits"}),
    "HoldingRead": ("register_message.ReadHoldingRegistersRequest", _RANGE),
    "Holding": ("register_message.ReadHoldingRegistersResponse", _LIST),
    "CoilWrite": ("bit_message.WriteSingleCoilRequest", _BIT),
    "CoilWritten": ("bit_message.WriteSingleCoilResponse", _BIT),
    "RegisterWrite": ("register_message.WriteSingleRegisterRequest", _REGISTER),
    "RegisterWritten": ("register_message.WriteSingleRegisterResponse", _REGISTER),
    "CoilsWrite": ("bit_message.WriteMultipleCoilsRequest", {"start": "address", "coils": "bits"}),
    "RegistersWrite": (
        "register_message.WriteMultipleRegistersRequest",
        {"start": "address", **_LIST},
    ),
    "RegistersWritten": ("register_message.WriteMultipleRegistersResponse", _RANGE),
}
_REFUSED = [name for name in messages_of("modbus") if name.endswith("Refused")]
_SAID: dict[str, Callable[[Values], Values]] = dict.fromkeys(_MODBUS, as_is) | {
    **dict.fromkeys(("CoilsRead", "HoldingRead"), _in_memory),
    "Coils": _whole("coils"),
    "CoilWrite": _COIL,
    "CoilWritten": _COIL,
    "CoilsWrite": lambda values: _in_memory(_whole("coils")(values)),
    "RegistersWritten": lambda values: _in_memory(
        values | {"quantity": max(1, values["quantity"] % 123)}
    ),
    **dict.fromkeys(_REFUSED, as_is),
}


class Pymodbus(Peer):
    """The messages of `pymodbus`, as client and as device."""

    protocol = "modbus"
    package = "pymodbus"
    writes = _SAID
    reads = _SAID

    def __init__(self) -> None:
        super().__init__()
        framer = pytest.importorskip("pymodbus.framer.rtu").FramerRTU
        self.pdu: Any = pytest.importorskip("pymodbus.pdu")
        self._framers = {
            way: framer(self.pdu.DecodePDU(is_server))
            for way, is_server in (("device", True), ("client", False))
        }

    def _class(self, message: str) -> tuple[Any, dict[str, str]]:
        path, names = _MODBUS[message]
        module, _, name = path.partition(".")
        return getattr(pytest.importorskip(f"pymodbus.pdu.{module}"), name), names

    def write(self, message: str, values: Values) -> bytes:
        layout = messages_of(self.protocol)[message]
        framer = self._framers[layout.direction.receiver]
        if message in _REFUSED:
            refused = self.pdu.ExceptionResponse(layout.id, values["reason"], values["unit"])
            return bytes(framer.buildFrame(refused))
        made, names = self._class(message)
        given = {names[name]: _theirs(names[name], values[name]) for name in names}
        return bytes(framer.buildFrame(made(dev_id=values["unit"], **given)))

    def read(self, message: str, frame: bytes) -> Values:
        layout = messages_of(self.protocol)[message]
        framer = self._framers[layout.direction.receiver]
        _, unit, _, payload = framer.decode(frame)
        found = framer.decoder.decode(payload)
        if message in _REFUSED:
            return {"unit": unit, "reason": found.exception_code}
        made, names = self._class(message)
        assert type(found) is made
        ours = {name: _ours(layout, name, getattr(found, its)) for name, its in names.items()}
        counted = {"quantity": found.count} if message == "CoilsWrite" else {}
        return {"unit": unit} | ours | counted


def _theirs(name: str, value: Any) -> Any:
    """Return a value of ours as theirs: lists of bits, and of registers."""
    if name == "bits":
        return _bits(value) if isinstance(value, list) else [bool(value)]
    if name == "registers" and not isinstance(value, list):
        return [value]
    return value


def _ours(layout: MessageLayout, name: str, value: Any) -> Any:
    """Return a value of theirs as ours."""
    if name == "coils":
        groups = [value[at : at + 8] for at in range(0, len(value), 8)]
        return [sum(bit << place for place, bit in enumerate(group)) for group in groups]
    if name == "value":
        return value[0] if layout.name.startswith("Register") else 0xFF00 * value[0]
    return value
