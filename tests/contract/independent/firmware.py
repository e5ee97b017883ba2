"""A second opinion: frames as the firmware of a sibling board reads them, from the document alone.

Nothing of the library or of the simulator is used here, nor anywhere in the independent board.
"""

import struct

HEADER = 0x55
MOVE, RUN, STOP, COMPLETED, SPEED, BATTERY, UNLOAD, POSITIONS = 3, 6, 7, 8, 11, 15, 20, 21
STARTED, STOPPED = RUN, STOP
QUESTIONS = (BATTERY, POSITIONS)


def frame(command: int, parameters: bytes = b"") -> bytes:
    """Return a frame: header, length (of parameters, command and itself), command, parameters.

    "Data length: the number of parameters plus a command plus a byte length".
    """
    return struct.pack("4B", HEADER, HEADER, len(parameters) + 2, command) + parameters


def battery_question() -> bytes:
    """Return the frame with which a host reads the battery."""
    return frame(BATTERY)


def positions_question(servo_ids: list[int]) -> bytes:
    """Return the frame with which a host reads positions."""
    return frame(POSITIONS, bytes([len(servo_ids), *servo_ids]))


def battery_reply(millivolts: int) -> bytes:
    """Return the reply with the voltage, low byte first."""
    return frame(BATTERY, struct.pack("<H", millivolts))


def positions_reply(positions: list[tuple[int, int]]) -> bytes:
    """Return the reply with the count, then id, low byte and high byte of each servo."""
    each = b"".join(struct.pack("<BH", servo_id, position) for servo_id, position in positions)
    return frame(POSITIONS, bytes([len(positions)]) + each)


def report(command: int, group: int = 0, times: int = 0) -> bytes:
    """Return a report on an action group: STARTED, STOPPED or COMPLETED."""
    return frame(command, b"" if command == STOPPED else struct.pack("<BH", group, times))


def well_formed(data: bytes) -> bool:
    """Return whether a whole frame is a host's command, with parameters that fit its length."""
    command, parameters = data[3], data[4:]
    count = parameters[0] if parameters else 0
    if command == MOVE:
        return count > 0 and len(parameters) == 3 + 3 * count
    if command in (UNLOAD, POSITIONS):
        return count > 0 and len(parameters) == 1 + count
    return {RUN: 3, STOP: 0, SPEED: 3, BATTERY: 0}.get(command) == len(parameters)


class Reader:
    """A reader that takes a byte at a time, and returns each frame once it is complete.

    There is no time-out between bytes: a frame that was cut off eats the beginning of the next.
    """

    def __init__(self) -> None:
        self._data = bytearray()

    def take(self, byte: int) -> bytes | None:
        """Return the frame that this byte completes; the caller checks its form."""
        data = self._data
        data.append(byte)
        if len(data) <= 2:
            if byte != HEADER:
                data.clear()
            return None
        length = data[2]
        if length < 2:
            data.clear()
        if len(data) < 3 or len(data) < length + 2:
            return None
        whole = bytes(data)
        data.clear()
        return whole
