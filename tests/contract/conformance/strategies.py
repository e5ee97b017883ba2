"""Lines of any protocol for Hypothesis: frames, damaged and unknown ones, and noise like them."""

from functools import cache

from framegen.cases.sender import LONGEST, Sender
from framegen.cases.streams import senders_of
from framegen.language.values import Direction
from framegen.model.model import Model
from hypothesis import strategies as st


@cache
def lines_of(model: Model, way: Direction) -> st.SearchStrategy[bytes]:
    """Return a strategy for the bytes that one direction may carry."""
    pieces = st.one_of(*(_pieces(sender) for sender in senders_of(model, way)))
    return st.lists(pieces, max_size=5).map(b"".join)


def _pieces(sender: Sender) -> st.SearchStrategy[bytes]:
    """Return a strategy for frames of one kind, and bytes like them."""
    header, frame = sender.header, sender.frame
    large = [frame for frame in sender.frames_around(LONGEST) if frame is not None]
    # A header of equal bytes begins with its first byte in two places.
    false_starts = [header[:1] + frame for frame in large]
    whole = [*sender.small_frames.values(), *large, *false_starts] or [b""]
    frames = st.sampled_from(whole)
    ids = [id_ for message in sender.messages for id_ in message.ids]
    near = [*header, *header, *ids, *range(8), 99, 255]
    alike = st.lists(st.sampled_from([each & 0xFF for each in near]), max_size=12).map(bytes)
    heads = alike.map(lambda rest: header + rest)

    def unknown(inner: st.SearchStrategy[bytes]) -> st.SearchStrategy[bytes]:
        wrapped = inner.map(sender.unknown)
        return st.builds(lambda frame, more: (frame or header) + more, wrapped, inner)

    def right(data: bytes) -> bytes:
        """Give damaged bytes the checksums of a frame, where they are enough for one."""
        return data if len(data) < frame.least else frame.sealed(data, sender.known_ids)

    nested = st.recursive(alike | frames | st.binary(max_size=3), unknown, max_leaves=6)
    damaged = frames.flatmap(_damaged)
    return st.one_of(frames, damaged, damaged.map(right), heads, alike, nested)


@st.composite
def _damaged(draw: st.DrawFn, frame: bytes) -> bytes:
    """Return a frame with bytes lost, changed or repeated."""
    start = draw(st.integers(0, max(len(frame) - 1, 0)))
    end = draw(st.integers(start, min(start + 3, len(frame))))
    return frame[:start] + draw(st.binary(max_size=2)) + frame[end:]


@st.composite
def parts_of(draw: st.DrawFn, lines: st.SearchStrategy[bytes]) -> list[bytes | None]:
    """Return a line in pieces, with silences here and there."""
    line = draw(lines)
    if draw(st.booleans()):
        return [line[at : at + 1] for at in range(len(line))]
    cuts = sorted(draw(st.sets(st.integers(0, len(line)), max_size=6)))
    parts: list[bytes | None] = []
    for start, end in zip([0, *cuts], [*cuts, len(line)], strict=True):
        parts.append(line[start:end])
        parts += [None] if draw(st.integers(0, 3)) == 0 else []
    return parts
