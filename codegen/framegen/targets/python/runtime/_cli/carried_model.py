"""The model of the protocol, which the package carries as data."""

from __future__ import annotations

import json
from pkgutil import get_data

from .._explanation.protocol import Protocol


def protocol() -> Protocol:
    """Read the model."""
    return Protocol(json.loads(get_data(Protocol.__module__, "model.json") or b""))
