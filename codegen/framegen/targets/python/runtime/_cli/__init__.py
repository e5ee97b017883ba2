"""The command of this library."""

from __future__ import annotations

import sys

from .command import run
from .examples import PROGRAM

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


def main(argv: Sequence[str] | None = None) -> int:
    """Run the command line, and return its exit status: one of `exit_codes`."""
    return run(PROGRAM, sys.argv[1:] if argv is None else list(argv))
