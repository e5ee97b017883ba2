"""What the Python templates show: the layout in Python's words, ready to be put in place."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.codec import describe_range
from framegen.layout import Repeat, WireField
from framegen.names import PYTHON_BUILTINS, PYTHON_KEYWORDS
from framegen.spec import IdPart, LengthPart
from framegen.targets.python.escape import WIDTH, Bracketed, literal

if TYPE_CHECKING:
    from collections.abc import Iterable
    from typing import Any

    from framegen.layout import Layout, MessageLayout
    from framegen.spec import Example, Link, Spec
    from framegen.values import Citation, Direction

# What else every library exports, and the module that each is in: imported when it is asked for,
# because a user of the codec needs no port.
LAZY = {
    "AsyncController": "async_controller",
    "ClosedError": "link_errors",
    "Controller": "controller",
    "Device": "device",
    "DisconnectedError": "link_errors",
    "IncompleteReplyError": "link_errors",
    "NoReplyError": "link_errors",
    "NoReportError": "link_errors",
    "PortAddressError": "link_errors",
    "PortBusyError": "link_errors",
    "PortNotFoundError": "link_errors",
    "PortPermissionError": "link_errors",
    "Sent": "request",
    "Transport": "transport",
    "TransportError": "link_errors",
    "WriteStuckError": "link_errors",
    "open_async_controller": "async_opening",
    "open_controller": "opening",
    "open_transport": "serial_port",
}

# What every library exports besides its messages.
EXPORTED = (
    "MESSAGES",
    "Counters",
    "DecodeError",
    "Direction",
    "EncodeError",
    "Message",
    "Noise",
    "ProtocolError",
    "Reason",
    "StreamDecoder",
    "UnknownFrame",
    "__version__",
    "decode",
)

# What the function of a strategy cannot be called.
_TAKEN_FUNCTIONS = {"messages", "noise", "noisy_streams", "st", *PYTHON_KEYWORDS, *PYTHON_BUILTINS}


@dataclass(frozen=True, slots=True)
class Constant:
    """A named value, as a class attribute: `TIMES_UNLIMITED = 0`."""

    name: str
    value: int
    about: str


@dataclass(frozen=True, slots=True)
class NumberView:
    """A number: how it is described, checked and read."""

    layout: WireField
    spec: Spec

    @property
    def name(self) -> str:
        return self.layout.name

    @property
    def low(self) -> int:
        return self.layout.low

    @property
    def high(self) -> int:
        return self.layout.high

    @property
    def doc(self) -> list[str]:
        """What it is; its range, unit and scale; its named values; and what else is known of it."""
        field = self.layout.field
        unit = f" {field.unit}" if field.unit else ""
        scale = f", a step being {field.scale}" if field.scale else ""
        named = [f"{value.value} ({name}): {value.about}" for name, value in field.values.items()]
        notes = [
            f"{note.text} ({self.spec.sources[note.cite.source].title})" for note in field.notes
        ]
        return [field.about, f"{self.low}..{self.high}{unit}{scale}.", *named, *notes]

    @property
    def constants(self) -> list[Constant]:
        return [
            Constant(f"{self.name}_{name}".upper(), value.value, value.about)
            for name, value in self.layout.field.values.items()
        ]

    @property
    def read(self) -> str:
        """The expression that reads it from the frame."""
        start, end = self.layout.offset, self.layout.offset + self.layout.wire.size
        if self.layout.wire.name == "u8":
            return f"self._frame[{start}]"
        signed = ", signed=True" if self.layout.wire.low < 0 else ""
        return f'int.from_bytes(self._frame[{start}:{end}], "{self.spec.byte_order}"{signed})'

    @property
    def strategy(self) -> str:
        """Hypothesis's strategy for it."""
        return f"st.integers({self.low}, {self.high})"

    @property
    def described(self) -> Bracketed:
        """The call that describes it to the runtime."""
        field = self.layout.field
        items: list[str | Bracketed] = [literal(self.name), literal(self.layout.wire.code)]
        items += [str(self.low), str(self.high)]
        if field.unit:
            items.append(f"unit={literal(field.unit)}")
        if field.values:
            names = [f"{literal(name)}: {value.value}" for name, value in field.values.items()]
            items.append(Bracketed("names={", names, "}"))
        return Bracketed("Number(", items, ")")


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
    def element_doc(self) -> list[str]:
        return [f"One of the {self.name} of a message: a tuple ({self.names}) with names."]

    @property
    def types(self) -> str:
        """The types of its fields."""
        return ", ".join("int" for _ in self.layout.fields)

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
        element = items[0] if self.element is None else Bracketed("st.tuples(", items, ")")
        sizes = [f"min_size={self.layout.low}", f"max_size={self.layout.high}"]
        return Bracketed(f"{self.name}=st.lists(", [element, *sizes], ")")

    @property
    def snake(self) -> str:
        """The name of its element, for the functions that make and read one."""
        return snake_case(self.element or "")

    @property
    def maker(self) -> str:
        """The function that makes an element of a tuple."""
        name = f"_make_{self.snake}: Callable[[tuple[int, ...]], {self.element}]"
        items = ["tuple.__new__", str(self.element)]
        return Bracketed(f"{name} = partial(", items, ")").fitted(0)

    @property
    def read_as(self) -> str:
        """The type that reading it gives."""
        return f"tuple[{self.element or 'int'}, ...]"

    @property
    def read(self) -> str:
        """The expression that reads it from the frame."""
        data = f"self._frame[{self.layout.offset}:]"
        if self.element is not None:
            return f"tuple(map(_make_{self.snake}, _read_{self.snake}({data})))"
        if self.layout.fields[0].wire.name == "u8":
            return f"tuple({data})"
        return f"tuple(chain.from_iterable(iter_unpack({literal(self.codes)}, {data})))"

    @property
    def counts(self) -> str:
        return range_expression(range(self.layout.low, self.layout.high + 1))

    @property
    def bounds(self) -> str:
        return f"{self.layout.low}..{self.layout.high}"

    @property
    def given_as(self) -> str:
        """The type of the argument."""
        if self.element is None:
            return "Iterable[int]"
        return f"Iterable[tuple[{self.types}]]"

    @property
    def doc(self) -> list[str]:
        """What it is, how many there can be, and what else is known of it."""
        field = self.layout.field
        notes = [
            f"{note.text} ({self.spec.sources[note.cite.source].title})" for note in field.notes
        ]
        return [field.about, f"{self.bounds} of them.", *notes]


@dataclass(frozen=True, slots=True)
class MessageView:
    """One message class."""

    layout: MessageLayout
    whole: Layout

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
        title = self.whole.spec.sources[cite.source].title
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
        return [NumberView(field, self.whole.spec) for field in self.layout.numbers]

    @property
    def given(self) -> list[NumberView]:
        """The numbers that a user gives."""
        return [
            NumberView(field, self.whole.spec)
            for field in self.layout.arguments
            if isinstance(field, WireField)
        ]

    @property
    def repeat(self) -> ListView | None:
        repeat = self.layout.repeat
        return None if repeat is None else ListView(repeat, self.whole.spec)

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
        lists = [f"{self.repeat.name}: {self.repeat.given_as}"] if self.repeat else []
        return Bracketed("def __init__(", ["self", *numbers, *lists], ") -> None:").fitted(4)

    @property
    def values(self) -> str:
        """What the constructor was given: the numbers, and the list."""
        numbers = f"({_items([field.name for field in self.given])})"
        return f"{numbers}, {self.repeat.name}" if self.repeat else numbers

    @property
    def example(self) -> Example | None:
        """The shortest example, for the docstring."""
        return min(self.layout.message.examples, key=lambda example: len(example.hex), default=None)

    @property
    def example_lines(self) -> list[str]:
        """That example as an interactive session."""
        if self.example is None:
            return []
        call = f">>> {self.call(self.example.values)}.encode().hex(' ')"
        return [call, f"'{self.example.hex.hex(' ')}'"]

    def call(self, values: dict[str, Any]) -> str:
        """The call that makes the message of an example."""
        return f"{self.name}({', '.join(self.given_values(values))})"

    def given_values(self, values: dict[str, Any]) -> list[str]:
        """The arguments of that call."""
        return [f"{argument.name}={_shown(argument, values)}" for argument in self.layout.arguments]

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
        name = snake_case(self.name)
        return f"{name}_" if name in _TAKEN_FUNCTIONS else name

    @property
    def strategy(self) -> str:
        """The statement that makes its strategy."""
        if not self.arguments:
            return f"return st.just({self.name}())"
        numbers = [f"{field.name}={field.strategy}" for field in self.given]
        lists = [self.repeat.strategy] if self.repeat else []
        return Bracketed("return st.builds(", [self.name, *numbers, *lists], ")").fitted(4)

    @property
    def shape(self) -> str:
        """The description of its wire side, for the runtime."""
        items: list[str | Bracketed] = [str(self.command), "LENGTHS"]
        if self.numbers:
            items.append(Bracketed("(", [each.described for each in self.numbers], ")", lone=","))
        if self.repeat:
            items.append(self._items(self.repeat))
        if self.narrowed:
            items.append("narrowed=True")
        return Bracketed("SHAPE: ClassVar = Shape(", items, ")").fitted(4)

    def _items(self, repeat: ListView) -> Bracketed:
        fields = Bracketed("(", [field.described for field in repeat.fields], ")", lone=",")
        items: list[str | Bracketed] = [literal(repeat.name), fields, repeat.counts]
        items.append(f"counter={self.counter}")
        if repeat.element:
            items.append(f"element={repeat.element}")
        return Bracketed("Items(", items, ")")


@dataclass(frozen=True, slots=True)
class DirectionView:
    """One member of the Direction enumeration."""

    direction: Direction

    @property
    def member(self) -> str:
        return direction_member(self.direction)

    @property
    def value(self) -> str:
        return literal(self.direction.key)

    @property
    def sender(self) -> str:
        return self.direction.sender

    @property
    def receiver(self) -> str:
        return self.direction.receiver


@dataclass(frozen=True, slots=True)
class VerbView:
    """A verb of the command, and the lines of its examples."""

    verb: str
    examples: list[str]

    @property
    def name(self) -> str:
        return literal(self.verb)


@dataclass(frozen=True, slots=True)
class LibraryView:
    """The library as a whole."""

    layout: Layout

    @property
    def version(self) -> str:
        return self.layout.spec.protocol.version

    @property
    def package(self) -> str:
        return self.layout.spec.protocol.name

    @property
    def directions(self) -> list[DirectionView]:
        return [DirectionView(direction) for direction in self.layout.directions]

    @property
    def messages(self) -> list[MessageView]:
        return [MessageView(message, self.layout) for message in self.layout.messages.values()]

    @property
    def elements(self) -> list[ListView]:
        """The lists whose elements have a class of their own."""
        lists = [message.repeat for message in self.messages]
        return [repeat for repeat in lists if repeat is not None and repeat.element is not None]

    @property
    def imports(self) -> list[str]:
        """What the messages need of the standard library, by what their lists are read with."""
        chained = any(
            "chain." in message.repeat.read for message in self.messages if message.repeat
        )
        structs = [*(["Struct"] if self.elements else []), *(["iter_unpack"] if chained else [])]
        wanted = {
            "functools": ["partial"] if self.elements else [],
            "itertools": ["chain"] if chained else [],
            "struct": structs,
        }
        return [f"from {module} import {', '.join(n)}" for module, n in wanted.items() if n]

    @property
    def typing_imports(self) -> list[str]:
        """What the annotations of the messages need of the standard library."""
        lists = any(message.repeat for message in self.messages)
        fields = [field for message in self.messages for field in message.given]
        fields += [field for element in self.elements for field in element.fields]
        wanted: dict[str, dict[str, object]] = {
            "collections.abc": {"Callable": self.elements, "Iterable": lists},
            "typing": {"ClassVar": True, "Final": any(field.constants for field in fields)},
        }
        found = {
            module: [name for name, needed in names.items() if needed]
            for module, names in wanted.items()
        }
        return [f"from {module} import {', '.join(n)}" for module, n in found.items() if n]

    @property
    def from_fields(self) -> list[str]:
        """What describes and takes in the fields."""
        lists = any(message.repeat for message in self.messages)
        numbers = any(message.numbers for message in self.messages)
        names = {"Items": lists, "Number": numbers}
        return [name for name, needed in names.items() if needed]

    @property
    def _from_messages(self) -> list[str]:
        names = {message.name for message in self.messages}
        names |= {element.element for element in self.elements if element.element is not None}
        return sorted(names)

    @property
    def import_messages(self) -> str:
        names = sorted(["MESSAGES", *self._from_messages], key=_export_order)
        return _import("messages", names)

    @property
    def import_message_classes(self) -> str:
        return _import("messages", sorted(message.name for message in self.messages))

    @property
    def exported(self) -> list[str]:
        """Every name that the package exports, in the order that linters want."""
        return sorted([*EXPORTED, *LAZY, *self._from_messages], key=_export_order)

    @property
    def doc(self) -> list[str]:
        """The docstring of the package."""
        protocol = self.layout.spec.protocol
        return [f"{protocol.title}.", protocol.summary, protocol.description]

    @property
    def command_summary(self) -> str:
        """What the command is for."""
        return f"Encode and decode the frames of: {self.layout.spec.protocol.title}."

    @property
    def decode_examples(self) -> list[str]:
        """Command lines for the help of `decode`, each with what it does."""
        program, sender = self.package, self.layout.directions[0].sender
        frame = next(m.example.hex for m in self.messages if m.example)
        hex_ = frame.hex(" ").upper()
        examples = [
            (f"{program} decode {hex_}", "bytes in hex, however they are written"),
            (f"{program} decode line.bin", "a recording, raw or in hex"),
            (f"{program} decode --direction {sender} -", "what arrives on standard input"),
            (f"{program} decode --json line.bin", "a line of JSON for each message and noise"),
        ]
        return _pairs(examples)

    @property
    def encode_examples(self) -> list[str]:
        """Command lines for the help of `encode`: an example of each shape of message."""
        shapes: dict[tuple[bool, bool], tuple[str, str]] = {}
        for message in self.messages:
            if message.example is not None:
                words = message.command_words(message.example.values)
                line = " ".join([self.package, "encode", message.name, *words])
                shape = bool(message.given), message.repeat is not None
                shapes.setdefault(shape, (line, message.layout.message.summary))
        return _pairs(shapes.values())

    @property
    def line_verbs(self) -> list[VerbView]:
        """The verbs that have to do with a port."""
        return [VerbView(name, lines) for name, lines in self._line_examples.items()]

    @property
    def _line_examples(self) -> dict[str, list[str]]:
        """Command lines for the help of the verbs that have to do with a port."""
        program = self.package
        sent = [
            (f"{program} send --port COM7 {' '.join([message.name, *words])}", summary)
            for message in self.messages
            if message.example is not None and message.layout.direction == self.layout.directions[0]
            for words in [message.command_words(message.example.values)]
            for summary in [message.layout.message.summary]
        ]
        return {
            "monitor": _pairs(
                [
                    (f"{program} monitor --port COM7", "every frame and all noise"),
                    (f"{program} monitor --port COM7 -t delta -n 5", "five, and their distances"),
                    (f"{program} monitor --port COM7 --only noise", "what is no frame"),
                    (f"{program} monitor --port COM7 --log line.hex", "kept for `decode`"),
                ]
            ),
            "ports": _pairs(
                [
                    (f"{program} ports", "the name, VID:PID and description of each"),
                    (f"{program} ports --json", "a line of JSON for each"),
                ]
            ),
            "send": _pairs(sent[:4]),
            "simulate": _pairs(
                [
                    (f"{program} simulate", "a board behind a port, whose name is printed first"),
                    (f"{program} simulate --help", "what else it can do"),
                ]
            ),
        }

    @property
    def link(self) -> Link:
        return self.layout.spec.link

    @property
    def byte_order(self) -> str:
        return self.layout.spec.byte_order

    @property
    def struct_order(self) -> str:
        return struct_order(self.byte_order)

    @property
    def header(self) -> str:
        return 'b"' + "".join(f"\\x{byte:02x}" for byte in self.layout.frame.header) + '"'

    @property
    def head(self) -> list[str]:
        """The expressions whose sum is the head of a frame."""
        terms: list[str] = []
        frame = self.layout.frame
        for part in self.layout.spec.frame.values():
            if isinstance(part, LengthPart):
                terms.append(f'length.to_bytes({frame.length.size}, "{self.byte_order}")')
            elif isinstance(part, IdPart):
                terms.append(f'command.to_bytes({frame.id.size}, "{self.byte_order}")')
        return terms


def range_expression(numbers: range) -> str:
    """A range as Python writes it, with nothing that goes without saying."""
    if numbers.step != 1:
        return f"range({numbers.start}, {numbers.stop}, {numbers.step})"
    return f"range({numbers.start}, {numbers.stop})" if numbers.start else f"range({numbers.stop})"


def struct_order(byte_order: str) -> str:
    """The byte order as `struct` writes it."""
    return "<" if byte_order == "little" else ">"


def direction_member(direction: Direction) -> str:
    """The name of a direction in the enumeration: `HOST_TO_CONTROLLER`."""
    return direction.key.upper()


def snake_case(name: str) -> str:
    """`ServoMove` as `servo_move`."""
    return re.sub(r"(?<=[a-z0-9])(?=[A-Z])|(?<=[A-Z])(?=[A-Z][a-z])", "_", name).lower()


def _pairs(examples: Iterable[tuple[str, str]]) -> list[str]:
    """Command lines and what they do, as the lines of a tuple."""
    return [
        Bracketed("(", [literal(line), literal(what)], "),").fitted(8) for line, what in examples
    ]


def _items(names: list[str]) -> str:
    """Names as the inside of a tuple."""
    return ", ".join(names) + ("," if len(names) == 1 else "")


def _import(module: str, names: list[str]) -> str:
    line = f"from .{module} import {', '.join(names)}"
    if len(line) <= WIDTH:
        return line
    return f"from .{module} import (\n" + "".join(f"    {name},\n" for name in names) + ")"


def _export_order(name: str) -> tuple[int, str]:
    kind = 0 if name.isupper() else 1 if name[0].isupper() else 2
    return kind, name


def _shown(argument: WireField | Repeat, values: dict[str, Any]) -> str:
    """A value of an example as an argument: elements as tuples, in the order of the frame."""
    value = values[argument.name]
    if isinstance(argument, WireField) or argument.element is None:
        return str(value)
    names = [field.name for field in argument.fields]
    elements = [tuple(item[name] for name in names) for item in value]
    return f"[{', '.join(str(element) for element in elements)}]"
