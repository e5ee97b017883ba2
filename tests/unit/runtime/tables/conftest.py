"""The libraries of the protocols, made once for all tests of a module."""

from tests.contract.protocols.conftest import libraries

__all__ = ["libraries"]
