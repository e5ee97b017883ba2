"""Check: what comes is recognised as this protocol, and as none that is easily taken for it."""

from __future__ import annotations

from ...codec.noise import UnknownFrame
from ...frame.errors import Reason
from ...frame.pluralize import pluralize
from ..plain_text import plain_text
from .check import Check
from .likely_cause import OTHER_DEVICE, likely_cause
from .result import failed, passed, unknown

TYPE_CHECKING = False
if TYPE_CHECKING:
    from ...codec.noise import Noise
    from ...codec.protocol_codec import ProtocolCodec
    from ...frame.message import Message
    from .diagnosis import Diagnosis
    from .result import Result


def _look(diagnosis: Diagnosis) -> Result:
    codec = diagnosis.library.codec
    heard = [*(trip.heard for trip in diagnosis.trips), diagnosis.unsolicited]
    runs = [run for each in heard for run in each.runs]
    strange = [(rate, run) for rate, each in diagnosis.strange for run in each.runs]
    messages = [message for each in heard for message in each.messages]
    if not (runs or strange or messages):
        return unknown("nothing came that could be looked at")
    is_answered = any(trip.replies for trip in diagnosis.trips)
    for run in [*runs, *(run for _, run in strange)]:
        other = _of_another(run, codec, is_answered=is_answered)
        if other is not None:
            return other
    frames = sum(len(message.encode()) for message in messages)
    noise = [_joined(run) for run in runs]
    # A reply proves it; a frame that nobody asked for may have come about by chance.
    if is_answered or frames > sum(map(len, noise)):
        return _recognised(messages, noise)
    return _not_recognised(noise, [(rate, _joined(run)) for rate, run in strange], codec)


def _joined(run: list[Noise]) -> bytes:
    return b"".join(each.data for each in run)


def _of_another(run: list[Noise], codec: ProtocolCodec, *, is_answered: bool) -> Result | None:
    """Return the result for noise that is of another protocol, or another edition of this one.

    Where a frame of this protocol may have been cut, only a checksum proves another protocol.
    """
    data = _joined(run)
    title = codec.recognise(data, by_checksum=is_answered or _is_cut(data, codec))
    if title is not None:
        return failed(
            f"frames of another protocol came: {title}",
            "the page on look-alikes in the reference tells them apart: another device or plug",
            data,
        )
    likeness = [_likeness(each, codec) for each in run]
    if not all(likeness):
        return None
    advice = "an unknown edition of the device, or bytes that were lost: send a report in"
    return failed(likeness[0], advice, *(each.data for each in run))


def _likeness(noise: Noise, codec: ProtocolCodec) -> str:
    """Return what a piece of noise has in common with a frame; empty for nothing."""
    if isinstance(noise, UnknownFrame):
        return f"a frame of command {noise.command} came, which is none of this protocol's"
    data, heads = noise.data, codec.heads
    if noise.reason is not Reason.LENGTH_MISMATCH:
        return ""
    size = heads.claimed(data)
    if len(data) < (size or heads.longest):
        return ""
    kinds = _kinds(data, codec)
    if not kinds:
        return ""
    return f"a frame of {kinds[0].__name__} came with {size} bytes, which none has"


def _is_cut(data: bytes, codec: ProtocolCodec) -> bool:
    """Tell whether it begins as a message may, and ends before that would."""
    heads = codec.heads
    if heads.claimed(data) <= len(data):
        return False
    return len(data) < heads.longest or bool(_kinds(data, codec))


def _kinds(data: bytes, codec: ProtocolCodec) -> list[type[Message]]:
    received = [kind for kind in codec.messages if kind.DIRECTION is codec.received]
    return [kind for kind in received if kind.FRAME.has_ids(data, kind.IDS)]


def _recognised(messages: list[Message], noise: list[bytes]) -> Result:
    """Return the result for what is this protocol, and say what of it is not."""
    names = dict.fromkeys(type(message).__name__ for message in messages)
    count = pluralize(len(messages), "whole frame")
    seen = f"what came is this protocol: {count} ({', '.join(names)})"
    if noise:
        seen += f"; not recognised: {pluralize(sum(map(len, noise)), 'other byte')}"
    text = next(filter(None, map(plain_text, noise)), "")
    return passed(f"{seen}, among them text: {text}" if text else seen, *noise)


def _not_recognised(
    noise: list[bytes], strange: list[tuple[float, bytes]], codec: ProtocolCodec
) -> Result:
    """Return the result for what may be anything, with its likely cause."""
    text = next(filter(None, map(plain_text, noise)), "")
    if not text:
        for rate, data in strange:
            text = plain_text(data)
            if text:
                seen = f"not recognised: at {rate:g} baud, text came: {text}"
                return unknown(seen, OTHER_DEVICE, data)
    shown = noise or [data for _, data in strange]
    # The longest shows most.
    longest = max(shown, key=lambda data: (bool(plain_text(data)), len(data)))
    cause = likely_cause(longest, codec.heads)
    came = f"{pluralize(sum(map(len, shown)), 'byte')} came, and no whole frame"
    return unknown(f"not recognised: {came}: {cause.seen}", cause.advice, *shown)


CHECK = Check("look-alike", "what comes is this protocol", ("opening",), _look)
