"""What all errors of libraries are, and those about frames and values: these are ValueErrors."""

from __future__ import annotations

from enum import Enum


class Reason(Enum):
    """Why bytes are no frame. The value is the reason in words."""

    TOO_SHORT = "too short"
    TRAILING_BYTES = "trailing bytes"
    BAD_HEADER = "bad header"
    LENGTH_MISMATCH = "length mismatch"
    COUNT_MISMATCH = "count mismatch"
    UNKNOWN_COMMAND = "unknown command"
    OUT_OF_RANGE = "out of range"
    BAD_CHECKSUM = "bad checksum"
    BAD_TRAILER = "bad trailer"


# Where errors are imported from: this package, or the library that carries it.
_PACKAGE = __name__.removesuffix(".frame.errors").removesuffix("._runtime")


class ProtocolError(Exception):
    """The base of all errors of this library."""

    __module__ = _PACKAGE

    def __init_subclass__(cls) -> None:
        # A traceback names it as it is imported: by the package, not by a module inside.
        if cls.__module__.startswith(f"{_PACKAGE}."):
            cls.__module__ = _PACKAGE


class EncodeError(ProtocolError, ValueError):
    """A value that no frame can carry.

    `path` says where it was given (`items[1].level`) and `value` what was given there.
    """

    def __init__(self, path: str, value: object, problem: str) -> None:
        super().__init__(path, value, problem)
        self.path = path
        self.value = value
        self.problem = problem

    def __str__(self) -> str:
        return f"{self.path}: {self.problem}"


class LimitError(EncodeError):
    """A value that a frame could carry, but that this end does not send: it is outside `limits`.

    `owner` says whose limits these are (`joint 1`) where each has its own, and is empty otherwise.
    """

    def __init__(
        self, path: str, value: object, limits: tuple[int, int], way_out: str, owner: str = ""
    ) -> None:
        low, high = limits
        whose = f" of {owner}" if owner else ""
        problem = f"{value} is outside the limits {low}..{high}{whose}; {way_out}"
        super().__init__(path, value, problem)
        self.limits = limits
        self.way_out = way_out
        self.owner = owner

    def __reduce__(
        self,
    ) -> tuple[type[LimitError], tuple[str, object, tuple[int, int], str, str]]:
        return type(self), (self.path, self.value, self.limits, self.way_out, self.owner)


class DecodeError(ProtocolError, ValueError):
    """Bytes that are not the expected frame.

    `reason` is the kind of error, and `offset` the first byte at which it shows, counted from 0.
    """

    def __init__(self, reason: Reason, offset: int, problem: str) -> None:
        super().__init__(reason, offset, problem)
        self.reason = reason
        self.offset = offset
        self.problem = problem

    def __str__(self) -> str:
        return f"{self.reason.value} at byte {self.offset}: {self.problem}"
