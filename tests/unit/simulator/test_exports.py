"""What the packages of the simulators export, and that the board waits until it is asked for."""

from __future__ import annotations

import os
import sys
from typing import Any

import busservo_simulator
import busservo_simulator.virtual_loop
import lxservo_simulator
import pytest
from framewire.simulator.virtual_loop import run_virtual

from tests.in_turn import in_turn
from tests.programs import ran

PACKAGES = [busservo_simulator, lxservo_simulator]


@in_turn("package", lambda: PACKAGES)
def test_every_name_is_there_and_no_other(package: Any) -> None:
    assert [name for name in package.__all__ if getattr(package, name).__name__ != name] == []
    with pytest.raises(
        AttributeError, match=f"module '{package.__name__}' has no attribute 'Bord'"
    ):
        _ = package.Bord
    assert busservo_simulator.virtual_loop.run_virtual is run_virtual


@in_turn("package", lambda: PACKAGES)
def test_the_command_alone_imports_no_device(package: Any) -> None:
    name = package.__name__
    script = f"import sys, {name}.cli as cli; cli.main(['--help']); print(*sys.modules)"
    search = {"PYTHONPATH": os.pathsep.join(sys.path)}
    loaded = ran(sys.executable, "-c", script, environment=search).stdout.splitlines()[-1].split()
    devices = {f"{name}.{each}" for each in ("board", "bus", "virtual_controller", "virtual_bus")}
    assert f"{name}.cli" in loaded
    assert devices.isdisjoint(loaded)
