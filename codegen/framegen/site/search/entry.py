"""One entry of the search: what it is called, where it stands, and what is said there."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

# What can be found, by kind; of two that match alike, the one whose kind stands further up leads.
KINDS = {
    "message": "Messages",
    "field": "Fields",
    "value": "Values",
    "method": "Methods",
    "guide": "Guides",
    "page": "Pages",
    "erratum": "Errata",
    "lookalike": "Look-alikes",
    "frame": "Frames",
}


@dataclass(frozen=True, slots=True)
class Entry:
    """A place of the site, by its path below the root, with an anchor where there is one.

    `where` says what it is, `names` are other names that lead to it at once, `also` what people
    look for it by, and `hex` the bytes of a documented frame. `aside` is what is not for users:
    it comes behind what is, unless its headings tell that it is meant.
    """

    kind: str
    title: str
    path: str
    where: str
    text: str = ""
    protocol: str = ""
    names: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    hex: str = ""
    aside: bool = False

    def called(self, words: tuple[str, ...]) -> Entry:
        """Return the entry with more words that lead to it."""
        return replace(self, also=(*self.also, *words))

    @property
    def data(self) -> dict[str, Any]:
        """The entry as plain data, without what is empty."""
        found = {
            "kind": self.kind,
            "protocol": self.protocol,
            "title": self.title,
            "path": self.path,
            "where": self.where,
            "text": " ".join(self.text.split()),
            "names": list(dict.fromkeys(self.names)),
            "also": list(self.also),
            "hex": self.hex,
            "aside": self.aside,
        }
        return {name: value for name, value in found.items() if value}


def spellings(number: int, size: int = 1) -> tuple[str, ...]:
    """Return a number as people write it: in decimal, and in hex of `size` bytes and shorter."""
    if number < 0:
        return (str(number),)
    digits = f"{number:0{2 * size}x}"
    return (str(number), digits, f"0x{digits}", f"0x{number:x}")


def sentences(*parts: str) -> str:
    """Return parts that say something, one after another; what ends nothing gets a full stop."""
    found = (part.strip() for part in parts)
    return " ".join(part if part[-1] in ".:!?" else f"{part}." for part in found if part)
