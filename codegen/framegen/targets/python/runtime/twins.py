"""Frames that a message of either end may be: the same command, and the same bytes."""

from __future__ import annotations

from .errors import DecodeError
from .messages import MESSAGES
from .protocol import UNCOUNTED

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from .message import Message

_same_command: dict[type[Message], list[type[Message]]] = {}


def twins(message: Message) -> list[type[Message]]:
    """The other messages that the same frame may be, where nobody knows who has sent it."""
    kind = type(message)
    others = _same_command.get(kind)
    if others is None:
        others = [each for each in MESSAGES if each.COMMAND == kind.COMMAND and each is not kind]
        _same_command[kind] = others
    if not others:
        return others
    frame = message.encode()
    return [
        each for each in others if len(frame) - UNCOUNTED in each.LENGTHS and _reads(each, frame)
    ]


def _reads(kind: type[Message], frame: bytes) -> bool:
    try:
        kind.decode(frame)
    except DecodeError:
        return False
    return True
