"""The verb `simulate`: runs the virtual device, which is a package of its own."""

from __future__ import annotations

from importlib import import_module

from .examples import PROGRAM
from .usage_error import UsageError
from .verbs import SIMULATOR

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser
    from collections.abc import Sequence
    from typing import Any


def hand_over(words: Sequence[str]) -> int:
    """Run the simulator's own command line."""
    code: int = _simulator().main(list(words), program=f"{PROGRAM} simulate")
    return code


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the simulator's own arguments, if it tells them, to complete them."""
    declare = getattr(_simulator(), "add_arguments", None)
    if declare is not None:
        declare(parser)


def _simulator() -> Any:
    module = f"{SIMULATOR}.cli"
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name not in {SIMULATOR, module}:
            raise
        raise UsageError(
            f"the package {SIMULATOR} is not installed here: install it, or build a virtual "
            f"device on {PROGRAM}.Device"
        ) from None
    except ImportError as error:
        raise UsageError(
            f"the package {SIMULATOR} does not work with this {PROGRAM}: {error}; update it, or "
            f"build a virtual device on {PROGRAM}.Device"
        ) from None
