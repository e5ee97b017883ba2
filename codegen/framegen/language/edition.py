"""The editions of the spec language, and the refusal of a newer one.

Added keys keep the number. It rises when a meaning changes, and every edition is read for ever.
"""

from __future__ import annotations

from typing import Literal, TypeAlias, get_args

from framegen import __version__

Edition: TypeAlias = Literal[1, 2]
EDITIONS: tuple[int, ...] = get_args(Edition)
LATEST = EDITIONS[-1]

# From this edition on, the first endpoint is the library's user; before, whoever sent first was.
FIRST_ENDPOINT_IS_CLIENT = 2


def is_newer(value: object) -> bool:
    """Tell whether `value` is an edition that only a later framegen reads."""
    return isinstance(value, int) and not isinstance(value, bool) and value > LATEST


def refusal(value: object) -> tuple[str, str]:
    """Return the error for an edition that is newer than this framegen."""
    what = f"this spec is written in edition {value} of the language"
    return (
        f"{what}, and framegen {__version__} reads up to {LATEST}",
        "a newer framegen is needed: git pull in its clone, then pip install . ./codegen",
    )
