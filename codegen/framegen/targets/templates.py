"""The templates of a target: strict about undefined names, and compiled once for many runs."""

from __future__ import annotations

import sys
from contextlib import suppress
from typing import TYPE_CHECKING, Any

import jinja2
from jinja2 import Environment, FileSystemBytecodeCache, FileSystemLoader, StrictUndefined

if TYPE_CHECKING:
    from pathlib import Path

    from jinja2.bccache import Bucket


class _Compiled(FileSystemBytecodeCache):
    """A cache of compiled templates, kept beside them, where that is possible.

    Compiling the templates takes as long as all the rest of a run.
    """

    def __init__(self, folder: Path, kind: str) -> None:
        self._folder = folder
        # One template can compile to several texts: jinja2 looks at its settings while it does.
        super().__init__(str(folder), f"{kind}-%s.jinja2-{jinja2.__version__}")

    def load_bytecode(self, bucket: Bucket) -> None:
        with suppress(OSError):
            super().load_bytecode(bucket)

    def dump_bytecode(self, bucket: Bucket) -> None:
        if sys.dont_write_bytecode:
            return
        with suppress(OSError):
            self._folder.mkdir(exist_ok=True)
            super().dump_bytecode(bucket)


def environment(folder: Path, kind: str, **settings: Any) -> Environment:
    """Return the renderer of the templates of a folder; `settings` say how it escapes."""
    return Environment(  # noqa: S701 - whoever calls this says what is escaped, and how
        loader=FileSystemLoader(folder),
        bytecode_cache=_Compiled(folder / "__pycache__", kind),
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
        **settings,
    )
