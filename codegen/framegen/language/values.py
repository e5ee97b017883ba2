"""The notations of the spec language: hex, `host -> controller`, `1..`, `0.001 V`, citations.

Each is a frozen value with a `parse` that raises ValueError with what is wrong and what to write.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from decimal import Decimal

from framewire.codec.hextext import is_hex, read_hex

_HEX = re.compile(r"(?:[0-9A-Fa-f]{2}\s+)*[0-9A-Fa-f]{2}")
_BYTE = re.compile(r"[0-9A-Fa-f]{2}")
_DIRECTION = re.compile(r"(\S+)\s*->\s*(\S+)")
_NUMBER = r"-?[0-9]{1,20}|0x[0-9A-Fa-f]{1,16}"
_RANGE = re.compile(rf"({_NUMBER})\s*\.\.\s*({_NUMBER})?")
_METHOD = re.compile(r"(\w+)\s*\(\s*((?:\w+(?:\s*,\s*\w+)*)?)\s*\)(?:\s*->\s*(\w+))?", re.ASCII)
_FAILURE = re.compile(rf"(\w+)(?:\s+unless\s+({_NUMBER}))?", re.ASCII)
_NAME = re.compile(r"\w+", re.ASCII)
_DECIMAL = r"[0-9]{1,12}(?:\.[0-9]{1,24})?"
_SCALE = re.compile(rf"({_DECIMAL})(?:\s+([^-+\s]\S*))?(?:\s+([-+])\s*({_DECIMAL}))?")


@dataclass(frozen=True, slots=True)
class Direction:
    """A sender and a receiver, written `host -> controller`."""

    sender: str
    receiver: str

    def __str__(self) -> str:
        return f"{self.sender} -> {self.receiver}"

    @property
    def reversed(self) -> Direction:
        """The opposite direction."""
        return Direction(self.receiver, self.sender)

    @property
    def key(self) -> str:
        """The direction as one word, `host_to_controller`."""
        return f"{self.sender}_to_{self.receiver}"

    @classmethod
    def parse(cls, text: str) -> Direction:
        """Read `host -> controller`."""
        match = _DIRECTION.fullmatch(text)
        if match is None:
            raise ValueError(f"`{text}` is no direction: write it like `host -> controller`")
        return cls(match[1], match[2])


@dataclass(frozen=True, slots=True)
class Range:
    """An inclusive range, written `0..1000`; `high` is None in an open one, `1..`."""

    low: int
    high: int | None

    def __str__(self) -> str:
        return f"{self.low}..{'' if self.high is None else self.high}"

    def holds(self, other: Range) -> bool:
        """Tell whether another range lies inside this one."""
        within = self.high is None or (other.high is not None and other.high <= self.high)
        return self.low <= other.low and within

    @classmethod
    def only(cls, number: int) -> Range:
        """Return the range of one number."""
        return cls(number, number)

    @classmethod
    def parse(cls, text: str) -> Range:
        """Read `0..1000`, `0x20..0x7E` or `1..`."""
        match = _RANGE.fullmatch(text)
        if match is None:
            raise ValueError(
                f"`{text}` is no range: write it like `0..1000`, "
                "or `1..` where the frame sets the end"
            )
        return cls(_number(match[1]), None if match[2] is None else _number(match[2]))


@dataclass(frozen=True, slots=True)
class Scale:
    """The size of one step of a value in a larger unit, written `0.001 V`.

    With what a value of zero is in that unit, if it is not zero: `0.125 °C - 256`. What has no
    unit, such as a ratio, has a step alone.
    """

    step: Decimal
    unit: str
    offset: Decimal = Decimal(0)

    def __str__(self) -> str:
        text = f"{self.step:f} {self.unit}".rstrip()
        if not self.offset:
            return text
        return f"{text} {'-' if self.offset < 0 else '+'} {abs(self.offset):f}"

    @classmethod
    def parse(cls, text: str) -> Scale:
        """Read `0.001 V`."""
        match = _SCALE.fullmatch(text)
        if match is None or not Decimal(match[1]):
            raise ValueError(
                f"`{text}` is no scale: write a step above zero, of 24 decimals at most, and its "
                "unit, if it has one, like `0.001 V`; and what a value of zero is, if it is not "
                "zero: `0.125 °C - 256`"
            )
        return cls(
            Decimal(match[1]), match[2] or "", Decimal(f"{match[3]}{match[4]}" if match[3] else 0)
        )


@dataclass(frozen=True, slots=True)
class Citation:
    """The source of a fact: a declared source and the place in it, `vendor, section 1.1`."""

    source: str
    place: str

    def __str__(self) -> str:
        return f"{self.source}, {self.place}" if self.place else self.source

    @classmethod
    def parse(cls, text: str) -> Citation:
        """Read `vendor, section 1.1`."""
        source, _, place = text.partition(",")
        if not source.strip():
            raise ValueError(
                f"`{text}` is no citation: write a source and a place, like `vendor, section 1.1`"
            )
        return cls(source.strip(), place.strip())


@dataclass(frozen=True, slots=True)
class Method:
    """A message as a method of the client, written `read_positions(servo_ids) -> positions`.

    `result` is the field of the reply that it returns, or empty where it returns the whole reply.
    """

    name: str
    arguments: tuple[str, ...]
    result: str

    @classmethod
    def parse(cls, text: str) -> Method:
        """Read `move_servos(targets, time_ms)` or `read_voltage() -> voltage_mv`."""
        match = _METHOD.fullmatch(text.strip())
        if match is None:
            raise ValueError(
                f"`{text.strip()}` is no method: write name, arguments and what it returns, "
                "like `read_positions(servo_ids) -> positions`"
            )
        return cls(match[1], tuple(_NAME.findall(match[2])), match[3] or "")


@dataclass(frozen=True, slots=True)
class Failure:
    """The field that says whether a request has failed, written `error`, or `status unless 1`.

    `good` is its value where nothing has.
    """

    field: str
    good: int = 0

    def __str__(self) -> str:
        return f"{self.field} unless {self.good}" if self.good else self.field

    @classmethod
    def parse(cls, text: str) -> Failure:
        """Read `error` or `status unless 1`."""
        match = _FAILURE.fullmatch(text.strip())
        if match is None:
            raise ValueError(
                f"`{text.strip()}` says no failure: write a field that is 0 where nothing has "
                "failed, like `error`, or the value that it has then, like `status unless 1`"
            )
        return cls(match[1], 0 if match[2] is None else _number(match[2]))


class NotHex(ValueError):  # noqa: N818 - says what the text is
    """Text that is no hex as a spec has it; `part` is the first word that is wrong."""

    def __init__(self, part: str, hint: str) -> None:
        super().__init__(f"`{part[:40]}` is no hex: {hint}")
        self.part = part


def parse_hex(text: str) -> bytes:
    """Read bytes written `55 55 02 07`, over as many lines as they need. Raises NotHex."""
    if _HEX.fullmatch(text.strip()) is not None:
        return bytes.fromhex(text)
    part = next((word for word in text.split() if _BYTE.fullmatch(word) is None), "")
    if is_hex(text):
        raise NotHex(part, f"write `{to_hex(read_hex(text))}`")
    raise NotHex(part, "write two digits a byte with blanks between, like `55 55 02 07`")


def to_hex(data: bytes) -> str:
    """Write bytes as `55 55 02 07`."""
    return data.hex(" ").upper()


def _number(text: str) -> int:
    """Read a whole number; one in hexadecimal begins with 0x, and zeros in front change nothing."""
    return int(text, 16 if text.startswith("0x") else 10)
