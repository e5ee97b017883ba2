"""Annotations can be evaluated at run time: whoever builds on the library may well do so."""

import inspect
import typing
from collections.abc import Iterator
from importlib import import_module
from typing import Any

from busservo import (
    Controller,
    Direction,
    Message,
    ServoMove,
    StreamDecoder,
    TransportError,
)
from busservo._codec import decode
from busservo.device import Device

MODULES = ("busservo", *(f"busservo.{name}" for name in ("messages", "device", "recordings")))

OURS = ("busservo", "framewire")


def public() -> Iterator[tuple[str, Any]]:
    """Every public class and function, and the public methods and properties of the classes."""
    for module in map(import_module, MODULES):
        for name in getattr(module, "__all__", vars(module)):
            value = getattr(module, name)
            owner = getattr(value, "__module__", "") if callable(value) else ""
            if owner == module.__name__ or (owner and hasattr(module, "__all__")):
                yield f"{module.__name__}.{name}", value
                if inspect.isclass(value):
                    yield from methods(value)


def methods(owner: type) -> Iterator[tuple[str, Any]]:
    ours = [each for each in owner.__mro__ if each.__module__.startswith(OURS)]
    for base in ours:
        for name, value in vars(base).items():
            if not name.startswith("_") or name.endswith("__"):
                inner = getattr(value, "fget", None) or getattr(value, "__func__", value)
                if inspect.isfunction(inner):
                    yield f"{base.__name__}.{name}", inner


PUBLIC = dict(public())


def test_the_public_names_are_found() -> None:
    assert {"busservo.decode", "busservo.StreamDecoder", "StreamDecoder.feed"} <= PUBLIC.keys()
    assert {"ServoMove.__new__", "Controller.move_servos", "Entry.__init__"} <= PUBLIC.keys()


def test_annotations_can_be_looked_up() -> None:
    for name, value in PUBLIC.items():
        hints = typing.get_type_hints(value)
        own = inspect.get_annotations(value)
        assert own.keys() <= hints.keys(), name
        assert not any(isinstance(hint, str) for hint in hints.values()), name


def test_annotations_are_what_they_say() -> None:
    data = bytes | bytearray | memoryview
    assert typing.get_type_hints(decode) == {
        "frame": data,
        "direction": Direction.__mro__[1] | None,  # as in all that is the same for every protocol
        "return": Message,
    }
    # Which messages there may be is told to type checkers alone.
    assert typing.get_type_hints(StreamDecoder.feed) == {"data": data, "return": list[Any]}
    assert typing.get_type_hints(Device.take) == {"return": list[Any]}
    made = typing.get_type_hints(ServoMove.__new__)
    assert made["time_ms"] is int
    assert made["return"] is getattr(typing, "Self", typing.Any)
    assert typing.get_type_hints(ServoMove)["COMMAND"] == typing.ClassVar[int]
    assert typing.get_type_hints(TransportError.__init__)["errno"] == int | None
    assert typing.get_type_hints(Controller.read_battery_voltage)["return"] is int
