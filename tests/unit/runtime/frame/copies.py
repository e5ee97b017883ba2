"""Copies of a value, in each way that Python has."""

import copy
import pickle
from typing import TypeVar

Value = TypeVar("Value")


def pickled(value: Value) -> list[Value]:
    """Return what comes back of a value by each protocol of pickle."""
    protocols = range(pickle.HIGHEST_PROTOCOL + 1)
    return [pickle.loads(pickle.dumps(value, each)) for each in protocols]  # noqa: S301 - our own


def copies(value: Value) -> list[Value]:
    return [copy.copy(value), copy.deepcopy(value), *pickled(value)]
