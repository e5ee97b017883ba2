"""What libraries have in common, as each of them has a copy of it."""

from __future__ import annotations

import re
from functools import cache
from pathlib import Path

import framewire

_FOLDER = Path(str(framewire.__file__)).parent
# Its rooms, and the folders of a library that hold the copies.
_ROOMS = {
    "client": "_client",
    "codec": "_codec",
    "command": "_cli",
    "explain": "_explanation",
    "frame": "_frame",
    "line": "_serial",
    "recording": "_recording",
    "tables": "_tables",
}


@cache
def copies() -> dict[str, str]:
    """Return the text of each copy by its path in the library; read once."""
    found = {}
    for room, folder in _ROOMS.items():
        for file in sorted((_FOLDER / room).rglob("*.py")):
            place = f"{folder}/{file.relative_to(_FOLDER / room).as_posix()}"
            found[place] = _moved(file.read_text(encoding="utf-8"), place.count("/"))
    return found


def _moved(text: str, depth: int) -> str:
    """Return a module that imports from the rooms where they are in a library."""
    other_room = re.compile(rf"(?m)^( *from \.{{{depth + 1}}})({'|'.join(_ROOMS)})(?=[. ])")
    return other_room.sub(lambda found: found[1] + _ROOMS[found[2]], text)
