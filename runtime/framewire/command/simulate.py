"""The verb `simulate`: runs the virtual device, which is a package of its own."""

from __future__ import annotations

from importlib import import_module

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
    package = program.simulator
    module = f"{package}.cli"
    try:
        return import_module(module)
    except ModuleNotFoundError as error:
        if error.name not in {package, module}:
            raise
        raise UsageError(
            f"the package {package} is not installed here: install it, or build a virtual "
            f"device on {program.name}.Device"
        ) from None
    except ImportError as error:
        raise UsageError(
            f"the package {package} does not work with this {program.name}: {error}; update it, or "
            f"build a virtual device on {program.name}.Device"
        ) from None
