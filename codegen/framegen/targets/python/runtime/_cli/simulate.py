"""The verb `simulate`: runs the virtual device, which is a package of its own."""

from __future__ import annotations

from importlib import import_module

from .examples import PROGRAM
from .usage_error import UsageError
from .verbs import SIMULATOR

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


def hand_over(words: Sequence[str]) -> int:
    """Run the simulator's own command line."""
    module = f"{SIMULATOR}.cli"
    try:
        simulator = import_module(module)
    except ModuleNotFoundError as error:
        if error.name not in {SIMULATOR, module}:
            raise
        raise UsageError(
            f"the package {SIMULATOR} is not installed here: install it, or else make a virtual "
            f"device of {PROGRAM}.Device"
        ) from None
    code: int = simulator.main(list(words), program=f"{PROGRAM} simulate")
    return code
