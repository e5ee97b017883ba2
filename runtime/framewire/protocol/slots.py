"""Slots: a frame is an ordered list of them, each some bytes that belong together.

The place of a slot, `at`, counts from the first byte of the frame or, below zero, from its end; in
an element of a list, from the first byte of the element. `size` is in bytes.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import inf
from typing import Any, TypeAlias

from .words import Bits, Limits, NamedValue, Note, Scale

# What is called otherwise in the file, and what stands there even where it is as usual.
_ORDER = {"key": "byte_order"}
_ALWAYS = {"always": True}


@dataclass(frozen=True, kw_only=True)
class Constant:
    """Bytes that never change; those of the role `reserved` are not checked.

    If they belong to the message, `is_field` is true, and `of_type` says which numbers they are.
    """

    role: str
    name: str
    at: int
    size: int
    data: bytes = field(metadata={"key": "bytes"})
    about: str = ""
    is_field: bool = field(default=False, metadata={"key": "field"})
    of_type: str = ""
    order: str = field(metadata=_ORDER)
    notes: tuple[Note, ...] = ()
    cite: str = ""


@dataclass(frozen=True, kw_only=True)
class Number:
    """A number: of the envelope, of a message, or of an element of a list.

    `role` is what it is there for: `length`, `id`, `address`, `counter` and `checksum` belong to
    the envelope, `count`, `size` and `field` to the message. `of` names the slots that a length
    counts, or that a checksum covers; `terms` are those of the checksum's method. Both ends know an
    id that is not `sent`. Addresses that are `silent` are answered by nobody. Without bounds, it is
    a floating-point number.
    """

    role: str
    name: str
    at: int
    size: int
    type: str
    low: float = -inf
    high: float = inf
    signed: bool = False
    order: str = field(metadata=_ORDER)
    optional: bool = False
    of: tuple[str, ...] = ()
    method: str = ""
    terms: Mapping[str, Any] = field(default_factory=dict)
    silent: tuple[int, ...] = ()
    unit: str = ""
    scale: Scale | None = None
    bits: Mapping[str, Bits] = field(default_factory=dict)
    about: str = ""
    values: Mapping[str, NamedValue] = field(default_factory=dict)
    limits: Limits | None = None
    signed_as: str = ""
    notes: tuple[Note, ...] = ()
    cite: str = ""
    sent: bool = True

    @property
    def is_float(self) -> bool:
        """Whether it is a floating-point number."""
        return self.type.startswith("f")

    @property
    def is_field(self) -> bool:
        """Whether it belongs to the message; all others belong to the envelope."""
        return self.role in ("count", "size", "field")

    @property
    def is_counted(self) -> bool:
        """Whether it says how long a list is, in elements or in bytes."""
        return self.role in ("count", "size")


@dataclass(frozen=True, kw_only=True)
class Text:
    """Text of a fixed size; zeros at its end are no part of it, unless it is `whole`."""

    role: str = field(default="text", metadata=_ALWAYS)
    name: str
    at: int
    size: int
    charset: str
    about: str = ""
    notes: tuple[Note, ...] = ()
    cite: str = ""
    whole: bool = False


@dataclass(frozen=True, kw_only=True)
class Packed:
    """So many unsigned numbers, whose bits stand behind each other. `packed` is their type."""

    role: str = field(default="packed", metadata=_ALWAYS)
    name: str
    at: int
    size: int
    packed: str
    count: int
    low: int
    high: int
    order: str = field(metadata=_ORDER)
    unit: str = ""
    scale: Scale | None = None
    about: str = ""
    notes: tuple[Note, ...] = ()
    cite: str = ""

    @property
    def bits(self) -> int:
        """The number of bits of each."""
        return int(self.packed[1:])


@dataclass(frozen=True, kw_only=True)
class List:
    """A list of elements with the same slots, `low` to `high` of them; `size` is that of one.

    `counter` is the field that says how many there are, `variable` the name for that in a length
    rule. `element` is the name of an element with several fields; without one, elements are bare
    numbers or, if it is `text`, characters.
    """

    role: str = field(default="list", metadata=_ALWAYS)
    name: str
    at: int
    size: int
    low: int
    high: int
    counter: str = ""
    is_fixed: bool = field(default=False, metadata={"key": "fixed"})
    text: str = ""
    variable: str = ""
    element: str = ""
    about: str = ""
    fields: tuple[Constant | Number | Text, ...]
    notes: tuple[Note, ...] = ()
    cite: str = ""

    def path(self, index: int | str, each: Constant | Number | Text) -> str:
        """Return the path of a slot in an element: `items[0].level`, or `ids[0]`."""
        inner = f".{each.name}" if self.element else ""
        return f"{self.name}[{index}]{inner}"


@dataclass(frozen=True, kw_only=True)
class Body:
    """Where the fields of a message stand in its envelope."""

    role: str = field(default="body", metadata=_ALWAYS)
    name: str
    at: int
    size: int = field(default=0, metadata=_ALWAYS)
    about: str = ""
    notes: tuple[Note, ...] = ()


# Those of an element of a list; those of a message, where its envelope has the body; and any.
Element: TypeAlias = Constant | Number | Text
Field: TypeAlias = Constant | Number | Text | Packed | List
Slot: TypeAlias = Constant | Number | Text | Packed | List | Body
