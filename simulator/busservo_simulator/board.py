"""The board: what a bus servo controller does with its commands. No port, and no clock."""

from __future__ import annotations

from typing import TYPE_CHECKING

from busservo import (
    ActionGroupCompleted,
    ActionGroupSpeed,
    ActionGroupStarted,
    ActionGroupStopped,
    BatteryVoltage,
    ServoPosition,
    ServoPositions,
)
from busservo.simulator import VirtualDevice

from busservo_simulator.action_group import stored_groups
from busservo_simulator.battery import Battery
from busservo_simulator.board_fault_injector import BoardFaultInjector
from busservo_simulator.faults import Faults
from busservo_simulator.performance import Performance
from busservo_simulator.servo import Servo

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from busservo import (
        ActionGroupRun,
        ActionGroupStop,
        BatteryVoltageRead,
        Message,
        ServoMove,
        ServoPositionsRead,
        ServoUnload,
    )
    from framewire.simulator.line_faults import LineFaults

    from busservo_simulator.action_group import ActionGroup

# On the servo bus, the number that every servo listens to.
EVERY_SERVO = 254
DEFAULT_SERVOS = range(1, 7)
# A reply with more servos would be longer than its length can say.
MOST_POSITIONS = ServoPositions.SHAPE.items.counts[-1] if ServoPositions.SHAPE.items else 0


class Board(VirtualDevice):
    """A board that has been switched on at time 0 and lives through `advance_to`.

    Where the vendor's document is silent it does nothing: a servo that is not there and an action
    group that is not stored are ignored, a group that starts replaces the one that runs, and a
    speed of 0 % is ignored. A message without a handler here gets the answer that follows from the
    specification.
    """

    name = "board"

    def __init__(
        self,
        servos: Iterable[int] = DEFAULT_SERVOS,
        groups: Mapping[int, ActionGroup] | None = None,
        *,
        battery_mv: int = 7500,
        start_report: bool = True,
    ) -> None:
        super().__init__()
        self.servos = {servo_id: Servo(servo_id, lambda: self.now) for servo_id in servos}
        self.groups = dict(stored_groups() if groups is None else groups)
        self.speeds: dict[int, int] = {}
        self.battery = Battery(battery_mv, self._travelling)
        self.start_report = start_report
        self.led_stays_on = False
        self.beeps = 0
        self._performance: Performance | None = None

    # ---------------------------------------------------------------- time

    @property
    def next_event(self) -> float | None:
        """When something happens by itself; None while nothing will."""
        return self._performance.due if self._performance else None

    def advance_to(self, moment: float) -> None:
        """Advance to a moment, through everything that happens by itself until then."""
        while self._performance and self._performance.due <= moment:
            self._pass(self._performance.due)
            self._go_on(self._performance)
        self._pass(moment)

    def _pass(self, moment: float) -> None:
        if moment <= self.now:
            return
        busy = [servo.busy(self.now, moment) for servo in self.servos.values()]
        self.battery.drain(moment - self.now, sum(busy))
        self.now = moment

    def _travelling(self) -> int:
        return sum(servo.travelling for servo in self.servos.values())

    def _go_on(self, performance: Performance) -> None:
        if performance.ended:
            self._performance = None
            self.log("group", f"{performance.number} has ended, {performance.times} times run")
            self.send(ActionGroupCompleted(performance.number, performance.times))
            return
        seconds = performance.due
        step = performance.next_step(self.speeds.get(performance.number, 100))
        self._turn(step.targets.items(), performance.due - seconds)

    # ---------------------------------------------------------------- what the host can do

    def log_message(self, message: Message) -> None:
        """Blink LED2 once for a message."""
        self.led_stays_on = False
        self.log("LED2", f"blinks: {message!r}")

    def log_noise(self, reason: str, shown: str) -> None:
        """Keep LED2 on and beep twice; the host gets no reply."""
        self.led_stays_on = True
        self.beeps += 2
        self.log("LED2", "stays on")
        self.log("buzzer", f"DiDi: {reason}, {shown}")

    def on_servo_move(self, message: ServoMove) -> None:
        """Move the servos."""
        self._turn(message.targets, message.time_ms / 1000)

    def on_servo_unload(self, message: ServoUnload) -> None:
        """Make the servos limp."""
        for servo_id in message.servo_ids:
            for servo in self._addressed(servo_id):
                servo.unload()

    def on_servo_positions_read(self, message: ServoPositionsRead) -> ServoPositions | None:
        """Return the present servos, in the order requested; None if no reply can hold them."""
        if len(message.servo_ids) > MOST_POSITIONS:
            self.log("board", f"{len(message.servo_ids)} servos fit in no reply: silence")
            return None
        there = (self.servos.get(servo_id) for servo_id in message.servo_ids)
        return ServoPositions(
            [self._reported(servo) for servo in there if servo and not servo.missing]
        )

    def on_battery_voltage_read(self, message: BatteryVoltageRead) -> BatteryVoltage:  # noqa: ARG002 - it has no fields
        """Return the present voltage."""
        return BatteryVoltage(self.battery.voltage_mv)

    def on_action_group_run(self, message: ActionGroupRun) -> None:
        """Start the group, if there is one of this number."""
        self.start_group(message.group, message.times, told=self.start_report)

    def on_action_group_stop(self, message: ActionGroupStop) -> None:  # noqa: ARG002 - it has no fields
        """Stop the group that runs; without one, do nothing and send nothing."""
        self.stop_group()

    def on_action_group_speed(self, message: ActionGroupSpeed) -> None:
        """Change the time that the next steps of a group take."""
        if not message.percent:
            self.log("group", f"{message.group}: a speed of 0 % is ignored")
            return
        every = message.group == ActionGroupSpeed.GROUP_ALL
        for number in self.groups if every else [message.group]:
            self.speeds[number] = message.percent

    # ---------------------------------------------------------------- what others can do

    def start_group(self, number: int, times: int, *, told: bool = True) -> None:
        """Start a stored group, as the handset or the button on the board can too."""
        group = self.groups.get(number)
        if group is None:
            self.log("group", f"{number} is not stored: silence")
            return
        self.log("group", f"{number} starts, {times or 'unlimited'} times")
        if told:
            self.send(ActionGroupStarted(number, times))
        self._performance = Performance(number, group, times, self.now)
        self._go_on(self._performance)

    def stop_group(self) -> None:
        """Stop the group that runs. Servos complete the step that they are at."""
        if self._performance is None:
            return
        self.log("group", f"{self._performance.number} is stopped")
        self._performance = None
        self.send(ActionGroupStopped())

    def reboot(self, seconds: float) -> None:
        """Switch it off and on: no input for `seconds`, speeds forgotten, and no group runs."""
        super().reboot(seconds)
        self._performance = None
        self.speeds.clear()

    def injector(self, faults: LineFaults | None) -> BoardFaultInjector:
        """Return what applies faults to its line. Raises TypeError for those of another line."""
        if faults is not None and not isinstance(faults, Faults):
            raise TypeError(f"Faults are wanted, not {type(faults).__name__}")
        return BoardFaultInjector(faults or Faults())

    # ---------------------------------------------------------------- details

    def _turn(self, targets: Iterable[tuple[int, int]], seconds: float) -> None:
        for servo_id, position in targets:
            for servo in self._addressed(servo_id):
                servo.move(position, seconds)

    def _addressed(self, servo_id: int) -> list[Servo]:
        called = self.servos.values() if servo_id == EVERY_SERVO else [self.servos.get(servo_id)]
        return [servo for servo in called if servo and not servo.missing and not servo.off]

    def _reported(self, servo: Servo) -> tuple[int, int]:
        absent = ServoPosition.POSITION_ABSENT
        return servo.servo_id, absent if servo.off else servo.position
