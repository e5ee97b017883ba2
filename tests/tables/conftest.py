"""The libraries of the protocols, made once for all tests of a module."""

from tests.protocols.conftest import libraries

__all__ = ["libraries"]
