"""Write a file whole or not at all, for what must not be lost."""

from __future__ import annotations

import os
import shutil
from contextlib import suppress

from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from pathlib import Path


def write_whole(path: Path, data: bytes) -> None:
    """Put bytes in place of what a file holds, and leave no half file behind.

    Its permissions stay. Raises UsageError.
    """
    # A link stays a link: the file that it leads to is written.
    whole = path.resolve()
    beside = whole.with_name(f".{whole.name}.{os.getpid()}")
    try:
        beside.write_bytes(data)
        if whole.exists():
            shutil.copymode(whole, beside)
        beside.replace(whole)
    except OSError as error:
        with suppress(OSError):
            beside.unlink()
        raise UsageError(f"{path} cannot be written: {error.strerror or error}") from None
