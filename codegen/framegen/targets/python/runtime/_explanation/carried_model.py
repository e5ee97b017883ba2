"""The model of the protocol, which the package carries as data."""

from __future__ import annotations

import json
from pkgutil import get_data

from .protocol import Protocol


def protocol() -> Protocol:
    """Read the model."""
    return Protocol(json.loads(get_data(Protocol.__module__, "model.json") or b""))


def classes(model: Protocol) -> dict[str, str]:
    """Return the class of each message: some of their names are taken in Python."""
    return {name: each.said.get("class", name) for name, each in model.messages.items()}
