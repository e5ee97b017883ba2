"""Noise and unknown frames: what a stream holds besides messages."""

from __future__ import annotations

from ..frame.bytes_like import format_hex
from ..frame.errors import Reason
from ..frame.heads import Heads

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    import typing_extensions as typing

    from ..frame.envelope import Envelope
else:
    from ..frame.typing_later import typing


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
        from ..frame.html_strip import noise_strip

        return noise_strip(f"Noise: {self._reason.value}", self._data)


class UnknownFrame(Noise):
    """Noise of the exact shape of a frame, with a command that is not known in its direction.

    Each protocol has its own: a subclass, which knows where its frames begin.
    """

    __slots__ = ()

    _heads: typing.ClassVar[Heads]

    @property
    def numbers(self) -> dict[str, int]:
        """What says who it is from and which message it is, by name."""
        envelope = self._envelope
        parts = [envelope.address, *envelope.ids]
        return {part.name: part.read(self._data) for part in parts if part is not None}

    @property
    def ids(self) -> tuple[int, ...]:
        """The numbers that say which message it is."""
        return tuple(part.read(self._data) for part in self._envelope.ids)

    @property
    def command(self) -> int:
        """The last of these numbers."""
        return self.ids[-1]

    @property
    def parameters(self) -> bytes:
        """The bytes that would be its fields."""
        envelope = self._envelope
        return self._data[envelope.body_at : len(self._data) - envelope.tail_size]

    @property
    def _envelope(self) -> Envelope:
        """The envelope that it has."""
        return self._heads.fitting(self._data)

    def _repr_html_(self) -> str:
        from ..frame.html_strip import noise_strip

        envelope = self._envelope
        parts = zip(envelope.ids, self.ids, strict=True)
        said = ", ".join(f"{part.name} {number}" for part, number in parts)
        return noise_strip(f"Unknown frame: {said}", self._data, envelope)
