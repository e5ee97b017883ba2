"""Files of others that were in the way, kept beside their place under another name."""

from __future__ import annotations

import os
import re
from itertools import count
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from pathlib import Path

# No name that Python imports, a linter reads or a site serves.
_NAME = re.compile(r".+\.mine(-\d+)?", re.DOTALL)


def is_kept(path: str) -> bool:
    """Tell whether a path is one that a file was kept under."""
    return _NAME.fullmatch(path) is not None


def kept_place(place: Path) -> Path:
    """Find a free name beside a file: NAME.mine, NAME.mine-2 and so on."""
    names = (f"{place.name}.mine{'' if n == 1 else f'-{n}'}" for n in count(1))
    return next(free for name in names if not os.path.lexists(free := place.with_name(name)))
