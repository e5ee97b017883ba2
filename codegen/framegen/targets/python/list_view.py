"""What the templates show of the list of a message: its elements, how it is given and read."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.exchanges import snake_case
from framegen.model.layout import Repeat, WireField
from framegen.targets.python.escape import WIDTH, Bracketed, Part, literal
from framegen.targets.python.number_view import RETURN, AbsentView, NumberView, absent_view
from framegen.targets.python.words import range_expression, struct_order

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Spec

_COLUMNS_FOR = "For arrays and plots of a recording: several times as fast as"


def given(argument: WireField | Repeat, value: Any, before: str = "") -> Part:
    """A value of an example as an argument, behind `before`; elements as plain tuples."""
    if isinstance(argument, WireField):
        return f"{before}{value}"
    if argument.element is None:
        return Bracketed(f"{before}[", [str(item) for item in value], "]")
    names = [field.name for field in argument.fields]
    elements = [[str(item[name]) for name in names] for item in value]
    return Bracketed(
        f"{before}[", [Bracketed("(", element, ")", lone=",") for element in elements], "]"
    )


@dataclass(frozen=True, slots=True)
class ListView:
    """The list of a message."""

    layout: Repeat
    spec: Spec

    @property
    def name(self) -> str:
        return self.layout.name

    @property
    def element(self) -> str | None:
        return self.layout.element

    @property
    def fields(self) -> list[NumberView]:
        return [NumberView(field, self.spec) for field in self.layout.fields]

    @property
    def absent(self) -> AbsentView | None:
        """What tells whether an element is absent, where one can be."""
        return absent_view(self.fields)

    @property
    def codes(self) -> str:
        """The letters of one element in `struct`, behind that of the byte order."""
        return struct_order(self.spec.byte_order) + "".join(
            field.wire.code for field in self.layout.fields
        )

    @property
    def match_args(self) -> str:
        names = [literal(field.name) for field in self.fields]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        fields = [f"{field.name}: int" for field in self.fields]
        return Bracketed("def __new__(", ["cls", *fields], ") -> Self:").fitted(4)

    @property
    def made(self) -> str:
        """What makes one of the arguments of its signature."""
        names = Bracketed("(", [field.name for field in self.fields], ")", lone=",")
        return Bracketed("return tuple.__new__(", ["cls", names], ")").fitted(8)

    @property
    def element_doc(self) -> list[str]:
        return [f"One of the {self.name} of a message: a tuple ({self.names}) with names."]

    @property
    def declared(self) -> str:
        """The declaration of the class of an element."""
        bases: list[Part] = ["Element", Bracketed("tuple[", self._ints, "]")]
        return Bracketed(f"class {self.element}(", bases, "):").fitted(0)

    @property
    def _ints(self) -> list[str]:
        """The types of its fields."""
        return ["int" for _ in self.layout.fields]

    @property
    def names(self) -> str:
        """The names of its fields, as the tuple that one element is made of."""
        return ", ".join(field.name for field in self.fields) + (
            "," if len(self.fields) == 1 else ""
        )

    @property
    def strategy(self) -> Bracketed:
        """Hypothesis's strategy for it, as an argument."""
        items = [field.strategy for field in self.fields]
        element: Bracketed = (
            items[0] if self.element is None else Bracketed("st.tuples(", items, ")")
        )
        sizes = [f"min_size={self.layout.low}", f"max_size={self.layout.high}"]
        return Bracketed(f"{self.name}=st.lists(", [element, *sizes], ")")

    @property
    def snake(self) -> str:
        """The name of its element, for the functions that make and read one."""
        return snake_case(self.element or "")

    @property
    def reader(self) -> str:
        """The function that reads elements from the bytes of a frame."""
        codes = [literal(self.codes)]
        return Bracketed(f"_read_{self.snake} = Struct(", codes, ").iter_unpack").fitted(0)

    @property
    def maker(self) -> str:
        """The function that makes an element of a tuple."""
        element = str(self.element)
        types = ["[tuple[int, ...]]", element]
        kind = Bracketed(f"_make_{self.snake}: Callable[", types, "] = partial(")
        if len(str(kind)) <= WIDTH:
            return Bracketed(str(kind), ["tuple.__new__", element], ")").fitted(0)
        return f"{kind.fitted(0)}tuple.__new__, {element})"

    @property
    def read_as(self) -> str:
        """The type that reading it gives."""
        return f"tuple[{self.element or 'int'}, ...]"

    @property
    def read(self) -> str:
        """The expression that reads it from the frame."""
        data = f"self._frame[{self.layout.offset}:]"
        if self.element is not None:
            read = Bracketed(f"_read_{self.snake}(", [data], ")")
            each = Bracketed("map(", [f"_make_{self.snake}", read], ")")
            return Bracketed("tuple(", [each], ")").fitted(8, last=RETURN)
        if self.layout.fields[0].wire.is_byte:
            return f"tuple({data})"
        return f"tuple(chain.from_iterable(iter_unpack({literal(self.codes)}, {data})))"

    @property
    def column_types(self) -> str:
        """The types of its columns, as many as there is room for in the line."""
        types = ", ".join("Column" for _ in self.fields)
        return f"tuple[{types if len(self.fields) <= 6 else 'Column, ...'}]"

    @property
    def columns(self) -> str:
        """The columns, of all the numbers in the order of the frame."""
        width = len(self.fields)
        parts = [f"numbers[{place}::{width}]" for place in range(width)]
        line = ", ".join(parts)
        if width > 1 and len("        return ") + len(line) <= WIDTH:
            return line
        return Bracketed("(", parts, ")", lone=",").fitted(8, last=RETURN)

    @property
    def columns_doc(self) -> list[str]:
        """What its columns are, and what they are for."""
        *others, last = [field.name for field in self.fields]
        fields = f"{', '.join(others)} and {last}" if others else last
        return [
            f"The {self.name} as columns of plain numbers.",
            f"One for each field: {fields}. {_COLUMNS_FOR} `{self.name}`.",
        ]

    @property
    def counts(self) -> str:
        return range_expression(range(self.layout.low, self.layout.high + 1))

    @property
    def bounds(self) -> str:
        return f"{self.layout.low}..{self.layout.high}"

    @property
    def argument(self) -> Part:
        """How it is declared as an argument."""
        if self.element is None:
            return f"{self.name}: Iterable[int]"
        element = Bracketed("tuple[", self._ints, "]")
        return Bracketed(f"{self.name}: Iterable[", [element], "]", comma="")

    @property
    def getter(self) -> str:
        """The declaration of the property that reads it."""
        return Bracketed(f"def {self.name}(", ["self"], f") -> {self.read_as}:").fitted(4)

    @property
    def doc(self) -> list[str]:
        """What it is, how many there can be, and what else is known of it."""
        field = self.layout.field
        notes = [
            f"{note.text} ({self.spec.sources[note.cite.source].title})" for note in field.notes
        ]
        return [field.about, f"{self.bounds} of them.", *notes]
