"""The error of the command line."""

from __future__ import annotations


class UnusableError(Exception):
    """What was given on the command line, or to read, is of no use. The text says why."""
