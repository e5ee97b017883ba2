"""Noise and unknown frames: what a stream holds besides messages."""

from __future__ import annotations

from .._frame.bytes_like import format_hex
from .._frame.errors import Reason
from .._frame.protocol import BODY_AT, read_command


class Noise:
    """Bytes that are part of no message, and why the first of them is not the start of one."""

    __slots__ = ("_data", "_reason")
    __match_args__ = ("data", "reason")

    def __init__(self, data: bytes, reason: Reason) -> None:
        self._data = data
        self._reason = reason

    @property
    def data(self) -> bytes:
        """The bytes, as they came."""
        return self._data

    @property
    def reason(self) -> Reason:
        """Why they are no frame."""
        return self._reason

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Noise):
            return NotImplemented
        return (type(self), self._data, self._reason) == (type(other), other._data, other._reason)

    def __hash__(self) -> int:
        return hash((type(self), self._data, self._reason))

    def __reduce__(self) -> tuple[object, ...]:
        return type(self), (self._data, self._reason)

    def __repr__(self) -> str:
        return f"{type(self).__name__}(bytes.fromhex({format_hex(self._data)!r}), {self._reason})"

    def _repr_html_(self) -> str:
        from .._frame.html_strip import noise_strip

        return noise_strip(f"Noise: {self._reason.value}", self._data, is_frame=False)


class UnknownFrame(Noise):
    """Noise of the exact shape of a frame, with a command that is not known in its direction.

    Newer firmware may have sent it. It is shown, but never trusted to reach as far as it says.
    """

    __slots__ = ()

    @property
    def command(self) -> int:
        """The command it would have."""
        return read_command(self._data)

    @property
    def parameters(self) -> bytes:
        """The bytes that would be its parameters."""
        return self._data[BODY_AT:]

    def _repr_html_(self) -> str:
        from .._frame.html_strip import noise_strip

        return noise_strip(f"Unknown frame: command {self.command}", self._data, is_frame=True)
