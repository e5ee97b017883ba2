"""The CAPTURE and --direction arguments: the bytes of a recording, and which way they went."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible

from framegen.reading.findings import did_you_mean
from framegen.reading.yamltree import Unusable

if TYPE_CHECKING:
    from framegen.language.values import Direction
    from framegen.model.model import Model


def content(file: str) -> bytes:
    """Return the bytes of a file, or of standard input for `-`. Raises Unusable."""
    try:
        return sys.stdin.buffer.read() if file == "-" else Path(file).read_bytes()
    except (OSError, ValueError) as error:
        why = getattr(error, "strerror", None) or str(error)
        raise Unusable(f"cannot read {visible(file)}: {why}") from None


def directions_from(model: Model, sender: str | None) -> list[Direction]:
    """Return the directions of one sender, or all of them. Raises Unusable."""
    if sender is None:
        return model.directions
    chosen = [direction for direction in model.directions if direction.sender == sender]
    if not chosen:
        senders = list(dict.fromkeys(direction.sender for direction in model.directions))
        raise Unusable(f"no endpoint {sender!r} sends anything", hint=did_you_mean(sender, senders))
    return chosen
