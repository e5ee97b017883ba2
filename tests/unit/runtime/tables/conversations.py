"""Captures of a line on which a host asks and a board replies, with some noise between."""

from busservo import ActionGroupRun, BatteryVoltage, BatteryVoltageRead, ServoPositions

UNKNOWN = bytes.fromhex("55 55 04 63 01 02")


def conversation(rounds: int) -> bytes:
    """Return what is sent in some rounds: messages of both ends, noise and an unknown frame."""
    return b"".join(_round(number) for number in range(rounds))


def _round(number: int) -> bytes:
    frames = [
        BatteryVoltageRead().encode(),
        BatteryVoltage(6000 + number % 1000).encode(),
        ServoPositions([(servo, (number * servo) % 1000) for servo in range(1, 4)]).encode(),
        ActionGroupRun(number % 200, 1).encode(),
    ]
    if number % 7 == 0:
        frames.insert(1, bytes([number % 200, 0x55, 0x55, 0x02]))
    if number % 11 == 0:
        frames.insert(2, UNKNOWN)
    return b"".join(frames)


def recorded(rounds: int) -> str:
    """Return a text recording with times."""
    lines = []
    for number in range(rounds):
        asked, told = BatteryVoltageRead().encode(), BatteryVoltage(7000 + number).encode()
        lines += [
            f"{asked.hex(' ')}  # {number / 10:.6f} s, host: a question",
            f"{told.hex(' ')}  # {number / 10 + 0.01:.6f} s, controller: an answer",
        ]
    return "\n".join(lines) + "\n"
