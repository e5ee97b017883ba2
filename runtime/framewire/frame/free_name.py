"""Names of a protocol beside names of ours: one that is taken there gets a `_` behind it."""

from __future__ import annotations

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Collection, Mapping


def free_name(name: str, taken: Collection[str]) -> str:
    """Return the name that it has there. None in a spec ends so."""
    return f"{name}_" if name in taken else name


def freely_named(numbers: Mapping[str, int], taken: Collection[str]) -> dict[str, int]:
    """Return numbers by the names that they have there."""
    return {free_name(name, taken): number for name, number in numbers.items()}
