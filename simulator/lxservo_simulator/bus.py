"""The servos of a bus: what each of them does with what it is sent. No port, and no clock."""

from __future__ import annotations

from typing import TYPE_CHECKING

from lxservo import (
    LastMove,
    Led,
    LedErrors,
    Mode,
    Move,
    Offset,
    Position,
    PositionLimits,
    PreparedMove,
    ServoId,
    Temperature,
    TemperatureLimit,
    Torque,
    Voltage,
    VoltageLimits,
)
from lxservo._library import LIBRARY
from lxservo.device import Device
from lxservo.runtime import simulator

from lxservo_simulator.servo import BusServo

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from lxservo import (
        LedErrorsRead,
        LedErrorsWrite,
        LedRead,
        LedWrite,
        ModeRead,
        ModeWrite,
        MovePrepare,
        MoveRead,
        MoveStart,
        MoveStop,
        OffsetAdjust,
        OffsetRead,
        OffsetSave,
        PositionLimitsRead,
        PositionLimitsWrite,
        PositionRead,
        PreparedMoveRead,
        ServoIdRead,
        ServoIdWrite,
        TemperatureLimitRead,
        TemperatureLimitWrite,
        TemperatureRead,
        TorqueRead,
        TorqueWrite,
        VoltageLimitsRead,
        VoltageLimitsWrite,
        VoltageRead,
    )
    from lxservo.device import Report

EVERY_SERVO = Move.SERVO_ID_ALL
DEFAULT_SERVOS = range(1, 7)


class ServoBus(simulator.VirtualDevice, Device):
    """Servos on one wire, switched on at time 0.

    Where the vendor's document is silent it does nothing. Two servos of one number both answer, as
    they do on a wire, one frame behind the other.
    """

    library = LIBRARY
    name = "bus"

    def __init__(self, servos: Iterable[int] = DEFAULT_SERVOS) -> None:
        super().__init__()
        self.all = [BusServo(servo_id, lambda: self.now) for servo_id in servos]

    @property
    def servos(self) -> dict[int, BusServo]:
        """The servos by the numbers that they have now; of several with one number, the first."""
        return {servo.servo_id: servo for servo in reversed(self.all)}

    def reboot(self, seconds: float) -> None:
        """Switch them off and on: for so many seconds they take nothing in."""
        super().reboot(seconds)
        for servo in self.all:
            servo.power_on()

    # ---------------------------------------------------------------- what a host tells them

    def on_move(self, message: Move) -> None:
        """Start to move."""
        for servo in self._called(message.servo_id):
            servo.move(message.position, message.time_ms)

    def on_move_prepare(self, message: MovePrepare) -> None:
        """Keep a move for later."""
        for servo in self._called(message.servo_id):
            servo.prepared = (message.position, message.time_ms)

    def on_move_start(self, message: MoveStart) -> None:
        """Start the move that was kept."""
        for servo in self._called(message.servo_id):
            servo.start_prepared()

    def on_move_stop(self, message: MoveStop) -> None:
        """Stop where it is."""
        for servo in self._called(message.servo_id):
            servo.stop()

    def on_servo_id_write(self, message: ServoIdWrite) -> None:
        """Take another number, which is kept."""
        for servo in self._called(message.servo_id):
            servo.servo_id = message.new_id

    def on_offset_adjust(self, message: OffsetAdjust) -> None:
        """Shift the positions until it is switched off."""
        for servo in self._called(message.servo_id):
            servo.offset = message.offset

    def on_offset_save(self, message: OffsetSave) -> None:
        """Keep that shift."""
        for servo in self._called(message.servo_id):
            servo.saved_offset = servo.offset

    def on_position_limits_write(self, message: PositionLimitsWrite) -> None:
        """Keep limits of positions, the lowest below the highest."""
        for servo in self._called(message.servo_id):
            if message.lowest < message.highest:
                servo.position_limits = (message.lowest, message.highest)

    def on_voltage_limits_write(self, message: VoltageLimitsWrite) -> None:
        """Keep limits of the voltage, the lowest below the highest."""
        for servo in self._called(message.servo_id):
            if message.lowest_mv < message.highest_mv:
                servo.voltage_limits = (message.lowest_mv, message.highest_mv)

    def on_temperature_limit_write(self, message: TemperatureLimitWrite) -> None:
        """Keep the limit of the temperature."""
        for servo in self._called(message.servo_id):
            servo.temperature_limit = message.highest

    def on_mode_write(self, message: ModeWrite) -> None:
        """Be a servo, or a motor that turns on and on."""
        for servo in self._called(message.servo_id):
            servo.mode, servo.speed = message.mode, message.speed

    def on_torque_write(self, message: TorqueWrite) -> None:
        """Hold, or go limp."""
        for servo in self._called(message.servo_id):
            servo.load(loaded=bool(message.torque))

    def on_led_write(self, message: LedWrite) -> None:
        """Switch the LED; the value is kept."""
        for servo in self._called(message.servo_id):
            servo.led = message.led

    def on_led_errors_write(self, message: LedErrorsWrite) -> None:
        """Keep at which faults the LED blinks."""
        for servo in self._called(message.servo_id):
            servo.led_errors = message.errors

    # ---------------------------------------------------------------- what it asks them

    def on_move_read(self, message: MoveRead) -> None:
        """Answer with the last move."""
        self._answer(message.servo_id, lambda servo: LastMove(servo.servo_id, *servo.last_move))

    def on_prepared_move_read(self, message: PreparedMoveRead) -> None:
        """Answer with the move that is kept."""
        self._answer(message.servo_id, lambda servo: PreparedMove(servo.servo_id, *servo.prepared))

    def on_servo_id_read(self, message: ServoIdRead) -> None:
        """Answer with its number, even if all are asked: how an unknown one is found out."""
        every = message.servo_id == EVERY_SERVO
        for servo in self._called(message.servo_id):
            self.send(ServoId(servo.servo_id, servo.servo_id))
            if every and len(self.all) > 1:
                self.log("bus", f"servo {servo.servo_id} answers a question to all")

    def on_offset_read(self, message: OffsetRead) -> None:
        """Answer with the shift."""
        self._answer(message.servo_id, lambda servo: Offset(servo.servo_id, servo.offset))

    def on_position_limits_read(self, message: PositionLimitsRead) -> None:
        """Answer with the limits of positions."""
        self._answer(
            message.servo_id,
            lambda servo: PositionLimits(servo.servo_id, *servo.position_limits),
        )

    def on_voltage_limits_read(self, message: VoltageLimitsRead) -> None:
        """Answer with the limits of the voltage."""
        self._answer(
            message.servo_id, lambda servo: VoltageLimits(servo.servo_id, *servo.voltage_limits)
        )

    def on_temperature_limit_read(self, message: TemperatureLimitRead) -> None:
        """Answer with the limit of the temperature."""
        self._answer(
            message.servo_id,
            lambda servo: TemperatureLimit(servo.servo_id, servo.temperature_limit),
        )

    def on_temperature_read(self, message: TemperatureRead) -> None:
        """Answer with the temperature."""
        self._answer(message.servo_id, lambda servo: Temperature(servo.servo_id, servo.temperature))

    def on_voltage_read(self, message: VoltageRead) -> None:
        """Answer with the voltage."""
        self._answer(message.servo_id, lambda servo: Voltage(servo.servo_id, servo.voltage_mv))

    def on_position_read(self, message: PositionRead) -> None:
        """Answer with the position of this moment."""
        self._answer(message.servo_id, lambda servo: Position(servo.servo_id, servo.position))

    def on_mode_read(self, message: ModeRead) -> None:
        """Answer whether it is a servo or a motor."""
        self._answer(message.servo_id, lambda servo: Mode(servo.servo_id, servo.mode, servo.speed))

    def on_torque_read(self, message: TorqueRead) -> None:
        """Answer whether it holds."""
        self._answer(message.servo_id, lambda servo: Torque(servo.servo_id, int(servo.loaded)))

    def on_led_read(self, message: LedRead) -> None:
        """Answer whether the LED is off."""
        self._answer(message.servo_id, lambda servo: Led(servo.servo_id, servo.led))

    def on_led_errors_read(self, message: LedErrorsRead) -> None:
        """Answer at which faults the LED blinks."""
        self._answer(message.servo_id, lambda servo: LedErrors(servo.servo_id, servo.led_errors))

    # ---------------------------------------------------------------- details

    def _called(self, servo_id: int) -> Iterator[BusServo]:
        for servo in self.all:
            if servo_id in (EVERY_SERVO, servo.servo_id) and not servo.dead:
                yield servo

    def _answer(self, servo_id: int, reply: Callable[[BusServo], Report]) -> None:
        """Have the servos of a number answer; nobody answers what is sent to all."""
        if servo_id == EVERY_SERVO:
            return
        for servo in self._called(servo_id):
            self.send(reply(servo))
