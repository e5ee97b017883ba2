"""Lines on which frames are hard to tell: cut, nested, overlapping, and of unknown command."""

from collections.abc import Callable
from importlib import import_module
from types import ModuleType
from typing import Any

from framewire.explain import checksum
from hypothesis import strategies as st


def sealing(made: ModuleType) -> Callable[[bytes], bytes]:
    """Return what gives a frame of a library the checksums that it should have."""
    codec: Any = import_module(f"{made.__name__}._library").CODEC
    envelopes = [each for each in codec.protocol().envelopes.values() if each.header]

    def sealed(frame: bytes) -> bytes:
        for envelope in envelopes:
            if frame.startswith(envelope.header) and len(frame) >= envelope.least:
                return checksum.sealed(envelope, frame)
        return frame

    return sealed


def heads_at(made: ModuleType) -> list[int]:
    """Return where the ids, addresses and lengths of frames stand."""
    codec: Any = import_module(f"{made.__name__}._library").CODEC
    slots = [slot for each in codec.protocol().envelopes.values() for slot in each.slots]
    return sorted({slot.at for slot in slots if slot.role in ("id", "address", "length")})


def hostile_lines(
    made: ModuleType, frames: st.SearchStrategy[bytes], *, most: int = 8
) -> st.SearchStrategy[bytes]:
    """Return a strategy for lines of a library's frames and of what is nearly one."""
    piece = st.one_of(frames, _spoilt(made, frames), st.binary(max_size=4))
    return st.lists(piece, max_size=most).map(b"".join)


@st.composite
def _spoilt(draw: st.DrawFn, made: ModuleType, frames: st.SearchStrategy[bytes]) -> bytes:
    frame, other = draw(frames), draw(frames)
    at, shared = draw(st.integers(1, len(frame))), draw(st.integers(1, min(len(frame), len(other))))
    seal = draw(st.sampled_from([sealing(made), bytes]))
    unknown = _of_other_head(draw, made, frame)
    spoilt = [
        frame[:at],
        # The same beginning, over and over: each claims what the next ones are made of.
        frame[:at] * draw(st.integers(2, 6)) + frame,
        frame[:at] + other + frame[at:],
        # A frame in the place of some of its bytes, as a field may hold it.
        seal((frame[:at] + other + frame[at + len(other) :])[: len(frame)]),
        # The last bytes of one are, or replace, the first ones of the other.
        seal(frame[:-shared] + other[:shared]) + other[shared:],
        frame[:-shared] + other,
        seal(unknown),
        seal(unknown[:at] + other),
        _of_other_head(draw, made, seal((unknown[:at] + other)[: len(frame)])),
    ]
    return draw(st.sampled_from(spoilt))


def _of_other_head(draw: st.DrawFn, made: ModuleType, frame: bytes) -> bytes:
    """Return a frame with another byte in its head, which may be of no message."""
    at = draw(st.sampled_from(heads_at(made) or [0]))
    other = draw(st.sampled_from([b"\xff", b"\xfe", b"\0"]) | st.binary(min_size=1, max_size=1))
    return frame[:at] + other + frame[at + 1 :]
