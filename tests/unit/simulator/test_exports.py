"""What the packages of the simulators export, once it is asked for; and the fixtures for others."""

from __future__ import annotations

import os
import sys
from typing import Any

import busservo
import busservo_simulator
import busservo_simulator.virtual_loop
import lxservo_simulator
import pytest
from busservo_simulator import VirtualController
from busservo_simulator.fixtures import patient_controller, virtual_controller
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


# -------------------------------------------------------------------- the fixtures


__all__ = ["patient_controller", "virtual_controller"]


def test_a_board_in_memory_answers(virtual_controller: VirtualController) -> None:
    virtual_controller.transport.write(busservo.BatteryVoltageRead().encode())
    assert virtual_controller.transport.read(5) == busservo.BatteryVoltage(7500).encode()


def test_the_time_of_a_patient_board_goes_on_by_hand(patient_controller: VirtualController) -> None:
    patient_controller.transport.write(busservo.ServoMove(1000, [(1, 900)]).encode())
    patient_controller.advance(0.5)
    assert patient_controller.servos[1].position == 700
