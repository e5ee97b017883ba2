"""The libraries of the protocols, made once for all tests of a module, and which stand for all."""

from typing import Any

from tests.contract.protocols.conftest import libraries

__all__ = ["libraries"]

# A CRC; every kind of field; the one that ships; two sums as a checksum. tests/world has others.
SHOWN = {"crsf", "everything", "lxservo", "ubx"}


def is_shown(name: str, *_others: Any) -> bool:
    return name in SHOWN
