"""What else can stand at a place of a spec, by its key: a fact that frames show, or anything.

`other_facts` are of the kind of what stands there, so that a spec with one says something else of
its frames; `anything` is whatever an author might leave there, right or wrong.
"""

from collections.abc import Callable, Iterator
from typing import Any

from framegen.language import spec as language
from framegen.language.number_types import NUMBER_TYPES
from framegen.model.checksums import CHECKSUMS

from tests.factories import Steps
from tests.mutations.odd_text import TEXTS
from tests.mutations.places import GONE, other_way


def keys_of_the_language() -> set[str]:
    """Return every key that some part of a spec may have."""
    return {
        info.alias or key
        for part in vars(language).values()
        if isinstance(part, type) and issubclass(part, language.Part)
        for key, info in part.model_fields.items()
    }


# ------------------------------------------------------------------ other facts


def other_facts(path: Steps, value: Any) -> list[Any]:
    """Return what else a fact could be: other frames belong to a spec that says so."""
    # An id of several is a mapping, whose parts may be called like anything.
    key = "id" if path[-2:-1] == ("id",) else str(path[-1])
    found = OTHER_FACTS[key](value) if key in OTHER_FACTS and not isinstance(value, dict) else []
    return [each for at, each in enumerate(found) if each not in (value, *found[:at])]


def _fewer(names: list[str]) -> list[list[str]]:
    return [names[:at] + names[at + 1 :] for at in range(len(names))]


def _lengths(rule: Any) -> list[Any]:
    if isinstance(rule, list):
        return [rule[:1], rule[1:], [each + 1 for each in rule]]
    return [rule + 1] if isinstance(rule, int) else [f"{rule} + 1", f"2 * {rule}"]


def _ranges(said: str) -> list[str]:
    low, high = map(int, said.split(".."))
    return [f"{low + 1}..{high}", f"{low}..{low}", "2..3"]


def _flipped(said: str) -> list[str]:
    data = bytes.fromhex(said)
    flipped = (bytes([data[0] ^ 1, *data[1:]]), bytes(byte ^ 1 for byte in data))
    return [*(each.hex(" ").upper() for each in flipped), f"{said} 00"]


def _methods(name: str) -> list[str]:
    widths = CHECKSUMS[name].widths
    usual = ("crc-16/umts", "inverted sum", "crc-8/smbus")
    alike = (other for other, each in CHECKSUMS.items() if each.widths == widths)
    return [*dict.fromkeys([*usual, *alike])]


def _next(value: Any) -> list[Any]:
    return [value + 1] if isinstance(value, int) else []


OTHER_FACTS: dict[str, Callable[[Any], list[Any]]] = {
    "type": lambda _: [*NUMBER_TYPES],
    "covers": lambda names: [*_fewer(names), names[:1], names[::-1]],
    "counts": lambda names: [*_fewer(names), names[::-1]],
    "method": _methods,
    "bytes": _flipped,
    "is": lambda role: {"counter": ["address"], "reserved": ["constant"]}.get(role, []),
    **dict.fromkeys(("id", "class", "kind", "version"), _next),
    "frame": lambda kind: ["tell" if kind == "ask" else "ask"],
    "always": lambda value: [value + 1, GONE],
    "count": lambda many: [many + 1, many - 1] if isinstance(many, int) else ["0..0", "0..4"],
    "length": _lengths,
    "range": _ranges,
    "byte_order": lambda order: ["big" if order == "little" else "little", GONE],
    "direction": lambda direction: [other_way(direction)],
    "sent": lambda _: [True, GONE],
    **dict.fromkeys(("reserved", "sized_by", "counted_by", "text", "optional"), lambda _: [GONE]),
}

# ------------------------------------------------------------------ anything

_NUMBERS = (0, 1, -1, 2, 7, 127, 128, 255, 256, 65535, 65536, 2**31 - 1, 2**32 - 1, 2**32)
_TYPES = ("u8", "u16", "u32", "i8", "i16", "i32")
_BYTES = ("55", "AA 55", "00", "FF FF FF FF", "01 02 03 04 05 06 07 08", "5C 22 0A", "AA " * 30)
_VERSIONS = ("0", "2.0.0", "1.0.0-rc.1", "1.0.0-rc.1+7", TEXTS["all interfaces"], "v", "1.0 beta")
_ANYTHING: dict[str, tuple[Any, ...]] = {
    "type": _TYPES,
    "signed_as": (*_TYPES, GONE),
    "byte_order": ("little", "big"),
    "parity": ("none", "even", "odd"),
    "kind": ("document", "firmware", "implementation", "observation"),
    "count": ("0..", "1..", "0..1", "1..1", "2..2", "3..7", "..", "1..40", "0..65536"),
    "range": ("0..", "0..1", "1..1", "5..127", "-1..1", "-128..127", "0..255", "1..", "3..2"),
    "usual": ("0..1", "0..255", "0..65535", "1..0"),
    "bytes": _BYTES,
    "scale": ("1 s", "0.001 V", "1000 m", "1/3 s"),
    "unit": ("", "ms", "s", "%", '"', "°C", "\\", "x" * 99),
    "version": (*_VERSIONS, '"', "x" * 99),
    "baud": (1, 50, 4_000_000),
}


def anything(path: Steps, value: Any) -> Iterator[Any]:
    """Yield what an author might leave at a place, right or wrong."""
    yield GONE
    key = str(path[-1])
    yield from _ANYTHING.get(key, ())
    if isinstance(value, bool):
        yield not value
    elif isinstance(value, int):
        yield from (value + 1, value - 1, *_NUMBERS)
    elif isinstance(value, str):
        yield from ("", "x", 7, [value], {"a": value})
        if key == "direction":
            sender, _, _ = value.partition(" -> ")
            yield from (other_way(value), f"{sender} -> {sender}")
    elif isinstance(value, list):
        yield from ([], value[::-1], value + value[:1], value[:1])
    elif isinstance(value, dict):
        yield from ({}, dict(reversed(value.items())))
    yield None


# What a spec can hold in the place of a text, somewhere.
_TEXTS = ("host -> controller", "55 55 02 07", "0..9", "u8", "u16", "odd", "big", "little", "2 V")


def readable(value: Any) -> list[Any]:
    """Return what can often be read in the place of a text or a number."""
    if isinstance(value, bool):
        return [not value]
    if isinstance(value, int):
        return [value + 1, value - 1]
    return [f"{value} too", f"{value}2", *_TEXTS, "firmware", "document"]
