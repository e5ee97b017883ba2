"""The generated library, and the statements with which its users do the work of each row."""

from __future__ import annotations

from textwrap import indent
from typing import Any

import busservo
from busservo import Direction, Noise, ServoMove, ServoPositions, StreamDecoder

from benchmarks import floor, messages, streams
from benchmarks.results import AS_COLUMNS, AT_HAND, BY_CLASS, CLIENT, EVERY_FIELD, IN_USE, OURS

IMPORTS = {
    OURS: "import busservo",
    IN_USE: "from busservo import StreamDecoder, decode",
    CLIENT: "from busservo import Controller",
}
"""Names are imported on first use, so the import statement alone shows half of the cost."""

_NAMES: dict[str, Any] = {
    "decode": busservo.decode,
    "from_controller": Direction.CONTROLLER_TO_HOST,
    "ActionGroupCompleted": busservo.ActionGroupCompleted,
    "ActionGroupStarted": busservo.ActionGroupStarted,
    "BatteryVoltage": busservo.BatteryVoltage,
    "ServoMove": ServoMove,
    "ServoPositions": ServoPositions,
}

_READ_POSITIONS = "for servo in {}.positions:\n    servo.servo_id; servo.position"
_READ_COLUMNS = "servo_ids, positions = {}.columns()"

_READ_STREAM = """\
for chunk in chunks:
    for event in feed(chunk):
        kind = type(event)
        if kind is ServoPositions:
            {positions}
        elif kind is BatteryVoltage:
            event.voltage_mv
        elif kind is ActionGroupStarted or kind is ActionGroupCompleted:
            event.group; event.times
        else:
            event.data
"""


def message_cases(row: str) -> list[messages.Case]:
    """Return the cases that encode or decode one message, one for each way to do it."""
    if row in messages.ENCODE_ROWS:
        targets = messages.targets(messages.ENCODE_ROWS[row])
        names = {
            **_NAMES,
            "time_ms": messages.TIME_MS,
            "targets": targets,
            "move": ServoMove(messages.TIME_MS, targets),
        }
        whole = "ServoMove(time_ms, targets).encode()"
        return [
            messages.Case(OURS, whole, whole, names),
            messages.Case(AT_HAND, "move.encode()", "move.encode()", names),
        ]
    command = messages.DECODE_ROWS[row]
    names = {**_NAMES, "frame": messages.FRAMES[command]}
    dispatched = "decode(frame, from_controller)"
    columns = []
    if command == floor.POSITIONS:
        statement = _READ_COLUMNS.format(dispatched)
        paired = f"tuple(zip(*{dispatched}.columns()))"
        columns = [messages.Case(AS_COLUMNS, statement, paired, names)]
        known = "ServoPositions.decode(frame)"
        reading = _READ_POSITIONS.format(dispatched)
    else:
        known = "BatteryVoltage.decode(frame)"
        reading = f"{dispatched}.voltage_mv"
    return [
        messages.Case(OURS, dispatched, dispatched, names, plain),
        messages.Case(BY_CLASS, known, known, names, plain),
        messages.Case(EVERY_FIELD, reading, dispatched, names, plain),
        *columns,
    ]


def stream_cases() -> list[streams.Case]:
    """Return the cases that decode a stream: messages alone, and every field, in two ways."""
    plainly = _read_stream(_READ_POSITIONS)
    columns = _read_stream(_READ_COLUMNS)
    return [
        streams.Case(OURS, decoder, plain_events, whole=True),
        streams.Case(EVERY_FIELD, decoder, plain_events, plainly, _NAMES, whole=True),
        streams.Case(AS_COLUMNS, decoder, plain_events, columns, _NAMES, whole=True),
    ]


def _read_stream(positions: str) -> str:
    """Return a statement that reads a whole stream, with this one for a reply with positions."""
    return _READ_STREAM.format(positions=indent(positions.format("event"), " " * 12).lstrip())


def decoder() -> StreamDecoder:
    """Return a decoder of what the controller sends."""
    return StreamDecoder(Direction.CONTROLLER_TO_HOST)


def plain(message: Any) -> object:
    """Return a message in the form of the floor: used to check, never timed."""
    if isinstance(message, busservo.ServoPositions):
        return tuple((servo.servo_id, servo.position) for servo in message.positions)
    if isinstance(message, busservo.BatteryVoltage):
        return message.voltage_mv
    if isinstance(message, busservo.ActionGroupStopped):
        return None
    return message.group, message.times


def plain_events(events: list[Any]) -> list[tuple[int, object]]:
    """Return the messages among these events in the form of the floor."""
    return [(event.COMMAND, plain(event)) for event in events if not isinstance(event, Noise)]
