"""A short session with the virtual controller: no arm is needed."""

import busservo
from busservo_simulator import VirtualController

with VirtualController("tcp") as board, busservo.open_controller(board.port) as controller:
    print("battery:", controller.read_battery_voltage(), "mV")
    print("before: ", *controller.read_servo_positions([1, 6]))
    controller.move_servos([(1, 800), (6, 200)], time_ms=0)
    print("refused:", board.rejects.total)
