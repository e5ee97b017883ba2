"""Arguments of all verbs that write files: which spec, and whether to replace files of others."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from argparse import _ActionsContainer


def add_spec(parser: _ActionsContainer) -> None:
    """Declare SPEC: one of the specs, or all of them."""
    parser.add_argument(
        "spec",
        nargs="?",
        type=Path,
        metavar="SPEC",
        help="a spec file; without it, all spec/*.yaml",
    )


def add_force(parser: _ActionsContainer) -> None:
    """Declare --force."""
    parser.add_argument(
        "--force",
        action="store_true",
        help="replace files that were edited by hand or are not framegen's; "
        "each is kept beside its place, as NAME.mine",
    )
