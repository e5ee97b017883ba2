"""What annotations need of `typing`, which is imported when somebody asks what they mean.

To import it takes longer than the whole codec. So annotations say `typing.Any` of the object here,
and `typing.get_type_hints` finds the real thing through it.
"""

from __future__ import annotations


class _Typing:
    """Stands for the module: each name is looked up there when it is needed."""

    __slots__ = ()

    def __getattr__(self, name: str) -> object:
        import typing

        if name == "Self" and not hasattr(typing, name):  # as in Python 3.10
            return typing.Any
        return getattr(typing, name)


typing = _Typing()
