"""Malformed frames, each followed at once by a query that a device must still receive.

They are made of queries alone, and each is one that the reference refuses: it must find the query
behind the bytes that it gives up, without waiting until the line is quiet.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.cases.malformed import MALFORMED
from framegen.conformance.device.queries import requests
from framegen.conformance.device.step import Malformed, Step
from framegen.model.slots import Constant, Number
from framegen.model.stream import ReferenceDecoder
from framegen.model.verdict import weigh

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Iterator

    from framegen.conformance.device.permission import Permission
    from framegen.conformance.device.step import Request
    from framegen.model.slots import Placed

    Maker = Callable[[Permission, Request], Iterable[bytes]]


def malformed_steps(permission: Permission, after: Request) -> Iterator[Step]:
    """Yield a step for each way to be malformed; none where no query can be malformed so."""
    for about, reason in MALFORMED.items():
        found = _first(permission, after, about, reason, _MAKERS[about])
        if found is not None and after.message.frame.header:
            yield Step(f"{about}, and {after.message.name} at once", ((found, after),))
        elif found is not None:
            # Where silence divides frames, what follows at once belongs to it.
            yield Step(f"{about}, then {after.message.name}", ((found,), (after,)))


def _first(
    permission: Permission, after: Request, about: str, reason: str, make: Maker
) -> Malformed | None:
    """Return the first malformed frame of its kind that is harmless whatever bytes are lost."""
    for request in requests(permission):
        for data in make(permission, request):
            if _is_fit(permission, data, reason, after):
                return Malformed(data, reason, about)
    return None


def _is_fit(permission: Permission, data: bytes, reason: str, after: Request) -> bool:
    model = permission.model
    sent = [model.roles.sent]
    if weigh(model, sent, data).reason != reason:
        return False
    around = after.frame + data + after.frame
    if permission.objection(around + after.frame):
        return False
    decoder, quiet = ReferenceDecoder(model, sent), [*[None] * (not after.message.frame.header)]
    # One that may be the beginning of a longer frame is ended by silence.
    end = [*[None] * (not decoder.decode_so_far(after.frame))]
    parts = [after.frame, *quiet, data, *quiet, after.frame, *end]
    events = (event for event in decoder.follow(parts) if event is not None)
    return [event.data for event in events if event.message] == [after.frame, after.frame]


def _cut_in_fields(_permission: Permission, request: Request) -> Iterator[bytes]:
    for size in range(len(request.frame) - 1, request.message.frame.body_at - 1, -1):
        yield request.frame[:size]


def _cut_before(_permission: Permission, request: Request) -> Iterator[bytes]:
    frame = request.message.frame
    for size in range(frame.body_at - 1, len(frame.header), -1):
        yield request.frame[:size]


def _changed(role: str, by: int) -> Maker:
    """Add to the number with this role, where the sum still fits.

    With the checksum that this makes, nothing else is wrong.
    """

    def make(_permission: Permission, request: Request) -> Iterator[bytes]:
        for placed, slot in _numbers(request):
            if slot.role == role:
                yield from _with(request, placed, slot, slot.read(placed.of(request.frame)) + by)

    return make


def _outside(_permission: Permission, request: Request) -> Iterator[bytes]:
    for placed, slot in _numbers(request):
        if slot.is_field and slot.narrowed:
            yield from _with(request, placed, slot, slot.high + 1)
            yield from _with(request, placed, slot, slot.low - 1)


def _unknown(permission: Permission, request: Request) -> Iterator[bytes]:
    for placed, slot in _numbers(request):
        unknown = permission.unknown_id(request.message)
        if slot is request.message.frame.id_part and unknown is not None:
            yield from _with(request, placed, slot, unknown)


def _checksum(_permission: Permission, request: Request) -> Iterator[bytes]:
    for placed, slot in _numbers(request):
        if slot.role == "checksum":
            for bit in range(8):
                wrong = slot.read(placed.of(request.frame)) ^ 1 << bit
                yield request.frame[: placed.at] + slot.write(wrong) + request.frame[placed.end :]


def _trailer(_permission: Permission, request: Request) -> Iterator[bytes]:
    for placed in request.message.lay_out(request.message.count_of(request.frame)):
        if isinstance(placed.slot, Constant) and placed.slot in request.message.frame.tail:
            for bit in range(8):
                wrong = bytes([request.frame[placed.at] ^ 1 << bit])
                yield request.frame[: placed.at] + wrong + request.frame[placed.at + 1 :]


def _numbers(request: Request) -> Iterator[tuple[Placed, Number]]:
    for placed in request.message.lay_out(request.message.count_of(request.frame)):
        if isinstance(placed.slot, Number):
            yield placed, placed.slot


def _with(request: Request, placed: Placed, slot: Number, value: int) -> Iterator[bytes]:
    """Replace the value at one place of a frame, where there is room for it."""
    if slot.number_type.low <= value <= slot.number_type.high:
        data = request.frame[: placed.at] + slot.write(value) + request.frame[placed.end :]
        # As an unknown message it would be one that a device may refuse.
        yield data if slot.role == "id" else request.message.sealed(data)


_MAKERS: dict[str, Maker] = {
    "a query cut short in its fields": _cut_in_fields,
    "a query cut short before its fields": _cut_before,
    "a length that is one too many": _changed("length", 1),
    "a length that is one too few": _changed("length", -1),
    "a count that is one too many": _changed("count", 1),
    "a count that is one too few": _changed("count", -1),
    "a value out of its range": _outside,
    "an id that nobody has": _unknown,
    "a checksum that is wrong": _checksum,
    "an end that is another": _trailer,
}
