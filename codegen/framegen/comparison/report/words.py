"""Frames and their values, as reports show them, each on one line."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

from framegen.comparison.report.titles import shortened_list

if TYPE_CHECKING:
    from framegen.comparison.effect import Effect, Witness

# Of a longer frame, so many bytes are shown; and so many characters of its values. Who decodes a
# frame needs all of it: longer ones are in the report for programs.
_BYTES = 300
_CHARACTERS = 160


def hex_of(data: bytes, most: int = _BYTES) -> str:
    """Return a frame in hex, `55 55 02 07`, of one with more bytes than `most` the beginning."""
    if len(data) <= most:
        return data.hex(" ").upper()
    return f"{data[:most].hex(' ').upper()} ... ({pluralize(len(data), 'byte')})"


def call_of(witness: Witness) -> str:
    """Return what a frame says as its sender would write it: `ServoMove(time_ms=1000)`."""
    values = ", ".join(f"{name}={_plain(value)}" for name, value in witness.values.items())
    return visible(f"{witness.message}({_shortened(values)})")


def effect_text(effect: Effect, title: str) -> str:
    """Return the sentence of an effect, below the name of its message."""
    sender = title if effect.witness is None else effect.witness.message
    return visible(effect.text.removeprefix(f"{title}: ").removeprefix(f"{sender}: "))


def between(effect: Effect) -> str:
    """Return the ends of an effect: of a frame, who sends it to whom; of kept editions, which."""
    ends = [_with_editions(end, effect) for end in effect.ends.split(", ") if end]
    if not ends and effect.editions:
        return f"those of {shortened_list(effect.editions)}"
    return (" -> " if effect.witness else " with ").join(ends)


def _with_editions(end: str, effect: Effect) -> str:
    if not effect.editions or not end.startswith("old "):
        return end
    return f"{end} of {shortened_list(effect.editions)}"


def _plain(value: Any) -> str:
    if isinstance(value, list):
        return f"[{', '.join(map(_plain, value))}]"
    if isinstance(value, dict):
        return f"({', '.join(f'{name}={_plain(each)}' for name, each in value.items())})"
    return repr(value)


def _shortened(text: str) -> str:
    return text if len(text) <= _CHARACTERS else f"{text[: _CHARACTERS - 4]} ..."
