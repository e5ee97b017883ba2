"""The tables of truth: frames and their meaning, bytes that are none, values that none carries.

Every frame was typed in from the protocol document or follows from its rules; none was produced by
the library. Whatever reads or writes frames is held to these tables.
"""

from collections.abc import Callable
from typing import Any, NamedTuple, TypeAlias

from busservo import (
    ActionGroupCompleted,
    ActionGroupRun,
    ActionGroupSpeed,
    ActionGroupStarted,
    ActionGroupStop,
    ActionGroupStopped,
    BatteryVoltage,
    BatteryVoltageRead,
    Direction,
    Message,
    Reason,
    ServoMove,
    ServoPosition,
    ServoPositions,
    ServoPositionsRead,
    ServoTarget,
    ServoUnload,
)

from tests.in_turn import in_turn

HOST = Direction.HOST_TO_CONTROLLER
CONTROLLER = Direction.CONTROLLER_TO_HOST
EITHER = None


class Case(NamedTuple):
    """A message, its frame, who sends it, and the source of it if there is one."""

    message: Message
    hex: str
    direction: Direction
    source: str

    @property
    def frame(self) -> bytes:
        return bytes.fromhex(self.hex)


CASES = (
    # The fourteen frames of the document.
    Case(
        ServoMove(time_ms=1000, targets=[(1, 800)]),
        "55 55 08 03 01 E8 03 01 20 03",
        HOST,
        "1.1 example 1",
    ),
    Case(
        ServoMove(time_ms=800, targets=[ServoTarget(servo_id=2, position=800), (9, 800)]),
        "55 55 0B 03 02 20 03 02 20 03 09 20 03",
        HOST,
        "1.1 example 2",
    ),
    Case(ActionGroupRun(group=8, times=1), "55 55 05 06 08 01 00", HOST, "1.2 example 1"),
    Case(
        ActionGroupRun(group=2, times=ActionGroupRun.TIMES_UNLIMITED),
        "55 55 05 06 02 00 00",
        HOST,
        "1.2 example 2",
    ),
    Case(ActionGroupStop(), "55 55 02 07", HOST, "1.3 example"),
    Case(ActionGroupSpeed(group=8, percent=50), "55 55 05 0B 08 32 00", HOST, "1.4 example 1"),
    Case(
        ActionGroupSpeed(group=ActionGroupSpeed.GROUP_ALL, percent=300),
        "55 55 05 0B FF 2C 01",
        HOST,
        "1.4 example 2",
    ),
    Case(BatteryVoltageRead(), "55 55 02 0F", HOST, "1.5 request"),
    Case(BatteryVoltage(voltage_mv=7500), "55 55 04 0F 4C 1D", CONTROLLER, "1.5 reply"),
    Case(ServoUnload(servo_ids=[1, 2, 3]), "55 55 06 14 03 01 02 03", HOST, "1.6 example 1"),
    Case(
        ServoUnload(servo_ids=range(1, 7)),
        "55 55 09 14 06 01 02 03 04 05 06",
        HOST,
        "1.6 example 2",
    ),
    Case(
        ServoPositionsRead(servo_ids=range(1, 7)),
        "55 55 09 15 06 01 02 03 04 05 06",
        HOST,
        "1.7 request",
    ),
    Case(
        ServoPositions(positions=[(1, 500), (2, 500), (3, 500), (4, 500), (5, 500), (6, 500)]),
        "55 55 15 15 06 01 F4 01 02 F4 01 03 F4 01 04 F4 01 05 F4 01 06 F4 01",
        CONTROLLER,
        "1.7 reply",
    ),
    Case(ActionGroupStarted(group=8, times=1), "55 55 05 06 08 01 00", CONTROLLER, "2.1 report"),
    Case(
        ActionGroupStarted(group=2, times=ActionGroupStarted.TIMES_UNLIMITED),
        "55 55 05 06 02 00 00",
        CONTROLLER,
        "report of 1.2 example 2",
    ),
    # From elsewhere: a real board, and the two reports that the document only hints at.
    Case(BatteryVoltage(voltage_mv=7881), "55 55 04 0F C9 1E", CONTROLLER, "captured reply"),
    Case(ActionGroupStopped(), "55 55 02 07", CONTROLLER, "report of a stop"),
    Case(ActionGroupCompleted(group=8, times=1), "55 55 05 08 08 01 00", CONTROLLER, "report 8"),
    Case(
        ServoPositions(positions=[(3, ServoPosition.POSITION_ABSENT)]),
        "55 55 06 15 01 03 FF FF",
        CONTROLLER,
        "a servo that is off",
    ),
    # A low byte and a high byte that cannot be mistaken for each other.
    Case(
        ServoMove(time_ms=0x1234, targets=[(0x56, 0x789A)]),
        "55 55 08 03 01 34 12 56 9A 78",
        HOST,
        "byte order of a move",
    ),
    Case(
        ServoPositions(positions=[(0x12, 0x3456)]),
        "55 55 06 15 01 12 56 34",
        CONTROLLER,
        "byte order of a reply",
    ),
    # The ends of the ranges.
    Case(ServoMove(0, [(0, 0)]), "55 55 08 03 01 00 00 00 00 00", HOST, "lowest move"),
    Case(
        ServoMove(65535, [(255, 65535)] * 83),
        "55 55 FE 03 53 FF FF" + 83 * " FF FF FF",
        HOST,
        "highest move",
    ),
    Case(ActionGroupRun(0, 0), "55 55 05 06 00 00 00", HOST, "lowest run"),
    Case(ActionGroupRun(255, 65535), "55 55 05 06 FF FF FF", HOST, "highest run"),
    Case(ActionGroupSpeed(0, 0), "55 55 05 0B 00 00 00", HOST, "lowest speed"),
    Case(ActionGroupSpeed(255, 65535), "55 55 05 0B FF FF FF", HOST, "highest speed"),
    Case(ServoUnload([0]), "55 55 04 14 01 00", HOST, "lowest unload"),
    Case(ServoUnload([255] * 252), "55 55 FF 14 FC" + 252 * " FF", HOST, "highest unload"),
    Case(ServoPositionsRead([0]), "55 55 04 15 01 00", HOST, "lowest request"),
    Case(ServoPositionsRead([255] * 252), "55 55 FF 15 FC" + 252 * " FF", HOST, "highest request"),
    Case(ActionGroupStarted(0, 0), "55 55 05 06 00 00 00", CONTROLLER, "lowest start"),
    Case(ActionGroupStarted(255, 65535), "55 55 05 06 FF FF FF", CONTROLLER, "highest start"),
    Case(ActionGroupCompleted(0, 0), "55 55 05 08 00 00 00", CONTROLLER, "lowest end"),
    Case(ActionGroupCompleted(255, 65535), "55 55 05 08 FF FF FF", CONTROLLER, "highest end"),
    Case(BatteryVoltage(0), "55 55 04 0F 00 00", CONTROLLER, "lowest voltage"),
    Case(BatteryVoltage(65535), "55 55 04 0F FF FF", CONTROLLER, "highest voltage"),
    Case(ServoPositions([]), "55 55 03 15 00", CONTROLLER, "no servo answered"),
    Case(
        ServoPositions([(255, 65535)] * 84),
        "55 55 FF 15 54" + 84 * " FF FF FF",
        CONTROLLER,
        "every servo answered",
    ),
    # Headers that are parameters.
    Case(
        ServoMove(0x5555, [(0x55, 0x0702)]),
        "55 55 08 03 01 55 55 55 02 07",
        HOST,
        "a stop within a move",
    ),
    Case(BatteryVoltage(0x5555), "55 55 04 0F 55 55", CONTROLLER, "a header as a voltage"),
)

each_case = in_turn("case", lambda: CASES, ids=lambda case: case.source)


class BadFrame(NamedTuple):
    """Bytes that are no frame of a direction, the reason, and the first byte that shows it."""

    hex: str
    direction: Direction | None
    reason: Reason
    offset: int

    @property
    def frame(self) -> bytes:
        return bytes.fromhex(self.hex)


BAD_FRAMES = (
    # The header is looked at first, as far as it is there.
    BadFrame("", HOST, Reason.TOO_SHORT, 0),
    BadFrame("55", HOST, Reason.TOO_SHORT, 1),
    BadFrame("55 55", CONTROLLER, Reason.TOO_SHORT, 2),
    BadFrame("55 55 02", EITHER, Reason.TOO_SHORT, 3),
    BadFrame("00", HOST, Reason.BAD_HEADER, 0),
    BadFrame("54 55 02 07", HOST, Reason.BAD_HEADER, 0),
    BadFrame("55 54 02 07", CONTROLLER, Reason.BAD_HEADER, 1),
    BadFrame("55 AA", EITHER, Reason.BAD_HEADER, 1),
    BadFrame("00 55 55 02 07", HOST, Reason.BAD_HEADER, 0),
    # Then the length, which must be possible for some frame, whatever the command is.
    BadFrame("55 55 01", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 01 63", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 00 63", CONTROLLER, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 00 07", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 01 07", EITHER, Reason.LENGTH_MISMATCH, 2),
    # Then the command, which must be one of its direction.
    BadFrame("55 55 02 00", EITHER, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 02 FF", HOST, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 FF 55 55 02 07", HOST, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 05 08 08 01 00", HOST, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 08 03 01 E8 03 01 20 03", CONTROLLER, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 05 0B 08 32 00", CONTROLLER, Reason.UNKNOWN_COMMAND, 3),
    BadFrame("55 55 06 14 03 01 02 03", CONTROLLER, Reason.UNKNOWN_COMMAND, 3),
    # Then both together: the length must be one of the command's.
    BadFrame("55 55 03 07 00", EITHER, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 05 03 00 E8 03", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 09 03 01 E8 03 01 20 03 00", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 FF 03 54", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 03 14 00", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 03 15 00", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 04 15 01 01", CONTROLLER, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 02 15", EITHER, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 04 0F 4C 1D", HOST, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 02 0F", CONTROLLER, Reason.LENGTH_MISMATCH, 2),
    BadFrame("55 55 03 0F 00", EITHER, Reason.LENGTH_MISMATCH, 2),
    # Then the count, which must be what follows from the length, even of a frame that is cut off.
    BadFrame("55 55 08 03 00 E8 03 01 20 03", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 08 03 02 E8 03 01 20 03", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 08 03 02 E8 03 01 20", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 06 14 06 01 02 03", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 06 14 04 01 02 03 00", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 04 15 00 01", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 06 15 01 03 FF FF", HOST, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 06 15 03 01 02 03", CONTROLLER, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 03 15 01", CONTROLLER, Reason.COUNT_MISMATCH, 4),
    BadFrame("55 55 06 15 02 01 02 03", EITHER, Reason.COUNT_MISMATCH, 4),
    # Then the size, which must be what the length says.
    BadFrame("55 55 05 06", HOST, Reason.TOO_SHORT, 4),
    BadFrame("55 55 05 06 08 01", CONTROLLER, Reason.TOO_SHORT, 6),
    BadFrame("55 55 08 03 01 E8 03 01 20", HOST, Reason.TOO_SHORT, 9),
    BadFrame("55 55 FF 15", EITHER, Reason.TOO_SHORT, 4),
    BadFrame("55 55 02 07 00", HOST, Reason.TRAILING_BYTES, 4),
    BadFrame("55 55 02 07 55 55 02 07", EITHER, Reason.TRAILING_BYTES, 4),
    BadFrame("55 55 04 0F 4C 1D 00", CONTROLLER, Reason.TRAILING_BYTES, 6),
    BadFrame("55 55 06 14 03 01 02 03 00", HOST, Reason.TRAILING_BYTES, 8),
    # An LX-16A frame, which many take for one of this protocol: servo 1 to 500 in 1000 ms.
    BadFrame("55 55 01 07 01 F4 01 E8 03 16", HOST, Reason.LENGTH_MISMATCH, 2),
)

each_bad_frame = in_turn(
    "bad", lambda: BAD_FRAMES, ids=lambda bad: f"{bad.direction and bad.direction.sender}-{bad.hex}"
)


class BadValue(NamedTuple):
    """A message that cannot exist, the place of its first wrong value, and the error's text."""

    make: Callable[..., Message]
    fields: dict[str, Any]
    path: str
    value: object
    problem: str


_Made: TypeAlias = tuple[Callable[..., Message], dict[str, Any]]


def _move(*targets: Any, time_ms: Any = 1000) -> _Made:
    return ServoMove, {"time_ms": time_ms, "targets": [*targets]}


def _run(group: Any, times: Any = 1) -> _Made:
    return ActionGroupRun, {"group": group, "times": times}


def _unload(servo_ids: Any) -> _Made:
    return ServoUnload, {"servo_ids": servo_ids}


def _ask(servo_ids: Any) -> _Made:
    return ServoPositionsRead, {"servo_ids": servo_ids}


def _told(positions: Any) -> _Made:
    return ServoPositions, {"positions": positions}


_HUGE = 10**5000  # more digits than Python agrees to print
_LONG = "x" * 100
_NO_NUMBER, _TRUTH = "is not a whole number, but", "is a truth value, not a whole number"
_NO_PAIR, _NO_LIST = "is not (servo_id, position)", "is not a list of whole numbers"

BAD_VALUES = (
    # Outside the range, by one and by far.
    BadValue(*_run(-1), "group", -1, "-1 is outside 0..255"),
    BadValue(*_run(256), "group", 256, "256 is outside 0..255"),
    BadValue(*_run(1, -1), "times", -1, "-1 is outside 0..65535"),
    BadValue(*_run(1, 65536), "times", 65536, "65536 is outside 0..65535"),
    BadValue(*_run(_HUGE), "group", _HUGE, "an integer of 16610 bits is outside 0..255"),
    BadValue(*_run(1, -_HUGE), "times", -_HUGE, "an integer of 16610 bits is outside 0..65535"),
    BadValue(*_move((1, 8), (2, 65536)), "targets[1].position", 65536, "65536 is outside 0..65535"),
    BadValue(*_move((256, 800)), "targets[0].servo_id", 256, "256 is outside 0..255"),
    BadValue(*_move((1, 1), time_ms=65536), "time_ms", 65536, "65536 is outside 0..65535"),
    BadValue(*_unload([1, 300]), "servo_ids[1]", 300, "300 is outside 0..255"),
    # No whole number.
    BadValue(*_run(True), "group", True, f"True {_TRUTH}"),
    BadValue(*_run(1, False), "times", False, f"False {_TRUTH}"),
    BadValue(*_run(1.0), "group", 1.0, f"1.0 {_NO_NUMBER} a float"),
    BadValue(*_run("8"), "group", "8", f"'8' {_NO_NUMBER} a str"),
    BadValue(*_run(None), "group", None, f"None {_NO_NUMBER} nothing"),
    BadValue(*_run([8]), "group", [8], f"[8] {_NO_NUMBER} a list"),
    BadValue(*_run(_LONG), "group", _LONG, f"'{56 * 'x'}... {_NO_NUMBER} a str"),
    BadValue(*_move((1, True)), "targets[0].position", True, f"True {_TRUTH}"),
    BadValue(*_move((1, 1.5)), "targets[0].position", 1.5, f"1.5 {_NO_NUMBER} a float"),
    BadValue(*_move((None, 1)), "targets[0].servo_id", None, f"None {_NO_NUMBER} nothing"),
    BadValue(*_move((1, 1), time_ms=0.5), "time_ms", 0.5, f"0.5 {_NO_NUMBER} a float"),
    BadValue(*_unload([1, True]), "servo_ids[1]", True, f"True {_TRUTH}"),
    BadValue(*_unload(["1"]), "servo_ids[0]", "1", f"'1' {_NO_NUMBER} a str"),
    BadValue(*_unload([(1, 2)]), "servo_ids[0]", (1, 2), f"(1, 2) {_NO_NUMBER} a tuple"),
    # No pair.
    BadValue(*_move(1), "targets[0]", 1, f"1 {_NO_PAIR}"),
    BadValue(*_move((1,)), "targets[0]", (1,), f"(1,) {_NO_PAIR}"),
    # Nor do two wrongs make a right, though together they have as many numbers as two pairs.
    BadValue(*_move((1,), (1, 2, 3)), "targets[0]", (1,), f"(1,) {_NO_PAIR}"),
    BadValue(*_move((1, 2), (1, 2, 3)), "targets[1]", (1, 2, 3), f"(1, 2, 3) {_NO_PAIR}"),
    BadValue(*_move(None), "targets[0]", None, f"None {_NO_PAIR}"),
    BadValue(*_move("ab"), "targets[0]", "ab", f"'ab' {_NO_PAIR}"),
    BadValue(*_move(b"ab"), "targets[0]", b"ab", f"b'ab' {_NO_PAIR}"),
    BadValue(*_move({7, 8}), "targets[0]", {7, 8}, f"{ {7, 8} } {_NO_PAIR}"),
    BadValue(*_move({1: 2, 3: 4}), "targets[0]", {1: 2, 3: 4}, f"{ {1: 2, 3: 4} } {_NO_PAIR}"),
    # Pairs as a mapping.
    *(
        BadValue(ServoMove, {"time_ms": 1, "targets": pairs}, path, value, text)
        for pairs, path, value, text in (
            ({1: 2, 3: 70000}, "targets[1].position", 70000, "70000 is outside 0..65535"),
            ({300: 2}, "targets[0].servo_id", 300, "300 is outside 0..255"),
            ({"a": 2}, "targets[0].servo_id", "a", f"'a' {_NO_NUMBER} a str"),
            ({}, "targets", {}, "0 items is outside 1..83"),
        )
    ),
    # No list.
    BadValue(*_unload(1), "servo_ids", 1, f"1 {_NO_LIST}"),
    BadValue(*_unload(None), "servo_ids", None, f"None {_NO_LIST}"),
    BadValue(*_unload("12"), "servo_ids", "12", f"'12' {_NO_LIST}"),
    BadValue(*_unload({1}), "servo_ids", {1}, f"{{1}} {_NO_LIST}"),
    BadValue(*_unload({1: 2}), "servo_ids", {1: 2}, f"{{1: 2}} {_NO_LIST}"),
    BadValue(*_told(None), "positions", None, "None is not a list of (servo_id, position)"),
    # Too few and too many.
    BadValue(*_move(), "targets", [], "0 items is outside 1..83"),
    BadValue(*_move(*[(1, 1)] * 84), "targets", [(1, 1)] * 84, "84 items is outside 1..83"),
    BadValue(*_unload([]), "servo_ids", [], "0 items is outside 1..252"),
    BadValue(*_unload([1] * 253), "servo_ids", [1] * 253, "253 items is outside 1..252"),
    BadValue(*_ask(()), "servo_ids", (), "0 items is outside 1..252"),
    BadValue(*_ask((1,) * 253), "servo_ids", (1,) * 253, "253 items is outside 1..252"),
    BadValue(*_told([(1, 1)] * 85), "positions", [(1, 1)] * 85, "85 items is outside 0..84"),
    # The first wrong value is the one that is reported, in the order of the arguments.
    BadValue(*_run(256, 65536), "group", 256, "256 is outside 0..255"),
    BadValue(*_move((256, 65536), time_ms=-1), "time_ms", -1, "-1 is outside 0..65535"),
)

each_bad_value = in_turn("bad", lambda: BAD_VALUES, ids=lambda bad: f"{bad.path}-{bad.problem}")
