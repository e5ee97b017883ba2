"""Floating-point numbers, of which the highest byte comes first."""

from __future__ import annotations

from .floating import Float


class F32(Float, code="f", order=">"):
    """A floating-point number of four bytes: about seven digits of it are exact."""

    __slots__ = ()


class F64(Float, code="d", order=">"):
    """A floating-point number of eight bytes, as Python has them."""

    __slots__ = ()
