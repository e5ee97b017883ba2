"""Requirements on the parts of any frame, the protocol's own or a look-alike's."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.rule import Problem
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.spec import BodyPart, ChecksumPart, ConstantPart, LengthPart
from framegen.reading.findings import did_you_mean

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Frame, FramePart, Spec
    from framegen.reading.yamltree import KeyPath


# Enough to find a frame by; a document that shows more shows a whole frame.
MOST_CONSTANT = 16
_WITHOUT = {
    "length": "say which part it is, by `is: length`; frames without one cannot be described yet",
    "id": "say which part tells messages apart, by `is: id`; "
    "frames without one cannot be described yet",
    "body": "end the frame with a part that `is: body`; it is empty where a message has no fields",
}


def envelopes(spec: Spec) -> Iterator[tuple[KeyPath, Frame]]:
    """Yield every kind of frame of the protocol, with its path."""
    if not spec.frames:
        yield ("frame",), spec.frame
    for name, frame in spec.frames.items():
        yield ("frames", name), frame


def parts(spec: Spec) -> Iterator[tuple[KeyPath, FramePart]]:
    """Yield every part of every kind of frame, those of look-alikes behind the protocol's own."""
    for path, frame in envelopes(spec):
        for name, part in frame.items():
            yield (*path, name), part
    for key, other in spec.lookalikes.items():
        for name, part in (other.frame or {}).items():
            yield ("lookalikes", key, "frame", name), part


def part_problems(path: KeyPath, frame: dict[str, FramePart]) -> Iterator[Problem]:
    """Find what is wrong with the parts of the frame at `path`."""
    for kind in ("length", "body", "address", "counter"):
        names = [name for name, part in frame.items() if part.is_ == kind]
        if not names and kind == "body":
            yield Problem(path, f"the frame has no {kind} part", _WITHOUT[kind])
        for name in names[1:]:
            yield Problem(
                (*path, name),
                f"the frame has two {kind} parts, `{names[0]}` and `{name}`",
                "keep one of them",
                on_key=True,
                also=((*path, names[0]), "the first is here"),
            )
    constant = 0
    for name, part in frame.items():
        yield from _type(path, name, part)
        if isinstance(part, ConstantPart):
            constant += len(part.bytes_)
            if constant > MOST_CONSTANT:
                what = f"the frame has {constant} constant bytes up to here"
                yield Problem((*path, name, "bytes"), f"{what}, and may have {MOST_CONSTANT}")
        if isinstance(part, LengthPart):
            yield from _names((*path, name, "counts"), part.counts, frame)
            yield from _counts_body((*path, name, "counts"), name, part, frame)
        if isinstance(part, ChecksumPart):
            yield from _names((*path, name, "covers"), part.covers, frame)
            if name in part.covers:
                yield Problem(
                    (*path, name, "covers", part.covers.index(name)),
                    f"the checksum `{name}` covers itself",
                    "leave it out",
                )


def _type(path: KeyPath, name: str, part: FramePart) -> Iterator[Problem]:
    type_ = NUMBER_TYPES.get(getattr(part, "type", ""))
    if type_ is not None and type_.low < 0:
        yield Problem(
            (*path, name, "type"),
            f"a part of the frame is never negative, and `{type_.name}` is signed",
            f"write u{type_.name[1:]}",
        )


def _names(path: KeyPath, names: list[str], frame: dict[str, FramePart]) -> Iterator[Problem]:
    for index, name in enumerate(names):
        if name not in frame:
            yield Problem(
                (*path, index),
                f"the frame has no part `{name}`",
                did_you_mean(name, frame),
            )
        elif name in names[:index]:
            yield Problem((*path, index), f"`{name}` is listed twice", "list it once")


def _counts_body(
    path: KeyPath, name: str, part: LengthPart, frame: dict[str, FramePart]
) -> Iterator[Problem]:
    for body, other in frame.items():
        if isinstance(other, BodyPart) and body not in part.counts:
            yield Problem(
                path,
                f"`{name}` does not count the body, so the end of a frame is unknown",
                f"add `{body}`",
            )
