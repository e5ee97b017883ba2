"""A second opinion on the protocol, written with construct straight from the source documents.

The library is held to this module, so this module shares nothing with it: no import, no
table, no arithmetic.  It is slow and says everything once.  In particular no length rule and
no greatest count is written here.  A frame is *laid out*, construct measures it, and both
follow: `servos * 3 + 5` is simply what the bytes of a move add up to, and an 84th servo is
refused because the length byte cannot hold the result.

Decided where the documents are silent: a request names at least one servo; a position reply
may hold none; ids, groups and 16-bit values are limited by their width alone.
"""

import functools
import operator
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, NamedTuple

from construct import (
    Byte,
    Check,
    Const,
    ConstructError,
    FocusedSeq,
    FormatField,
    Int16ul,
    Prefixed,
    PrefixedArray,
    Rebuild,
    Struct,
    Terminated,
    len_,
    this,
)

HOST_TO_CONTROLLER = "host_to_controller"
CONTROLLER_TO_HOST = "controller_to_host"


class OracleError(ValueError):
    """These bytes are not exactly one legal frame, or these values cannot be sent."""


class _Frame(NamedTuple):
    """The layout of a frame, and its command, which stands behind header and length."""

    command: int
    layout: Any


def _frame(command: int, *parameters: Any) -> _Frame:
    """Lay out one frame: `55 55`, then a length byte that counts itself and all after it."""
    body = Struct(Const(command, Byte), *parameters, Terminated)
    layout = Struct(
        Const(b"\x55\x55"),
        "body" / Prefixed(Byte, body, includelength=True),
        Terminated,
    )
    return _Frame(command, layout)


_SERVO_AND_POSITION = Struct("servo_id" / Byte, "position" / Int16ul)
_GROUP_AND_TIMES = ("group" / Byte, "times" / Int16ul)
_SERVO_IDS = ("servo_ids" / PrefixedArray(Byte, Byte), Check(len_(this.servo_ids) >= 1))

# A move is the one frame whose count does not stand directly before what it counts. What begins
# with `_` is no field: parse() leaves it out, and construct works it out again.
_MOVE = (
    "_servo_count" / Rebuild(Byte, len_(this.targets)),
    Check(this._servo_count >= 1),
    "time_ms" / Int16ul,
    "targets" / _SERVO_AND_POSITION[this._servo_count],
)

_FRAMES: dict[str, dict[str, _Frame]] = {
    HOST_TO_CONTROLLER: {
        "ServoMove": _frame(3, *_MOVE),
        "ActionGroupRun": _frame(6, *_GROUP_AND_TIMES),
        "ActionGroupStop": _frame(7),
        "ActionGroupSpeed": _frame(11, "group" / Byte, "percent" / Int16ul),
        "BatteryVoltageRead": _frame(15),
        "ServoUnload": _frame(20, *_SERVO_IDS),
        "ServoPositionsRead": _frame(21, *_SERVO_IDS),
    },
    CONTROLLER_TO_HOST: {
        "ActionGroupStarted": _frame(6, *_GROUP_AND_TIMES),
        "ActionGroupStopped": _frame(7),
        "ActionGroupCompleted": _frame(8, *_GROUP_AND_TIMES),
        "BatteryVoltage": _frame(15, "voltage_mv" / Int16ul),
        "ServoPositions": _frame(21, "positions" / PrefixedArray(Byte, _SERVO_AND_POSITION)),
    },
}

MESSAGES: dict[str, tuple[str, ...]] = {
    direction: tuple(frames) for direction, frames in _FRAMES.items()
}
"""The message names of each direction; no name occurs in both."""


def parse(frame: bytes, direction: str | None) -> tuple[str, dict[str, Any]]:
    """Read exactly one frame as (message name, field values), or raise OracleError.

    Servo ids come as a list of int, targets and positions as a list of dicts.  With direction
    None either side may have sent it, and a frame that is legal both ways is the host's.
    """
    directions = MESSAGES if direction is None else (direction,)
    for frames in (_FRAMES[each] for each in directions):
        for name, (command, layout) in frames.items():
            # construct would refuse it as well, and take its time.
            if frame[3:4] != bytes([command]):
                continue
            try:
                body = layout.parse(frame).body
            except ConstructError:
                continue
            return name, _plain(body)
    raise OracleError(f"not one legal frame ({direction or 'either direction'}): {frame.hex(' ')}")


def build(name: str, fields: Mapping[str, Any]) -> bytes:
    """Write one message as a frame, or raise OracleError.

    Takes what `parse` returns; sequences may be lists or tuples.
    """
    values = _numbers(dict(fields))
    found = next((frames[name] for frames in _FRAMES.values() if name in frames), None)
    if found is None:
        raise OracleError(f"no message is called {name}")
    try:
        frame: bytes = found.layout.build({"body": values})
    except (ConstructError, KeyError, TypeError, ValueError) as error:
        raise OracleError(f"{name} cannot be sent with {fields}: {error}") from error
    # construct overlooks a field that it does not know; reading the frame back does not.
    _, read_back = parse(frame, _direction_of(name))
    if read_back != values:
        raise OracleError(f"{name} would be sent as {read_back}, not as {values}")
    return frame


def scan(
    data: bytes, direction: str | None, *, quiet: bool = True
) -> list[tuple[str, dict[str, Any]] | bytes]:
    """Read a whole recording: messages as `parse` returns them, noise between them as bytes.

    The rule: a legal frame that starts at this byte is taken; otherwise this byte is noise, and
    the search goes on with the next.  No length is trusted before its whole frame is legal, so
    nothing is ever skipped.  Adjacent noise is joined.

    `quiet` says that the line has gone quiet after the data.  The beginning of a frame that never
    came to its end then costs one byte like any other noise, which is why no rule of its own is
    needed for it.  With quiet=False the scan stops there instead, as a decoder that still waits
    does: the bytes that are in no event are the ones still held.
    """
    events: list[tuple[str, dict[str, Any]] | bytes] = []
    noise = b""
    start = 0
    while start < len(data):
        if not quiet and may_become_frame(data[start:], direction):
            break
        try:
            # A slice and not an index: the data may end before there is a length byte.
            size = 2 + sum(data[start + 2 : start + 3])
            message = parse(data[start : start + size], direction)
        except OracleError:
            noise += data[start : start + 1]
            start += 1
            continue
        if noise:
            events.append(noise)
            noise = b""
        events.append(message)
        start += size
    if noise:
        events.append(noise)
    return events


def messages_of(found: Iterable[Any]) -> list[Any]:
    """Leave the noise out of a reading."""
    return [each for each in found if not isinstance(each, bytes)]


def may_become_frame(data: bytes, direction: str | None) -> bool:
    """Return whether this begins some legal frame, one or more bytes short of its end."""
    return any(
        len(data) < len(frame) and data[: len(beginning)] == beginning[: len(data)]
        for each in (MESSAGES if direction is None else (direction,))
        for beginning, frame in _beginnings(each).get(data[:4], [])
    )


def _direction_of(name: str) -> str:
    return next(direction for direction, names in MESSAGES.items() if name in names)


def _numbers(value: Any) -> Any:
    """Copy a value with every number as a plain int: True, 1.0, "1" and None are no numbers."""
    if isinstance(value, dict):
        return {key: _numbers(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_numbers(item) for item in value]
    if isinstance(value, bool):
        raise OracleError(f"{value} is not a number")
    try:
        return operator.index(value)
    except TypeError as error:
        raise OracleError(f"{value!r} is not a number") from error


def _plain(value: Any) -> Any:
    """Copy what construct has read into plain dicts and lists, without its private keys."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items() if not key.startswith("_")}
    if isinstance(value, list):
        return [_plain(item) for item in value]
    return value


@functools.cache
def _beginnings(direction: str) -> dict[bytes, list[tuple[bytes, bytes]]]:
    """List one frame per message and count, each with the part that its parameters cannot change.

    All fields but the count take any value, so header, length, command and count, the first five
    bytes, decide which beginnings are legal; in a frame without a count, the first four do.
    Each is found by any part of its first four bytes.
    """
    pairs: dict[bytes, list[tuple[bytes, bytes]]] = {}
    for name in MESSAGES[direction]:
        blanks = [*_blanks(_FRAMES[direction][name].layout)]
        fixed = 4 if len(blanks) == 1 else 5
        for frame in _built(name, blanks):
            for size in range(5):
                pairs.setdefault(frame[:size], []).append((frame[:fixed], frame))
    return pairs


def _blanks(layout: Any) -> Iterator[dict[str, Any]]:
    """Give the fields of a layout with every number 0, once for each length of its list.

    More elements than any frame can hold are tried: build() knows where the limit is.
    """
    body = layout.body.subcon.subcon
    fields = [each for each in body.subcons if each.name and not each.name.startswith("_")]
    numbers = {each.name: 0 for each in fields if isinstance(each.subcon, FormatField)}
    lists = {each.name: _zero(each.subcon) for each in fields if each.name not in numbers}
    for count in range(256) if lists else range(1):
        yield {**numbers, **{name: [element] * count for name, element in lists.items()}}


def _zero(layout: Any) -> Any:
    """Give an element of a list with every number 0."""
    if isinstance(layout, FormatField):
        return 0
    if isinstance(layout, Struct):
        return {each.name: 0 for each in layout.subcons}
    # A list with its count in front holds both; any other list holds the layout of its elements.
    return _zero(layout.subcons[-1] if isinstance(layout, FocusedSeq) else layout.subcon)


def _built(name: str, attempts: Iterable[dict[str, Any]]) -> Iterator[bytes]:
    """Build the frames of a message that can be built, up to the longest list that can."""
    frame = b""
    for fields in attempts:
        try:
            frame = build(name, fields)
        except OracleError:
            if frame:
                return
            continue
        yield frame
