"""What the templates show of a message: its class, its strategy, its examples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.layout import Repeat, WireField
from framegen.targets.python.escape import Bracketed, Part, literal, session
from framegen.targets.python.list_view import ListView, given
from framegen.targets.python.names import strategy_name
from framegen.targets.python.number_view import AbsentView, NumberView, absent_view
from framegen.targets.python.words import direction_member, range_expression
from framegen.wording import describe_range

if TYPE_CHECKING:
    from typing import Any

    from framegen.language.spec import Example
    from framegen.language.values import Citation
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


_ASSIGNED = "self._frame = "
# So many bytes of a frame have room in a line of an example.
_SHOWN = 31


@dataclass(frozen=True, slots=True)
class MessageView:
    """One message class."""

    layout: MessageLayout
    model: Model

    @property
    def name(self) -> str:
        return self.layout.name

    @property
    def doc(self) -> list[str]:
        """The summary, and below it a paragraph each for what its user should know."""
        message, frame = self.layout.message, self.layout.frame
        found = [message.summary, message.description]
        if message.deprecated:
            found.append(f"Deprecated: {message.deprecated}")
        if message.reply:
            found.append(f"Answered by {message.reply}.")
        identity = f"{frame.id_name.capitalize()} {self.layout.id} (0x{self.layout.id:02X})"
        lengths = (
            f"{frame.length_name} {self.layout.formula}: {describe_range(self.layout.lengths)}"
        )
        sender, receiver = self.layout.direction.sender, self.layout.direction.receiver
        found.append(f"{identity}, {sender} to {receiver}, {lengths}.")
        found.append(f"Source: {self.cited(message.cite)}.")
        return found

    def cited(self, cite: Citation) -> str:
        title = self.model.spec.sources[cite.source].title
        return f"{title}, {cite.place}" if cite.place else title

    @property
    def vendor_name(self) -> str:
        return self.layout.message.vendor_name

    @property
    def command(self) -> int:
        return self.layout.id

    @property
    def direction(self) -> str:
        return direction_member(self.layout.direction)

    @property
    def lengths(self) -> str:
        """The legal lengths, as a range expression."""
        return range_expression(self.layout.lengths)

    @property
    def numbers(self) -> list[NumberView]:
        """The fields in front of the list, its count among them."""
        return [NumberView(field, self.model.spec) for field in self.layout.numbers]

    @property
    def given(self) -> list[NumberView]:
        """The numbers that a user gives."""
        return [
            NumberView(field, self.model.spec)
            for field in self.layout.arguments
            if isinstance(field, WireField)
        ]

    @property
    def repeat(self) -> ListView | None:
        repeat = self.layout.repeat
        return None if repeat is None else ListView(repeat, self.model.spec)

    @property
    def counter(self) -> int:
        """The position of the count among the numbers."""
        return next(
            at for at, field in enumerate(self.layout.numbers) if self.layout.counts_with(field)
        )

    @property
    def narrowed(self) -> bool:
        """Whether a field has a range narrower than its type."""
        repeat = self.layout.repeat
        fields = [*self.layout.numbers, *(repeat.fields if repeat else ())]
        return any(field.narrowed for field in fields)

    @property
    def absent(self) -> AbsentView | None:
        """What tells whether the message says that there is nothing to tell of, where it can."""
        return absent_view(self.given)

    @property
    def arguments(self) -> list[str]:
        """The names of the constructor's arguments."""
        return [argument.name for argument in self.layout.arguments]

    @property
    def match_args(self) -> str:
        names = [literal(name) for name in self.arguments]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        numbers = [f"{field.name}: int" for field in self.given]
        lists = [self.repeat.argument] if self.repeat else []
        return Bracketed("def __init__(", ["self", *numbers, *lists], ") -> None:").fitted(4)

    @property
    def framed(self) -> str:
        """The call that makes the frame of what the constructor was given."""
        numbers = Bracketed("(", [field.name for field in self.given], ")", lone=",")
        lists = [self.repeat.name] if self.repeat else []
        return Bracketed("self.SHAPE.frame(", [numbers, *lists], ")").fitted(8, last=_ASSIGNED)

    @property
    def example(self) -> Example:
        """The shortest example, for the docstring."""
        return min(self.layout.message.examples, key=lambda example: len(example.hex))

    @property
    def example_lines(self) -> list[str]:
        """That example as an interactive session."""
        given_values = self.given_values(self.example.values)
        frame = self.example.hex
        cut = "" if len(frame) <= _SHOWN else f"[:{_SHOWN}]"
        call = Bracketed(f"{self.name}(", given_values, f").encode(){cut}.hex(' ')")
        return [*session(call, 4), f"'{frame[:_SHOWN].hex(' ')}'"]

    def given_values(self, values: dict[str, Any]) -> list[Part]:
        """The arguments that make the message of an example."""
        return [given(each, values[each.name], f"{each.name}=") for each in self.layout.arguments]

    def command_words(self, values: dict[str, Any]) -> list[str]:
        """The fields of an example as the command takes them: `targets=1:800,9:800`."""
        words: list[str] = []
        for argument in self.layout.arguments:
            value = values[argument.name]
            if isinstance(argument, Repeat):
                names = [field.name for field in argument.fields]
                parts = [
                    [str(item)] if argument.element is None else [str(item[name]) for name in names]
                    for item in value
                ]
                value = ",".join(":".join(part) for part in parts)
            words.append(f"{argument.name}={value}")
        return words

    @property
    def function(self) -> str:
        """The name of its strategy: `servo_move` for ServoMove."""
        return strategy_name(self.name)

    @property
    def strategy_declared(self) -> str:
        """The declaration of that function."""
        before = f"def {self.function}() -> SearchStrategy["
        return Bracketed(before, [self.name], "]:", comma="").fitted(0)

    @property
    def strategy(self) -> str:
        """The statement that makes its strategy."""
        if not self.arguments:
            return f"return st.just({self.name}())"
        numbers = [field.strategy_as(f"{field.name}=") for field in self.given]
        lists = [self.repeat.strategy] if self.repeat else []
        return Bracketed("return st.builds(", [self.name, *numbers, *lists], ")").fitted(4)

    @property
    def shape(self) -> str:
        """The description of its wire side, for the runtime."""
        items: list[Part] = [str(self.command), "LENGTHS"]
        if self.numbers:
            items.append(Bracketed("(", [each.described for each in self.numbers], ")", lone=","))
        if self.repeat:
            items.append(self._items(self.repeat))
        if self.narrowed:
            items.append("narrowed=True")
        return Bracketed("SHAPE: ClassVar = Shape(", items, ")").fitted(4)

    def _items(self, repeat: ListView) -> Bracketed:
        fields = Bracketed("(", [field.described for field in repeat.fields], ")", lone=",")
        items: list[Part] = [literal(repeat.name), fields, repeat.counts]
        items.append(f"counter={self.counter}")
        if repeat.element:
            items.append(f"element={repeat.element}")
        return Bracketed("Items(", items, ")")
