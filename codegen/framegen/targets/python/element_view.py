"""The class of an element as the templates show it: a tuple with named parts."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.targets.python.escape import Bracketed, Part, literal
from framegen.targets.python.number_view import AbsentView, NumberView, absent_view
from framegen.targets.python.text_view import TextView, constants_call

if TYPE_CHECKING:
    from collections.abc import Sequence

    from framegen.model.slots import Constant as Fixed


@dataclass(frozen=True, slots=True)
class ElementView:
    """The class of the elements of a list."""

    name: str
    listed: str
    fields: Sequence[NumberView | TextView]
    fixed: Sequence[Fixed] = ()

    @property
    def doc(self) -> list[str]:
        return [f"One of the {self.listed} of a message."]

    @property
    def types(self) -> list[str]:
        """The types of the parts."""
        return [field.value_type for field in self.fields]

    @property
    def base(self) -> str:
        """The class that it is made of."""
        return "Element" if set(self.types) == {"int"} else "MixedElement"

    @property
    def numbers(self) -> list[NumberView]:
        """Those of its fields that are numbers."""
        return [field for field in self.fields if isinstance(field, NumberView)]

    @property
    def fixed_bytes(self) -> str:
        """The assignment of the bytes that nobody gives; empty where it has none."""
        return constants_call(self.fixed)

    @property
    def declared(self) -> str:
        """The declaration of the class."""
        bases: list[Part] = [self.base, Bracketed("tuple[", self.types, "]")]
        return Bracketed(f"class {self.name}(", bases, "):").fitted(0)

    @property
    def match_args(self) -> str:
        names = [literal(field.name) for field in self.fields]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        given = [field.argument for field in self.fields]
        return Bracketed("def __new__(", ["cls", *given], ") -> typing.Self:").fitted(4)

    @property
    def made(self) -> str:
        """The expression that makes an element of the arguments of its signature."""
        names = Bracketed("(", [field.name for field in self.fields], ")", lone=",")
        return Bracketed("return tuple.__new__(", ["cls", names], ")").fitted(8)

    @property
    def absent(self) -> AbsentView | None:
        """The property that tells whether an element is absent, where one can be."""
        return absent_view(self.numbers)
