"""The verb `simulate`: hands over to the virtual controller, which is a package of its own."""

from __future__ import annotations

from importlib import import_module

from .examples import PROGRAM
from .unusable import UnusableError

TYPE_CHECKING = False
if TYPE_CHECKING:
    from collections.abc import Sequence


def hand_over(words: Sequence[str]) -> int:
    """Runs the simulator's own command line."""
    package = f"{PROGRAM}_simulator"
    try:
        simulator = import_module(f"{package}.cli")
    except ModuleNotFoundError as error:
        if error.name not in {package, f"{package}.cli"}:
            raise
        raise UnusableError(
            f"the package {package} is not installed here; it comes with the whole of {PROGRAM}, "
            "so install that, or put the folder `simulator` of a clone on PYTHONPATH"
        ) from None
    code: int = simulator.main(list(words), program=f"{PROGRAM} simulate")
    return code
