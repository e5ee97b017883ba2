"""What was on a line, in words and as JSON: messages, noise, and frames of unknown command."""

from __future__ import annotations

from ..codec import table_for
from ..direction import Direction
from ..errors import DecodeError
from ..messages import MESSAGES
from ..noise import Noise, UnknownFrame
from ..octets import spaced
from .values import fields_as_json, fields_as_text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import Any

    from ..decoder import Counters
    from ..message import Message

# How the ends are called, and which direction is whose.
SENDERS = {direction.sender: direction for direction in Direction}
# Who sent what is no message, and what may be a message of either end.
NOISE, UNKNOWN, EITHER = "noise", "unknown", "either"
KINDS = [*SENDERS, EITHER, NOISE, UNKNOWN]


def bytes_of(event: Message | Noise) -> bytes:
    """The bytes that it is made of."""
    return event.data if isinstance(event, Noise) else event.encode()


def names_of(event: Message | Noise, direction: Direction | None) -> list[str]:
    """The messages that it may be; none for noise."""
    if isinstance(event, Noise):
        return []
    return [kind.__name__ for kind in (type(event), *twins(event, direction))]


def sender_of(event: Message | Noise, direction: Direction | None) -> str:
    """Who sent it; `either` where nobody can tell; or that it is noise."""
    if isinstance(event, Noise):
        return UNKNOWN if isinstance(event, UnknownFrame) else NOISE
    return EITHER if twins(event, direction) else event.DIRECTION.sender


def in_words(event: Message | Noise, direction: Direction | None) -> str:
    """What it says: the name and the fields with their units; for noise, why it is noise."""
    if isinstance(event, UnknownFrame):
        return f"command={event.command} parameters={spaced(event.parameters) or 'none'}"
    if isinstance(event, Noise):
        return _why(event, direction)
    name = " or ".join(names_of(event, direction))
    return " ".join(part for part in (name, fields_as_text(event)) if part)


def as_record(event: Message | Noise, direction: Direction | None) -> dict[str, Any]:
    """What it says, for JSON."""
    if isinstance(event, Noise):
        record: dict[str, Any] = {"noise": spaced(event.data), "reason": event.reason.value}
        if isinstance(event, UnknownFrame):
            record |= {"command": event.command, "parameters": spaced(event.parameters)}
        return record
    record = {"direction": event.DIRECTION.value, "message": type(event).__name__}
    record |= {"fields": fields_as_json(event), "hex": spaced(event.encode())}
    others = names_of(event, direction)[1:]
    return record | {"or": others} if others else record


def totals(seen: Counters) -> str:
    """What a decoder has seen."""
    unknown = (
        f", {counted(seen.unknown_frames, 'unknown frame')} in it" if seen.unknown_frames else ""
    )
    told = f"{counted(seen.fed, 'byte')}: {counted(seen.messages, 'message')}"
    return f"{told}, {counted(seen.noise, 'byte')} of noise{unknown}"


def counted(number: int, noun: str, plural: str = "") -> str:
    """A number of things, in words."""
    return f"{number} {noun}" if number == 1 else f"{number} {plural or noun + 's'}"


def twins(message: Message, direction: Direction | None) -> list[type[Message]]:
    """The other messages that the same frame may be, where the direction is not known."""
    if direction is not None:
        return []
    found: list[type[Message]] = []
    for kind in MESSAGES:
        if kind.COMMAND == message.COMMAND and kind is not type(message):
            try:
                kind.decode(message.encode())
            except DecodeError:
                continue
            found.append(kind)
    return found


def _why(noise: Noise, direction: Direction | None) -> str:
    """The reason, and what was expected, where the bytes themselves tell."""
    try:
        table_for(direction).read(noise.data)
    except DecodeError as error:
        if error.reason is noise.reason:
            return f"{noise.reason.value}: {error.problem}"
    return noise.reason.value
