"""Names that something had before: one, or a list of them."""

from __future__ import annotations


def named_once(text: str) -> tuple[str, ...]:
    """Read one name. Raises ValueError for none."""
    if not text.strip():
        raise ValueError("a name is missing")
    return (text.strip(),)


def names_of(listed: list[object]) -> tuple[str, ...]:
    """Read a list of names. Raises ValueError for what is no name."""
    for name in listed:
        if not isinstance(name, str) or not name.strip():
            raise ValueError(f"`{name}` is no name")
    return tuple(str(name).strip() for name in listed)
