"""The fixtures for other people's robots; tests/world/test_fixtures.py names them elsewhere."""

from __future__ import annotations

from typing import TYPE_CHECKING

import busservo
from busservo_simulator.fixtures import patient_controller, virtual_controller

if TYPE_CHECKING:
    from busservo_simulator import VirtualController

__all__ = ["patient_controller", "virtual_controller"]


def test_a_board_in_memory_answers(virtual_controller: VirtualController) -> None:
    virtual_controller.transport.write(busservo.BatteryVoltageRead().encode())
    assert virtual_controller.transport.read(5) == busservo.BatteryVoltage(7500).encode()


def test_the_time_of_a_patient_board_goes_on_by_hand(patient_controller: VirtualController) -> None:
    patient_controller.transport.write(busservo.ServoMove(1000, [(1, 900)]).encode())
    patient_controller.advance(0.5)
    assert patient_controller.servos[1].position == 700
