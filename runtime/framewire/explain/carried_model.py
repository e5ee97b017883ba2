"""The model of a protocol, which its library carries as data."""

from __future__ import annotations

import json
from pkgutil import get_data

from .protocol import Protocol


def protocol(package: str) -> Protocol:
    """Read the model that a library of this name carries."""
    return Protocol(json.loads(get_data(package, "protocol.json") or b""))


def classes(model: Protocol) -> dict[str, str]:
    """Return the class of each message: some of their names are taken in Python."""
    return {name: each.said.get("class", name) for name, each in model.messages.items()}
