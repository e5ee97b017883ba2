"""A short session with the virtual controller: an arm moves, and none is needed."""

from busservo import ActionGroupCompleted, Controller
from busservo_simulator import VirtualClock, VirtualController

# A clock that moves on when the client waits: seconds of motion pass in no time.
with VirtualController(clock=VirtualClock(follow_reads=True)) as board:
    clock = board.clock.now
    with Controller(board.transport, background=False, clock=clock) as controller:
        print("battery: ", controller.read_battery_voltage(), "mV")
        print("before:  ", *controller.read_servo_positions([1, 6]))
        controller.move_servos([(1, 800), (6, 200)], time_ms=1000)
        board.advance(0.5)
        print("half-way:", *controller.read_servo_positions([1, 6]))
        board.advance(0.6)
        print("after:   ", *controller.read_servo_positions([1, 6]))
        controller.run_action_group(8, times=1)
        print("report:  ", controller.wait_for(ActionGroupCompleted, group=8, timeout=30))
    print("refused: ", board.rejects.total)
