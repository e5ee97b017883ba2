"""The client of each protocol that is written down is answered by its own device."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

import lxservo
import pytest
from framegen.targets.python.names import names_of

from tests.factories import compiled_file, library, library_of
from tests.lines.every_method import converse_alone
from tests.protocols.specs import FILES
from tests.rows import each_protocol

if TYPE_CHECKING:
    from types import ModuleType


# The library of one is installed.
@pytest.mark.parametrize("name", each_protocol([name for name in FILES if name != "lxservo"]))
def test_each_method_is_answered_by_the_device_of_the_same_library(name: str) -> None:
    with library(library_of(FILES[name])) as made:
        answered(made, name)


def test_each_method_of_the_servo_bus_is_answered_by_its_device() -> None:
    answered(lxservo, "lxservo")


def answered(made: ModuleType, name: str) -> None:
    for module in ("device", "_library"):
        importlib.import_module(f"{made.__name__}.{module}")
    converse_alone(made, names_of(compiled_file(FILES[name]).model).library)
