"""Words for slots and their values, and for how a frame begins."""

from __future__ import annotations

from decimal import Context, Decimal

from ..protocol.slots import Body, Constant, List, Number, Packed, Text

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from ..protocol.envelope import Envelope
    from ..protocol.protocol import Protocol
    from ..protocol.slots import Slot
    from ..protocol.words import Scale
    from .slot_bytes import Value

# Digits for any number of 64 bits in steps of any size, none of them rounded.
_EXACT = Context(prec=64)
# Those of a byte.
_BITS = 8


def listed(names: Sequence[str], last: str = "and") -> str:
    """Return names as a list in a sentence: `command, length and parameters`."""
    *others, end = names
    return f"{', '.join(others)} {last} {end}" if others else end


def opening(protocol: Protocol, directions: Iterable[str]) -> str:
    """Return the beginning of a frame of these directions, in words."""
    ways = list(directions)
    found = (
        each
        for each in protocol.envelopes.values()
        if any(protocol.sent(way, each) for way in ways)
    )
    openings = list(dict.fromkeys(map(_opening, found))) or [_opening(protocol.frame)]
    return f"a frame begins {listed(openings, 'or')}"


def _opening(envelope: Envelope) -> str:
    if envelope.header:
        return envelope.header.hex(" ").upper()
    first = envelope.slots[0]
    if isinstance(first, Number) and first.role == "address":
        return f"with its {first.name}, {first.low}..{first.high}"
    return f"with its {first.name}"


def order_in_words(slot: Slot) -> str:
    """Return which byte of a number comes first: `low byte first`; "" for one byte, and for others.

    Of packed numbers, it says in which bits the first one is, too.
    """
    match slot:
        case Packed():
            whole = f"{_first(slot)} byte and " if slot.size > 1 else ""
            return f"{whole}{_first(slot)} bits first"
        case Number() | Constant():
            kind = slot.type if isinstance(slot, Number) else slot.of_type or "u8"
            return f"{_first(slot)} byte first" if int(kind[1:]) > _BITS else ""
        case _:
            return ""


def _first(slot: Packed | Number | Constant) -> str:
    return "low" if slot.order == "little" else "high"


def kind_in_words(slot: Slot) -> str:
    """Return what a slot holds: a type, `text`, several of a type, or the method of a checksum."""
    match slot:
        case Packed():
            return f"{slot.count} of {slot.packed}"
        case Constant():
            return slot.of_type
        case Number():
            return slot.method or slot.type
        case Text() | List() | Body():
            return "text"


def scaled(scale: Scale, value: float) -> Decimal:
    """Return a number in its larger unit, with no digit rounded."""
    found = _EXACT.multiply(Decimal(str(value)), Decimal(scale.step))
    return _EXACT.add(found, Decimal(scale.offset)) if scale.offset else found


def in_words(slot: Number | Text | Packed, value: Value) -> tuple[str, str]:
    """Return a value with its unit, in its larger unit and by its name; and its meaning."""
    if isinstance(value, list | str) or not isinstance(slot, Number):
        text = " ".join(map(str, value)) if isinstance(value, list) else repr(value)
        return text, slot.about
    text = f"{value} {slot.unit}".rstrip()
    if slot.scale is not None:
        text += f" = {scaled(slot.scale, value):f} {slot.scale.unit}".rstrip()
    set_bits = ", ".join(_bits_in_words(slot, value))
    text += f" ({set_bits})" if set_bits else ""
    for name, named in slot.values.items():
        if named.value == value:
            return f"{text} ({name})", named.about or slot.about
    return text, slot.about


def _bits_in_words(slot: Number, value: float) -> Iterator[str]:
    """Yield the named bits of a number that are set, those of several bits with their value."""
    for name, (low, high, _) in slot.bits.items():
        found = int(value) >> low & (1 << high - low + 1) - 1
        if found:
            yield name if low == high else f"{name} {found}"
