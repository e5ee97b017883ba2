"""The verb `simulate`: runs a virtual device, of a package of its own or of the specification."""

from __future__ import annotations

from importlib import import_module

from ..part import part_of
from .usage_error import UsageError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import ArgumentParser
    from collections.abc import Sequence
    from typing import Any

    from .program import Program


def hand_over(words: Sequence[str], program: Program) -> int:
    """Run the simulator's own command line."""
    code: int = _simulator(program).main(list(words), program=f"{program.name} simulate")
    return code


def add_arguments(parser: ArgumentParser, program: Program) -> None:
    """Declare the simulator's own arguments, if it tells them, to complete them."""
    declare = getattr(_simulator(program), "add_arguments", None)
    if declare is not None:
        declare(parser)


def _simulator(program: Program) -> Any:
    """Return the command of the simulator: one that somebody wrote, or that of a class `Board`.

    Where there is no such package, it is the device that follows from the specification.
    """
    package = program.simulator
    try:
        own = _installed(f"{package}.cli", program) or _installed(package, program)
    except ModuleNotFoundError:
        raise
    except ImportError as error:
        raise UsageError(
            f"the package {package} does not work with this {program.name}: {error}; update it, or "
            "remove it, for a device that follows from the specification"
        ) from None
    if hasattr(own, "main"):
        return own
    board = getattr(own, "Board", part_of(program.package, "simulator").VirtualDevice)
    if not hasattr(board, "command"):
        base = f"{program.name}.simulator.VirtualDevice"
        raise UsageError(f"{package}.Board is no virtual device: derive it from {base}")
    return board.command()


def _installed(module: str, program: Program) -> Any:
    """Return a module, None where it is not installed."""
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name not in {program.simulator, module}:
            raise
    return None
