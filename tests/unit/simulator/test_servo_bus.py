"""The virtual servo bus: what its servos do, and who talks to them."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Any

import lxservo
import pytest
import serial
from busservo_simulator import VirtualClock
from lxservo_simulator import VirtualBus
from lxservo_simulator.cli import main

from tests.in_turn import in_turn
from tests.lines.at_board import client_at
from tests.timeouts import GENEROUS, await_that

if TYPE_CHECKING:
    from collections.abc import Iterator

BAUD = 115200


@pytest.fixture
def bus() -> Iterator[VirtualBus]:
    clock = VirtualClock(follow_reads=True)
    with VirtualBus(servos=[1, 2, 3], baud=BAUD, clock=clock) as made:
        yield made


@pytest.fixture
def client(bus: VirtualBus) -> Iterator[lxservo.Controller]:
    with client_at(bus, lxservo.Controller, settle=None) as made:
        yield made


def arrived(bus: VirtualBus, servo_id: int, position: int) -> None:
    """Wait until a servo is at a position, on a real clock."""
    await_that(lambda: bus.servos[servo_id].position == position)


def test_a_servo_arrives_after_its_time(bus: VirtualBus, client: lxservo.Controller) -> None:
    motion = client.move(1, position=900, time_ms=1000)
    bus.advance(0.5)
    assert 600 < client.read_position(1) < 800
    motion.wait()
    assert (client.read_position(1), client.read_position(2)) == (900, 500)
    assert client.read_move(1) == lxservo.LastMove(1, 900, 1000)


def test_prepared_moves_start_together(bus: VirtualBus, client: lxservo.Controller) -> None:
    client.prepare_move(1, position=100, time_ms=500)
    client.prepare_move(2, position=900, time_ms=500)
    bus.advance(1)
    assert [client.read_position(number) for number in (1, 2)] == [500, 500]
    client.broadcast().start_move()
    bus.advance(1)
    # The third has prepared nothing: it stays where it is.
    assert [client.read_position(number) for number in (1, 2, 3)] == [100, 900, 500]


@in_turn(
    "write, values, read, expected",
    lambda: [
        ("adjust_offset", [-30], "read_offset", -30),
        ("write_torque", [0], "read_torque", 0),
        ("write_led", [1], "read_led", 1),
        ("write_led_errors", [5], "read_led_errors", 5),
        ("write_position_limits", [100, 700], "read_position_limits", lxservo.PositionLimits),
        ("write_voltage_limits", [6000, 9000], "read_voltage_limits", lxservo.VoltageLimits),
        ("write_temperature_limit", [70], "read_temperature_limit", 70),
        ("write_mode", [1, -400], "read_mode", lxservo.Mode),
    ],
)
def test_what_is_written_to_one_is_read_from_it(
    client: lxservo.Controller, write: str, values: list[int], read: str, expected: Any
) -> None:
    if isinstance(expected, type):
        expected = expected(2, *values)
    before = getattr(client, read)(2)
    getattr(client, write)(2, *values)
    assert getattr(client, read)(2) == expected != before


def test_a_saved_offset_outlives_the_power(bus: VirtualBus, client: lxservo.Controller) -> None:
    for number in (1, 2):
        client.adjust_offset(number, 20)
    client.save_offset(1)
    bus.advance(0.01)
    bus.reboot(0.5)
    bus.advance(1)
    assert [client.read_offset(number) for number in (1, 2)] == [20, 0]


def test_a_limp_servo_is_turned_by_hand_and_held_again(
    bus: VirtualBus, client: lxservo.Controller
) -> None:
    with pytest.raises(ValueError, match="servo 1 holds its position: unload it first"):
        bus.servos[1].turn_by_hand(700)
    client.device(1).write_torque(0)
    bus.advance(0.01)
    bus.servos[1].turn_by_hand(-12)
    assert client.read_position(1) == -12


def test_a_servo_is_found_by_asking_all_and_given_a_number(
    bus: VirtualBus, client: lxservo.Controller
) -> None:
    bus.servos[3].dead = True
    found = client.broadcast().read_servo_id(within=0.1)
    assert [reply.own_id for reply in found] == [1, 2]
    client.write_servo_id(2, new_id=9)
    assert client.read_servo_id(9) == 9
    assert set(bus.servos) == {1, 3, 9}


def test_a_broken_frame_is_met_with_silence(bus: VirtualBus) -> None:
    frame = lxservo.PositionRead(servo_id=1).encode()
    bus.transport.write(frame[:-1] + b"\x00")
    assert bus.transport.read(0.1) == b""
    assert (bus.accepted, bus.rejected) == (0, 1)
    bus.transport.write(frame)
    assert bus.transport.read(0.1) != b""


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
@pytest.mark.parametrize("echo", [False, True])
def test_clients_of_others_are_happy_with_it(echo: bool) -> None:
    with (
        VirtualBus("pty", servos=[1, 2], local_echo=echo) as bus,
        serial.Serial(bus.port, BAUD, timeout=GENEROUS) as line,
    ):
        others = pytest.importorskip("lewanlib.bus").ServoBus(
            serial_conn=line, discard_echo=echo, retry_count=0, on_exit_power_off=False
        )
        others.move_time_write(2, 60.1, 0)
        arrived(bus, 2, 250)
        assert others.pos_read(2) == 60
        assert others.temp_read(1, "C") == bus.servos[1].temperature
        assert bus.rejected == 0
        if echo:
            return
        theirs = pytest.importorskip("lewansoul_lx16a").ServoController(line, timeout=GENEROUS)
        theirs.move(1, 800, 0)
        arrived(bus, 1, 800)
        assert [theirs.get_position(number) for number in (1, 2)] == [800, 250]
        assert theirs.get_voltage(1) == bus.servos[1].voltage_mv
        assert theirs.get_position_limits(2) == (0, 1000)


@pytest.mark.skipif(sys.platform == "win32", reason="Windows has no pty")
def test_a_client_that_asks_a_servo_for_all_is_happy_with_it() -> None:
    theirs = pytest.importorskip("pylx16a.lx16a").LX16A
    with VirtualBus("pty", servos=[1, 2]) as bus:
        theirs.initialize(bus.port, timeout=GENEROUS)
        try:
            first, second = theirs(1), theirs(2, disable_torque=True)
            await_that(lambda: not bus.servos[2].loaded)
            first.move(192, time=0)
            arrived(bus, 1, 800)
            assert first.get_physical_angle() == 192
            assert second.get_vin() == bus.servos[2].voltage_mv
            assert second.get_id(poll_hardware=True) == 2
            first.set_angle_limits(24, 120)
            assert first.get_angle_limits(poll_hardware=True) == (24, 120)
            second.enable_torque()
            second.motor_mode(-400)
            assert second.is_motor_mode(poll_hardware=True)
            assert second.get_motor_speed(poll_hardware=True) == -400
            assert bus.rejected == 0
        finally:
            theirs._controller.close()
            theirs._controller = None


@in_turn(
    "words, said",
    lambda: [
        ("--dead 9", "--dead 9: there is no such servo; see --servos"),
        ("--fault fewer=0.1", "no fault is called 'fewer'"),
        ("--tcp --link x", "--link names a pty, and there is none with --tcp"),
    ],
)
def test_the_command_refuses_what_cannot_be(
    words: str, said: str, capsys: pytest.CaptureFixture[str]
) -> None:
    assert main(words.split()) == 2
    assert said in capsys.readouterr().err
