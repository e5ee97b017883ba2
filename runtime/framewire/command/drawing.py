"""A drawing of the readings of a recording, for `stats`: apart, since it needs Matplotlib."""

from __future__ import annotations

import os
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ..recording.layout import layouts_of
from ..tables.stats.plot import drawing
from .usage_error import UsageError

if TYPE_CHECKING:
    from collections.abc import Iterator

    from ..codec.protocol_codec import ProtocolCodec
    from ..tables.stats.traces import Traces


def drawn(
    traces: Traces, file: Path, name: str, baud: float, codec: ProtocolCodec
) -> Iterator[str]:
    """Draw into a file, and yield what was left out, in words. Raises UsageError."""
    title = f"{Path(name).name}: {layouts_of(codec).described.title}"
    try:
        data, left_out = drawing(traces, file.suffix.lower(), title, baud)
    except ValueError as error:
        raise UsageError(f"{file} is not drawn: {error}") from None
    _write(file, data)
    if left_out:
        yield f"not drawn, as there is no room: {', '.join(left_out)}"


def _write(file: Path, data: bytes) -> None:
    """Write a file as a whole, or leave what was there."""
    part = file.with_name(f".{file.name}.{os.getpid()}")
    try:
        part.write_bytes(data)
        part.replace(file)
    except OSError as error:
        raise UsageError(f"{file} cannot be written: {error.strerror or error}") from None
    finally:
        with suppress(OSError):
            part.unlink(missing_ok=True)
