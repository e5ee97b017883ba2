"""A line on which a protocol is spoken, and a tally of it that is made while it is spoken."""

from collections import Counter
from dataclasses import dataclass, field
from random import Random
from typing import Any

from framegen.audit.audit import Audit, audit
from framegen.audit.recording import read_recording
from framegen.model.codec import encode
from framegen.model.model import Model

from tests.unit.guess.traffic import values_for


@dataclass
class Tally:
    """What was said: each message, each value by its path, and how many elements lists had."""

    messages: Counter[str] = field(default_factory=Counter)
    values: dict[str, list[Any]] = field(default_factory=dict)
    lines: list[str] = field(default_factory=list)
    size: int = 0

    def say(self, data: bytes, sender: str, what: str = "", seconds: float = 0.1) -> None:
        """Add a line to the recording."""
        at = seconds * len(self.lines)
        self.lines.append(f"{data.hex(' ').upper()}  # {at:.6f} s, {sender}: {what}")
        self.size += len(data)

    @property
    def text(self) -> str:
        """The recording."""
        begun = "# recorded of '/dev/line' from 2026-01-02 09:08:07.250000 +0000 on"
        return "\n".join([begun, *self.lines, ""])


def spoken(model: Model, chance: Random, frames: int = 60) -> Tally:
    """Return a recording of frames of all messages, in any order, with its tally."""
    tally = Tally()
    messages = [*model.messages.values()]
    for _ in range(frames):
        message = chance.choice(messages)
        values = values_for(message, chance)
        tally.say(encode(message, values), message.direction.sender, message.name)
        tally.messages[message.name] += 1
        for name, value in values.items():
            _count(tally, f"{message.name}.{name}", value)
    return tally


def _count(tally: Tally, path: str, value: Any) -> None:
    if isinstance(value, list):
        tally.values.setdefault(f"len {path}", []).append(len(value))
        for item in value:
            if isinstance(item, dict):
                for name, each in item.items():
                    _count(tally, f"{path}.{name}", each)
            else:
                _count(tally, f"{path}[]", item)
    elif value is not None:
        tally.values.setdefault(path, []).append(value)


def audited(model: Model, content: str | bytes, tolerated: int = 0) -> Audit:
    """Hold the content of a file against a model."""
    given = content.encode() if isinstance(content, str) else content
    recording = read_recording("line", given, [*model.spec.endpoints], model.roles)
    return audit(model, [recording], model.directions, tolerated)
