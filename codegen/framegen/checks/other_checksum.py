"""What a checksum would have to be for the examples of a spec: a hint where it is not."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.model.checksums import CHECKSUMS, UNUSUAL
from framegen.model.slots import Body

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import ByteOrder, Number

# How many bits of checksums have to agree, so that a method is not found by chance: for other
# methods alone, and for those of other parts.
_BITS = 16
_MORE_BITS = 24
# More than that help nobody.
_MOST = 3


@dataclass(frozen=True)
class _Sealed:
    """An example, with the parts of its frame by name, and its checksum as a number."""

    parts: dict[str, bytes]
    found: bytes


def checksum_hint(model: Model, message: MessageLayout, frame: bytes) -> str:
    """Return what mends a frame whose checksum is not that of the spec, or the spec."""
    for checksum in message.frame.checksums:
        at = checksum.at if checksum.at >= 0 else len(frame) + checksum.at
        found, right = frame[at : at + checksum.size], message.checksum(checksum, frame)
        if found != right:
            return _hint(model, message.frame, checksum, right)
    return ""


def _hint(model: Model, frame: Envelope, checksum: Number, right: bytes) -> str:
    # Who made up a frame had no checksum to go by: those of others are the evidence.
    published, made_up = (
        list(_sealed(model, frame, checksum, published=is_so)) for is_so in (True, False)
    )
    sealed = published or made_up
    kind = "published example" if published and made_up else "example"
    agree = f"all {len(sealed)} {kind}s" if len(sealed) > 1 else f"the one {kind}"
    if _agree(checksum.method, checksum.order, checksum.of, sealed):
        own = "agree" if len(sealed) > 1 else "agrees"
        return f"{agree} {own} with the spec: write {to_hex(right)} there"
    others = _others(frame, checksum, sealed)
    if others and len(others) <= _MOST:
        return f"{agree} would agree with {' or with '.join(others)}"
    return (
        f"if the frame was made up, write {to_hex(right)} there; if it was published, the method, "
        f"what it covers or its byte order is another"
    )


def _sealed(
    model: Model, frame: Envelope, checksum: Number, *, published: bool
) -> Iterator[_Sealed]:
    for message in model.messages.values():
        if message.frame is not frame:
            continue
        ids = dict(zip((part.name for part in frame.ids), message.ids, strict=True))
        for example in message.message.examples:
            data = example.hex
            if len(data) < frame.least or published == bool(example.constructed):
                continue
            parts = {part.name: part.write(ids[part.name]) for part in frame.unsent}
            for slot in frame.slots:
                at = slot.at if slot.at >= 0 else len(data) + slot.at
                size = len(data) - frame.least if isinstance(slot, Body) else slot.size
                parts[slot.name] = data[at : at + size]
            yield _Sealed(parts, parts[checksum.name])


def _others(frame: Envelope, checksum: Number, sealed: Sequence[_Sealed]) -> list[str]:
    """Return what else would make the checksums of all examples, as keys to write."""
    bits = 8 * checksum.size * len(sealed)
    if bits < _BITS:
        return []
    agreeing = [each for each in _methods(checksum) if _agree(*each, checksum.of, sealed)]
    # A sum with carries is a plain one as long as there are none.
    usual = [each for each in agreeing if each[0] not in UNUSUAL] or agreeing
    found = [_keys(checksum, *each, checksum.of) for each in usual]
    if found or bits < _MORE_BITS:
        return found
    names = [slot.name for slot in frame.slots if slot.name != checksum.name]
    # What is not sent mostly ends what is covered.
    hidden = [(), tuple(part.name for part in frame.unsent)][: 1 + bool(frame.unsent)]
    runs = [
        (*names[start:end], *more)
        for start in range(len(names))
        for end in range(start + 1, len(names) + 1)
        for more in hidden
    ]
    same = (run for run in runs if _agree(checksum.method, checksum.order, run, sealed))
    kept = [_keys(checksum, checksum.method, checksum.order, run) for run in same]
    return kept or [
        _keys(checksum, method, order, run)
        for run in runs
        for method, order in _methods(checksum)
        if _agree(method, order, run, sealed)
    ]


def _methods(checksum: Number) -> Iterator[tuple[str, ByteOrder]]:
    other: ByteOrder = "big" if checksum.order == "little" else "little"
    orders: tuple[ByteOrder, ...] = (checksum.order, other) if checksum.size > 1 else ("big",)
    for name, row in CHECKSUMS.items():
        if 8 * checksum.size in row.widths:
            for order in orders:
                yield name, order


def _agree(method: str, order: ByteOrder, names: Sequence[str], sealed: Sequence[_Sealed]) -> bool:
    row = CHECKSUMS[method]
    return all(
        int.from_bytes(each.found, order)
        == row.of(b"".join(each.parts[name] for name in names), 8 * len(each.found))
        for each in sealed
    )


def _keys(checksum: Number, method: str, order: ByteOrder, names: Sequence[str]) -> str:
    keys = []
    if method != checksum.method:
        keys.append(f"method: {method}")
    if checksum.size > 1 and order != checksum.order:
        keys.append(f"byte_order: {order}")
    if tuple(names) != checksum.of:
        keys.append(f"covers: [{', '.join(names)}]")
    return f"`{', '.join(keys)}`"
