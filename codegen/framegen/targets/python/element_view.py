"""The class of an element as the templates show it: a tuple with named parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, Part, literal
from framegen.targets.python.number_view import AbsentView, NumberView, absent_view

if TYPE_CHECKING:
    from collections.abc import Sequence


@dataclass(frozen=True, slots=True)
class ElementView:
    """The class of the elements of a list."""

    name: str
    listed: str
    fields: Sequence[NumberView]

    @property
    def doc(self) -> list[str]:
        return [f"One of the {self.listed} of a message."]

    @property
    def types(self) -> list[str]:
        """The types of the parts."""
        return ["int" for _ in self.fields]

    @property
    def declared(self) -> str:
        """The declaration of the class."""
        bases: list[Part] = ["Element", Bracketed("tuple[", self.types, "]")]
        return Bracketed(f"class {self.name}(", bases, "):").fitted(0)

    @property
    def match_args(self) -> str:
        names = [literal(field.name) for field in self.fields]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        given = [f"{field.name}: int" for field in self.fields]
        return Bracketed("def __new__(", ["cls", *given], ") -> typing.Self:").fitted(4)

    @property
    def made(self) -> str:
        """The expression that makes an element of the arguments of its signature."""
        names = Bracketed("(", [field.name for field in self.fields], ")", lone=",")
        return Bracketed("return tuple.__new__(", ["cls", names], ")").fitted(8)

    @property
    def absent(self) -> AbsentView | None:
        """The property that tells whether an element is absent, where one can be."""
        return absent_view([*self.fields])
