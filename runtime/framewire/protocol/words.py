"""What is written of a protocol, and of its parts: in words, with citations."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import NamedTuple


@dataclass(frozen=True)
class Note:
    """What else is known, and from where."""

    text: str
    cite: str


@dataclass(frozen=True)
class NamedValue:
    """A value that has a name; at one that is `absent`, there is nothing."""

    value: int
    about: str = ""
    absent: bool = False
    cite: str = ""


class Scale(NamedTuple):
    """A larger unit: what one step is in it, and what 0 is, each as digits."""

    step: str
    unit: str
    offset: str = ""


class Bits(NamedTuple):
    """Some bits of a number that have a name: the lowest and the highest of them."""

    low: int
    high: int
    about: str


@dataclass(frozen=True)
class Limits:
    """What a client sends unless told otherwise; and what others of the family take."""

    usual: str
    others: Mapping[str, str]


@dataclass(frozen=True)
class Link:
    """The line: how fast it is, and how many bits a byte takes on it."""

    baud: int
    bits_per_byte: int


@dataclass(frozen=True)
class Source:
    """Something that is cited. `kind` is what it is, such as `document` or `firmware`."""

    title: str
    kind: str


@dataclass(frozen=True)
class Endpoint:
    """One end of the line."""

    about: str
    notes: tuple[Note, ...] = ()


@dataclass(frozen=True)
class Example:
    """A frame in hex, with where it is documented or, if nowhere, why it was `constructed`."""

    title: str
    hex: str
    cite: str = ""
    constructed: str = ""


@dataclass(frozen=True, kw_only=True)
class Reserved:
    """An id, several such as `8..11`, or a name that no message may have."""

    id: int | str | None = None
    name: str = ""
    direction: str = ""
    why: str
    cite: str = ""


@dataclass(frozen=True, kw_only=True)
class Erratum:
    """A fact that the document has wrong: what it says, what its bytes say, and what holds here."""

    title: str
    message: str
    concerns: str
    document: str
    bytes: str
    here: str
    why: str
    cite: str


@dataclass(frozen=True)
class Unknown:
    """A question that no source answers."""

    message: str
    concerns: str
    what: str
