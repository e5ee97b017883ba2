"""Types: whether what a program gave is still taken, and what it got still given."""

from __future__ import annotations

import re
from itertools import zip_longest
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from framegen.comparison.surface import Surface

_TOKEN = re.compile(r"\w+|[^\w\s]")
_LITERAL = re.compile(r"Literal\[(.*)\]")


def takes(old: str, new: str) -> bool:
    """Tell whether an argument of the new type takes all that one of the old type took."""
    known, chosen = _LITERAL.fullmatch(old), _LITERAL.fullmatch(new)
    if known is not None and chosen is not None:
        return {*known[1].split(", ")} <= {*chosen[1].split(", ")}
    if not _is_optional(old):
        new = new.removesuffix(" | None")
    # A whole number is as good as any, where any number is taken.
    return all(
        one == other or (one, other) == ("int", "float")
        for one, other in zip_longest(_TOKEN.findall(old), _TOKEN.findall(new))
    )


def gives(old: str, new: str, library: Surface) -> bool:
    """Tell whether a result of the new type is one of the old type."""
    if _is_optional(old):
        old, new = old.removesuffix(" | None"), new.removesuffix(" | None")
    return old == new or library.is_a(new, old)


def _is_optional(text: str) -> bool:
    return text.endswith(" | None")
