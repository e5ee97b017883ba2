"""The pytest fixtures for other people's robots: there if imported, and not loaded otherwise."""

import os
import sys
from pathlib import Path

from tests.programs import ran

TESTS = """
import busservo
from busservo_simulator import VirtualController

pytest_plugins = ["busservo_simulator.fixtures"]

def test_memory(virtual_controller):
    virtual_controller.transport.write(busservo.BatteryVoltageRead().encode())
    assert virtual_controller.transport.read(5) == busservo.BatteryVoltage(7500).encode()

def test_time_by_hand(patient_controller):
    patient_controller.transport.write(busservo.ServoMove(1000, [(1, 900)]).encode())
    patient_controller.advance(0.5)
    assert patient_controller.servos[1].position == 700

def test_tcp(virtual_tcp_controller):
    assert virtual_tcp_controller.port.startswith("socket://127.0.0.1:")
"""


def test_they_work_in_a_project_that_names_them(tmp_path: Path) -> None:
    (tmp_path / "test_robot.py").write_text(TESTS)
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(sys.path)}
    command = [sys.executable, "-m", "pytest", "-q", "-W", "error", "-p", "no:cacheprovider"]
    done = ran(*command, cwd=tmp_path, env=environment)
    assert "3 passed" in done.stdout
