"""Which protocols stand for all of them in `make test`; tests/world has the others."""

from typing import Any

# A CRC; every kind of field; the one that ships; and a checksum of two sums.
SHOWN = {"crsf", "everything", "lxservo", "ubx"}


def is_shown(name: str, *_others: Any) -> bool:
    return name in SHOWN
