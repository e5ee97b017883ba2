"""A message as the templates show it: its class, its strategy, its examples."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.frame.pluralize import describe_range

from framegen.language.formula import Sizes
from framegen.model.codec import encode
from framegen.model.slots import Constant, Items, Number, Packed, Text
from framegen.targets.python.at_once import is_packed_at_once
from framegen.targets.python.escape import (
    Bracketed,
    Part,
    Sum,
    byte_literal,
    literal,
    session,
)
from framegen.targets.python.list_view import ListView, given
from framegen.targets.python.names import envelope_name, id_names, strategy_name
from framegen.targets.python.notes import noted
from framegen.targets.python.number_view import AbsentView, NumberView, absent_view
from framegen.targets.python.spelling import direction_member, range_expression, struct_order
from framegen.targets.python.text_view import (
    PackedView,
    TextView,
    constant_classes,
    constants_call,
)

if TYPE_CHECKING:
    from typing import Any, TypeAlias

    from framegen.language.spec import Example
    from framegen.language.values import Citation
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.model.slots import Field

    FieldView: TypeAlias = NumberView | TextView | PackedView | ListView


_WORD = re.compile(r"\w+")
# What has a meaning to the command, or to a shell.
_SPECIAL = re.compile(r"[^\w.+/@-]", re.ASCII)
# The classes of floating-point numbers.
_FLOATS = ("F32", "F64")
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
        """The summary, and a paragraph for each further fact."""
        message, frame, formula = self.layout.message, self.layout.frame, self.layout.formula
        found = [message.summary, message.description, *noted(message.notes, self.model.spec)]
        if message.deprecated:
            found.append(f"Deprecated: {message.deprecated}")
        if message.reply and message.reply not in _WORD.findall(message.description):
            found.append(f"Answered by {message.reply}.")
        named = zip(frame.ids, self.layout.ids, strict=True)
        facts = [f"{part.name} {number} (0x{number:02X})" for part, number in named]
        facts.append(f"{self.layout.direction.sender} to {self.layout.direction.receiver}")
        lengths = f"{frame.length_part.name if frame.length_part else 'size'} {formula}"
        if isinstance(self.layout.lengths, range) and formula.factor:
            lengths += f": {describe_range(self.layout.lengths)}"
        text = ", ".join([*facts, lengths])
        found.append(f"{text[0].upper()}{text[1:]}. Source: {self.cited(message.cite)}.")
        return found

    def cited(self, cite: Citation) -> str:
        title = self.model.spec.sources[cite.source].title
        return f"{title}, {cite.place}" if cite.place else title

    @property
    def vendor_name(self) -> str:
        return self.layout.message.vendor_name

    @property
    def deprecated(self) -> str:
        return self.layout.message.deprecated

    @property
    def id_constants(self) -> list[str]:
        """The assignments of its ids: one by itself is its command."""
        named = zip(id_names(self.layout.frame), self.layout.ids, strict=False)
        return [f"{name} = {number}" for name, number in named]

    @property
    def ids(self) -> str:
        """All its ids, as a tuple."""
        return Bracketed("IDS = (", [str(each) for each in self.layout.ids], ")", lone=",").fitted(
            4
        )

    @property
    def envelope(self) -> str:
        """The constant that is its envelope."""
        return envelope_name(self.layout.frame.name)

    @property
    def direction(self) -> str:
        return direction_member(self.layout.direction)

    @property
    def lengths(self) -> str:
        """The legal lengths, as an expression: a range, or a tuple where they are listed."""
        lengths = self.layout.lengths
        if isinstance(lengths, range):
            return range_expression(lengths)
        return Bracketed("(", [str(each) for each in lengths], ")", lone=",").fitted(
            4, last="LENGTHS = "
        )

    @property
    def defaults(self) -> str:
        """What may be left out, with what it is then; empty where there is nothing."""
        found = [
            Bracketed("(", [literal(each.name), "None" if each.slot.optional else "0"], ")")
            for each in self.numbers
            if each.slot.optional or each.slot.role == "counter"
        ]
        return Bracketed("DEFAULTS = (", found, ")", lone=",").fitted(4) if found else ""

    @property
    def fixed_bytes(self) -> str:
        """The assignment of the bytes that nobody gives; empty where it has none."""
        return constants_call(self._fixed)

    @property
    def _fixed(self) -> list[Constant]:
        return [slot for slot in self.layout.body if isinstance(slot, Constant)]

    @property
    def fields(self) -> list[FieldView]:
        """The fields in the order of the frame, the count among them; address and counter first."""
        return [self._view(slot) for slot in (*self.layout.frame.given, *self.layout.fields)]

    @property
    def arguments(self) -> list[FieldView]:
        """The fields that a user gives."""
        return [self._view(slot) for slot in self.layout.arguments]

    @property
    def classes(self) -> dict[str, str]:
        """The classes that declare its fields and constants, each with its module."""
        found = constant_classes(self._fixed)
        for field in self.fields:
            found |= field.classes
            if isinstance(field, ListView) and field.element is not None:
                found |= constant_classes(field.element.fixed)
                for inner in field.fields:
                    found |= inner.classes
        return found

    def _view(self, slot: Field) -> FieldView:
        return field_view(slot, self.model, self.layout)

    @property
    def numbers(self) -> list[NumberView]:
        """The numbers that a user gives."""
        return [each for each in self.arguments if isinstance(each, NumberView)]

    @property
    def items(self) -> ListView | None:
        """The list of a size that varies, where it has one."""
        view = None if self.layout.items is None else self._view(self.layout.items)
        return view if isinstance(view, ListView) else None

    @property
    def columns(self) -> ListView | None:
        """The list that can be read as columns: of elements that are all whole numbers."""
        items = self.items
        if items is None or items.element is None or items.element.base != "Element":
            return None
        return items

    @property
    def absent(self) -> AbsentView | None:
        """The property that tells whether there is nothing to report, where there is one."""
        return absent_view(self.numbers)

    @property
    def match_args(self) -> str:
        names = [literal(each.name) for each in self.arguments]
        return Bracketed("__match_args__ = (", names, ")", lone=",").fitted(4)

    @property
    def signature(self) -> str:
        """The declaration of the constructor; a running number is given by its name."""
        found: list[Part] = ["cls"]
        for slot, each in zip(self.layout.arguments, self.arguments, strict=True):
            found += ["*"] if slot is self.layout.frame.counter else []
            found.append(each.argument)
        return Bracketed("def __new__(", found, ") -> typing.Self:").fitted(4)

    # How its frame is packed.

    @property
    def checked(self) -> str:
        """The line that checks its numbers; empty where it is given none."""
        names = [each.name for each in self.numbers if not each.slot.optional]
        return Bracketed("cls.SHAPE.check(", names, ")").fitted(8) if names else ""

    @property
    def flat(self) -> str:
        """The bytes of what varies in size, as an expression; empty where nothing does."""
        if self.layout.optional:
            names = [each.name for each in self.layout.optional]
            return Bracketed("flat = cls.SHAPE.tail(", names, ")").fitted(8)
        items = self.layout.items
        if items is None:
            return ""
        return Bracketed(f"flat = cls.{items.name}.packed(", [items.name], ")").fitted(8)

    @property
    def sealed_packing(self) -> str:
        """The arguments of the call that packs its frame and seals it: format and values."""
        layout, values = self._packed_values()
        text = f"f{literal(layout)}" if "{" in layout else literal(layout)
        call = "return cls._packed("
        packed: list[Part] = [text, *values]
        return Bracketed(call, packed, ")").fitted(8).removeprefix(call).removesuffix(")")

    def _packed_values(self) -> tuple[str, list[str]]:
        layout, values = struct_order(self.model.spec.byte_order), []
        flat_at = self.layout.optional[:1] or (self.layout.items,)
        for slot in self.layout.slots:
            if slot in self.layout.optional[1:]:
                continue
            if slot in flat_at:
                layout += "{len(flat)}s"
                values.append("flat")
                continue
            notation, value = self._packed_slot(slot)
            layout += notation
            values += [value] if value else []
        return layout, values

    def _packed_slot(self, slot: Any) -> tuple[str, str]:
        """Return what `struct` packs a slot as, and the expression; for zeros there is none."""
        if isinstance(slot, Constant):
            if not any(slot.data):
                return _zeros(slot.size), ""
            return f"{slot.size}s", byte_literal(slot.data)
        if not isinstance(slot, Number) or slot.given:
            view = self._view(slot)
            return view.notation, view.packed
        if slot.role == "checksum":
            return _zeros(slot.size), ""
        view = NumberView(slot, self.model.spec)
        if slot.role == "id":
            return self._known(slot, view, str(self.layout.id_of(slot)), self.layout.id_of(slot))
        return self._known(slot, view, self._derived(slot), self._constant(slot))

    def _derived(self, slot: Number) -> str:
        """Return the expression of a length or a count."""
        items, formula = self.layout.items, self.layout.formula
        if slot.role == "length":
            if isinstance(formula, Sizes):
                there = self.layout.size_at(0) - self.layout.frame.tail_size
                return _plus("len(flat)", formula.constant - there + self.layout.optional[0].at)
            return _plus("len(flat)", formula.constant) if formula.factor else str(formula)
        size = 1 if items is None else items.size
        return "len(flat)" if slot.role == "size" or size == 1 else f"len(flat) // {size}"

    def _constant(self, slot: Number) -> int | None:
        """Return the value of a length that is always the same."""
        formula = self.layout.formula
        is_fixed = slot.role == "length" and not isinstance(formula, Sizes) and not formula.factor
        return formula.constant if is_fixed else None

    def _known(
        self, slot: Number, view: NumberView, expression: str, value: int | None
    ) -> tuple[str, str]:
        """Return the notation and the expression of a number that is derived."""
        if view.notation == slot.number_type.code:
            return view.notation, expression
        if value is not None:
            return f"{slot.size}s", byte_literal(slot.write(value))
        signed = ", signed=True" if slot.number_type.low < 0 else ""
        brackets = (
            expression if expression.endswith(")") and " " not in expression else f"({expression})"
        )
        return f"{slot.size}s", f'{brackets}.to_bytes({slot.size}, "{slot.order}"{signed})'

    @property
    def at_once(self) -> bool:
        """Whether `struct` packs what is given at once."""
        return is_packed_at_once(self.layout, self.model.spec.byte_order)

    @property
    def packing(self) -> str:
        """The arguments of the call that packs its frame at once: format, head and fields."""
        head = [self._in_front(slot) for slot in self.layout.frame.head]
        fields = [slot.name for slot in self.layout.fields if isinstance(slot, Number)]
        items: list[Part] = [
            Sum(self._notation),
            Bracketed("(", head, ")", lone=","),
            Bracketed("(", fields, ")", lone=","),
            *([] if self.layout.items is None else ["flat"]),
        ]
        call = "return cls._packed_at_once("
        return Bracketed(call, items, ")").fitted(8).removeprefix(call).removesuffix(")")

    @property
    def _notation(self) -> list[str]:
        """The format of its slots for `struct`; those of the list once for each element."""
        fixed, listed = struct_order(self.model.spec.byte_order), []
        for slot in self.layout.slots:
            if isinstance(slot, Constant):
                fixed += f"{slot.size}s"
            elif isinstance(slot, Number):
                fixed += slot.number_type.code
            elif isinstance(slot, Items):
                numbers = (each for each in slot.fields if isinstance(each, Number))
                codes = "".join(each.number_type.code for each in numbers)
                listed = [f"{slot.counters[0].name} * {literal(codes)}"]
        return [literal(fixed), *listed]

    def _in_front(self, slot: Constant | Number) -> str:
        """Return the packed expression for a slot of the envelope."""
        if isinstance(slot, Constant):
            return byte_literal(slot.data)
        return str(self.layout.formula if slot.role == "length" else self.layout.id_of(slot))

    @property
    def example(self) -> Example:
        """The shortest example, for the docstring."""
        return min(self.layout.message.examples, key=lambda example: len(example.hex))

    @property
    def example_lines(self) -> list[str]:
        """That example as an interactive session."""
        given_values = self.given_values(self.example.values)
        # Reserved bytes of a frame that was recorded may be others than those that are written.
        frame = encode(self.layout, self.example.values)
        cut = "" if len(frame) <= _SHOWN else f"[:{_SHOWN}]"
        call = Bracketed(f"{self.name}(", given_values, f").encode(){cut}.hex(' ')")
        return [*session(call, 4), f"'{frame[:_SHOWN].hex(' ')}'"]

    def given_values(self, values: dict[str, Any]) -> list[Part]:
        """Return the arguments that make the message of an example."""
        return [
            given(each, values[each.name], f"{each.name}=")
            for each in self.layout.arguments
            if values[each.name] is not None and (each.role != "counter" or values[each.name])
        ]

    def command_words(self, values: dict[str, Any]) -> list[str]:
        """Return the fields of an example as the command accepts them: `targets=1:800,9:800`."""
        found: list[str] = []
        for argument in self.layout.arguments:
            value = values[argument.name]
            if value is None or (argument.role == "counter" and not value):
                continue
            if isinstance(argument, Items) and not argument.text and argument.element is not None:
                names = [field.name for field in argument.fields]
                parts = [":".join(_word(item[name]) or "%00" for name in names) for item in value]
            elif isinstance(argument, Items | Packed) and not isinstance(value, str):
                parts = [_word(item) for item in value]
            else:
                parts = [_word(value)]
            found.append(f"{argument.name}={','.join(parts)}")
        return found

    @property
    def function(self) -> str:
        """The name of its strategy: `servo_move` for ServoMove."""
        return strategy_name(self.name)

    @property
    def strategy_declared(self) -> str:
        """The declaration of its strategy."""
        if not self.floats:
            before = f"def {self.function}() -> SearchStrategy["
            return Bracketed(before, [self.name], "]:", comma="").fitted(0)
        given: list[Part] = ["*", "allow_nan: bool = False"]
        after = f") -> SearchStrategy[{self.name}]:"
        return Bracketed(f"def {self.function}(", given, after).fitted(0)

    @property
    def floats(self) -> bool:
        """Whether any of its numbers is a floating-point one."""
        return any(name.removeprefix("Swapped") in _FLOATS for name in self.classes)

    @property
    def passed_nan(self) -> str:
        """What its strategy passes on, where it may generate what is no number."""
        return ", allow_nan=allow_nan" if self.floats else ""


def field_view(slot: Field, model: Model, layout: MessageLayout) -> FieldView:
    """Return a field of a message as the templates show it."""
    spec, tail = model.spec, layout.frame.tail_size
    match slot:
        case Items() if slot.text:
            return TextView(slot, spec, tail)
        case Items():
            return ListView(slot, spec, tail)
        case Text():
            return TextView(slot, spec)
        case Packed():
            return PackedView(slot, spec)
        case Number():
            return NumberView(slot, spec, tail)


def _word(value: Any) -> str:
    """Return a value as a word for the command; what has a meaning to a shell is escaped."""
    if not isinstance(value, str):
        return str(value)
    return _SPECIAL.sub(lambda found: f"%{ord(found[0]):02X}", value)


def _zeros(size: int) -> str:
    """Return the notation of so many zeros."""
    return "x" if size == 1 else f"{size}x"


def _plus(expression: str, constant: int) -> str:
    return f"{expression} + {constant}" if constant else expression
