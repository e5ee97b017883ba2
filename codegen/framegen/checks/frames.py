"""Requirements on the parts of any frame, the protocol's own or a look-alike's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem
from framegen.language.number_types import ALL_TYPES
from framegen.language.spec import (
    AddressPart,
    BodyPart,
    ChecksumPart,
    ConstantPart,
    IdPart,
    LengthPart,
)
from framegen.model.checksums import CHECKSUMS, suggest
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.language.number_types import NumberType
    from framegen.language.spec import Frame, FramePart, Message, Spec
    from framegen.language.values import Range
    from framegen.reading.yamltree import KeyPath


# Enough to find a frame by; a document that shows more shows a whole frame.
MOST_CONSTANT = 16
_BODY = "add `parameters: {is: body}` where the fields stand; it is empty in a message without any"


def envelopes(spec: Spec) -> Iterator[tuple[KeyPath, Frame]]:
    """Yield every kind of frame of the protocol, with its path."""
    if spec.frame:
        yield ("frame",), spec.frame
    for name, frame in spec.frames.items():
        yield ("frames", name), frame


def frame_of(spec: Spec, message: Message) -> Frame | None:
    """Return the frame of a message; None where another rule finds that it has none."""
    if message.frame is None and len(spec.frames) > 1:
        return None
    return spec.envelopes.get(spec.frame_of(message)) or None


def parts(spec: Spec) -> Iterator[tuple[KeyPath, FramePart]]:
    """Yield every part of every kind of frame, those of look-alikes behind the protocol's own."""
    for path, frame in envelopes(spec):
        for name, part in frame.items():
            yield (*path, name), part
    for key, other in spec.lookalikes.items():
        for name, part in (other.frame or {}).items():
            yield ("lookalikes", key, "frame", name), part


def is_sent(part: FramePart) -> bool:
    """Tell whether a part has bytes in the frame, or may have some."""
    return not isinstance(part, IdPart) or part.sent


def countable(frame: Frame, own: str) -> list[str]:
    """Return the parts that a length or a checksum would mostly name, but for itself."""
    names = list(frame)
    front = 0
    while front < len(names) and isinstance(frame[names[front]], ConstantPart):
        front += 1
    behind = [name for name in names[front:] if name != own]
    part = frame.get(own)
    if isinstance(part, ChecksumPart):
        return [name for name in behind if not isinstance(frame[name], ChecksumPart | ConstantPart)]
    return [name for name in behind if is_sent(frame[name])]


def part_problems(path: KeyPath, frame: Frame) -> Iterator[Problem]:
    """Find what is wrong with the parts of the frame at `path`."""
    yield from _kinds(path, frame)
    yield from _places(path, frame)
    constant = 0
    for name, part in frame.items():
        here = (*path, name)
        yield from _type(here, part)
        if isinstance(part, ConstantPart):
            constant += len(part.bytes_)
            if constant > MOST_CONSTANT:
                what = f"the frame has {constant} constant bytes up to here"
                yield Problem((*here, "bytes"), f"{what}, and may have {MOST_CONSTANT}")
        if isinstance(part, LengthPart):
            yield from _names((*here, "counts"), name, part.counts, frame)
            yield from _counts_body((*here, "counts"), name, part, frame)
        if isinstance(part, AddressPart):
            yield from _address(here, part)


def checksum_problems(path: KeyPath, frame: Frame) -> Iterator[Problem]:
    """Find what is wrong with the checksums of the frame at `path`."""
    for name, part in frame.items():
        if isinstance(part, ChecksumPart):
            here = (*path, name)
            yield from _method(here, part)
            yield from _names((*here, "covers"), name, part.covers, frame)
            yield from _covers(here, name, part, frame)


def _kinds(path: KeyPath, frame: Frame) -> Iterator[Problem]:
    for kind in ("length", "body", "address", "counter"):
        names = [name for name, part in frame.items() if part.is_ == kind]
        if not names and kind == "body":
            yield Problem(path, "the frame has no body part", _BODY)
        for name in names[1:]:
            yield Problem(
                (*path, name),
                f"the frame has two {kind} parts, `{names[0]}` and `{name}`",
                _SECOND.get(kind, "keep one of them"),
                on_key=True,
                also=((*path, names[0]), "the first is here"),
            )


_SECOND = {
    "length": "keep the one that says where the frame ends; another is the first field of the "
    "messages",
    "address": "if both together name the device, make them one `address` of a wider type, such as "
    "u16; else one of them is an `id`, or `reserved`",
}


def _places(path: KeyPath, frame: Frame) -> Iterator[Problem]:
    body = next((name for name, part in frame.items() if isinstance(part, BodyPart)), None)
    behind = False
    for name, part in frame.items():
        if behind and isinstance(part, LengthPart | IdPart) and is_sent(part):
            yield Problem(
                (*path, name),
                f"the {part.is_} `{name}` stands behind the body",
                "a decoder needs it first: if the document has it there, it is a field of the "
                "messages, or one more `reserved` part",
                on_key=True,
                also=((*path, body or ""), "the body is here"),
            )
        behind = behind or isinstance(part, BodyPart)


def _type(path: KeyPath, part: FramePart) -> Iterator[Problem]:
    type_ = ALL_TYPES.get(getattr(part, "type", ""))
    here = (*path, "type")
    if type_ is None:
        return
    if type_.is_float:
        what = f"a part of the frame is a whole number, and `{type_.name}` is none"
        yield Problem(here, what, f"write u{type_.bits}")
    elif type_.low < 0:
        what = f"a part of the frame is never negative, and `{type_.name}` is signed"
        yield Problem(here, what, f"write u{type_.name[1:]}")
    elif type_.is_packed:
        what = f"a part of the frame has whole bytes, and `{type_.name}` has none"
        wide = f"u{8 * type_.size}"
        where = "name the others by `bits` of a field, or count them to this part"
        yield Problem(here, what, f"write {wide}: {where}")


def _names(path: KeyPath, own: str, names: Sequence[str], frame: Frame) -> Iterator[Problem]:
    if not names:
        line = f"`{path[-1]}: [{', '.join(countable(frame, own))}]`"
        yield Problem(path, f"`{own}` {path[-1]} nothing", f"write {line}, or fewer of these")
    for index, name in enumerate(names):
        here = (*path, index)
        if name not in frame:
            yield Problem(here, f"the frame has no part `{name}`", did_you_mean(name, frame))
        elif name in names[:index]:
            yield Problem(here, f"`{name}` is listed twice", "list it once")
        elif path[-1] == "counts" and not is_sent(frame[name]):
            yield Problem(here, f"`{name}` is not sent, so it has no bytes", "leave it out")


def _counts_body(path: KeyPath, name: str, part: LengthPart, frame: Frame) -> Iterator[Problem]:
    for body, other in frame.items():
        if isinstance(other, BodyPart) and part.counts and body not in part.counts:
            yield Problem(
                path,
                f"`{name}` does not count the body, so the end of a frame is unknown",
                f"add `{body}`",
            )


def _method(path: KeyPath, part: ChecksumPart) -> Iterator[Problem]:
    method = CHECKSUMS.get(part.method)
    if method is None:
        what = f"there is no checksum method `{part.method}`"
        yield Problem((*path, "method"), what, suggest(part.method))
        return
    type_ = ALL_TYPES.get(part.type)
    if type_ is None or type_.low < 0 or type_.is_packed or type_.bits in method.widths:
        return
    widths = " or ".join(f"u{width}" for width in method.widths)
    what = f"`{part.method}` makes a {widths}, and `{path[-1]}` is a {type_.name}"
    yield Problem((*path, "type"), what, f"write `type: {widths.partition(' or ')[0]}`")


def _covers(path: KeyPath, name: str, part: ChecksumPart, frame: Frame) -> Iterator[Problem]:
    for index, covered in enumerate(part.covers):
        here = (*path, "covers", index)
        if covered == name:
            yield Problem(here, f"the checksum `{name}` covers itself", "leave it out")
        elif name in _reached(frame, covered):
            what = f"the checksums `{name}` and `{covered}` cover each other"
            yield Problem(here, what, "leave it out of one: that one is worked out first")


def _reached(frame: Frame, name: str) -> set[str]:
    """Return what a checksum covers, directly or by way of other checksums."""
    found: set[str] = set()
    left = [name]
    while left:
        part = frame.get(left.pop())
        new = set(part.covers) - found if isinstance(part, ChecksumPart) else set()
        found |= new
        left += new
    return found


def _address(path: KeyPath, part: AddressPart) -> Iterator[Problem]:
    type_ = ALL_TYPES.get(part.type)
    if type_ is None or type_.low < 0 or type_.is_packed:
        return
    if part.range is not None:
        yield from _range((*path, "range"), part.range, type_)
    first: dict[int, str] = {}
    for name, named in part.values.items():
        here = (*path, "values", name, "value")
        other = first.setdefault(named.value, name)
        if named.value > type_.high:
            what = f"`{name}` is {named.value}, and a {type_.name} ends at {type_.high}"
            yield Problem(here, what, "correct the value, or take a wider type")
        elif other != name:
            what = f"`{other}` and `{name}` are both {named.value}"
            also = ((*path, "values", other, "value"), f"`{other}` has it first")
            yield Problem(here, what, "keep one of the names", also=also)


def _range(path: KeyPath, range_: Range, type_: NumberType) -> Iterator[Problem]:
    if range_.high is not None and range_.low > range_.high:
        what = f"the range {range_} begins above its end"
        yield Problem(path, what, f"write {range_.high}..{range_.low}")
        return
    for end in dict.fromkeys((range_.low, range_.low if range_.high is None else range_.high)):
        if not type_.low <= end <= type_.high:
            what = f"{end} is no {type_.name}: it holds {type_.low}..{type_.high}"
            hint = f"keep the range inside {type_.low}..{type_.high}, or take a wider type"
            yield Problem(path, what, hint)
