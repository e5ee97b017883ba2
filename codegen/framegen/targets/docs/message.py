"""The page of one message."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.explain.words import listed
from framewire.frame.pluralize import describe_range, pluralize

from framegen.model.exchanges import method_of
from framegen.targets.docs.address import message_page
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.drawing import Drawing, drawing
from framegen.targets.docs.errata import ErratumView, UnknownView, erratum_views, unknown_views
from framegen.targets.docs.escape import paragraphs
from framegen.targets.docs.examples import ExampleView, example_views
from framegen.targets.docs.field import FieldView, ValueView, address_values, field_views
from framegen.targets.docs.notes import NoteView, note_views
from framegen.targets.docs.strip import Cell, pattern_strip
from framegen.targets.docs.timing import milliseconds
from framegen.targets.docs.way import Way, way

if TYPE_CHECKING:
    from framegen.language.spec import Message
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.targets.target import Snippet, Snippets


# The roles of what a message holds besides its envelope.
_PARAMETERS = ("field", "count", "size", "text", "packed", "repeated")


@dataclass(frozen=True, slots=True)
class IdView:
    """One of the ids of a message; `hex` is as wide as in the frame."""

    name: str
    number: int
    hex: str
    is_sent: bool


@dataclass(frozen=True, slots=True)
class Usage:
    """How a target, such as Python, sends or receives a message."""

    target: str
    snippets: list[Snippet]

    @property
    def title(self) -> str:
        """What it is called in a heading."""
        return self.target.capitalize()


@dataclass(frozen=True)
class MessagePage:
    """The facts of one message, ready to be shown."""

    model: Model
    layout: MessageLayout
    snippets: Snippets

    @property
    def said(self) -> Message:
        """The message in the spec: name, summary, since and the like."""
        return self.layout.message

    @property
    def name(self) -> str:
        """The name, which is also the anchor."""
        return self.layout.name

    @property
    def page(self) -> str:
        """The page, from the root of the reference, without its suffix."""
        return message_page(self.name)

    @cached_property
    def ids(self) -> list[IdView]:
        """The ids of the message."""
        frame = self.layout.frame
        return [
            IdView(part.name, number, f"0x{number:0{2 * part.size}X}", part not in frame.unsent)
            for part, number in zip(frame.ids, self.layout.ids, strict=True)
        ]

    @property
    def hex(self) -> str:
        """The ids that a frame holds in hex, as wide as there."""
        return " ".join(each.hex for each in self.ids if each.is_sent)

    @property
    def number(self) -> str:
        """The ids that a frame holds, in decimal."""
        return ", ".join(str(each.number) for each in self.ids if each.is_sent)

    @property
    def frame(self) -> str:
        """The name of its envelope, where there are several."""
        return self.layout.frame.name if len(self.model.envelopes) > 1 else ""

    @property
    def address(self) -> str:
        """The name of the address, if its frames have one."""
        address = self.layout.frame.address
        return "" if address is None else address.name

    @property
    def direction(self) -> str:
        """The sender and the receiver."""
        return f"{self.layout.direction.sender} to {self.layout.direction.receiver}"

    @property
    def way(self) -> Way:
        """The direction, as it is shown."""
        return way(self.model, self.layout.direction)

    @property
    def kind(self) -> str:
        """The kind: command, query, reply or report."""
        return self.model.kind(self.name)

    @property
    def description(self) -> list[str]:
        """The description, a paragraph an item."""
        return paragraphs(self.said.description)

    @property
    def notes(self) -> list[NoteView]:
        """What other sources know of it."""
        return note_views(self.model.spec, self.said.notes)

    @property
    def receiver(self) -> str:
        """Who receives it."""
        return self.layout.direction.receiver

    @property
    def receiver_notes(self) -> list[NoteView]:
        """What is known of who receives it, which holds for every message to that end."""
        return note_views(self.model.spec, self.model.spec.endpoints[self.receiver].notes)

    @property
    def cite(self) -> CiteView:
        """The source of the message."""
        return cite_view(self.model.spec, self.said.cite)

    @property
    def place(self) -> Place:
        """The place of the message in the spec."""
        return Place(("messages", self.name))

    @property
    def errata(self) -> list[ErratumView]:
        """Where the documents are wrong about it."""
        return [each for each in erratum_views(self.model) if each.message == self.name]

    @property
    def unknowns(self) -> list[UnknownView]:
        """What no source says of it."""
        return [each for each in unknown_views(self.model) if each.message == self.name]

    @cached_property
    def values(self) -> list[ValueView]:
        """The values with a name: those of its address first, then those of its fields."""
        address = address_values(self.model, self.layout)
        return [*address, *(value for field in self.fields for value in field.values)]

    @property
    def bits(self) -> list[FieldView]:
        """The fields whose bits have names."""
        return [field for field in self.fields if field.bits]

    @property
    def method(self) -> str:
        """The method of a client that sends it, as the spec has it; empty where there is none."""
        if not self.sends:
            return ""
        method = method_of(self.name, self.said)
        address = [self.address] if self.address else []
        return f"{method.name}({', '.join([*address, *method.arguments])})"

    @property
    def answers(self) -> list[str]:
        """The requests that it answers."""
        return self.model.answers.get(self.name, [])

    @property
    def reports_on(self) -> list[str]:
        """The commands that it may follow."""
        return self.model.reports_on.get(self.name, [])

    @property
    def refuses(self) -> list[str]:
        """The requests that it refuses, where it comes instead of their reply."""
        return self.model.refuses.get(self.name, [])

    @property
    def silent(self) -> bool:
        """Whether nothing ever comes back."""
        asks = self.kind in ("command", "query")
        return asks and self.said.reply is None and not self.said.reports

    @property
    def posed(self) -> list[str]:
        """The methods for poses that send it besides its own."""
        pose = self.model.spec.pose
        if pose is None:
            return []
        found = {
            pose.read: [pose.present, pose.hold],
            pose.move: [pose.hold],
        }
        return found.get(self.name, [])

    @property
    def measure(self) -> str:
        """What the length rule gives: the length part by its name, or the size of the frame."""
        length = self.layout.frame.length_part
        return "size of the frame" if length is None else length.name

    @property
    def formula(self) -> str:
        """The length rule."""
        return self.lengths if self.layout.optional else str(self.layout.formula)

    @property
    def without_fields(self) -> str:
        """What is said where the fields would be, if there are none."""
        names = [slot.name for slot in self.layout.arguments]
        differ = f"frames differ in their {listed(names)} alone" if names else ""
        return f"None: {differ or 'the frame is always the same'}."

    @property
    def varies(self) -> bool:
        """Whether its frames have several lengths by a rule."""
        return self.layout.items is not None

    @property
    def repeats(self) -> bool:
        """Whether some of its bytes come again for each item of a list."""
        return any(cell.role == "repeated" for cell in self.cells)

    @property
    def lengths(self) -> str:
        """The legal lengths, in words."""
        return describe_range(self.layout.lengths)

    @property
    def largest(self) -> str:
        """The largest frame and its time on the wire."""
        size, layout = self.layout.largest, self.layout
        time = milliseconds(layout.wire_seconds(size))
        return f"{pluralize(size, 'byte')}, {time} at {layout.link.baud} baud"

    @cached_property
    def cells(self) -> list[Cell]:
        """The byte strip of any frame of the message."""
        return pattern_strip(self.model.protocol.messages[self.name])

    @property
    def parameters(self) -> list[Cell]:
        """The cells between the id and the end."""
        return [cell for cell in self.cells if cell.role in _PARAMETERS]

    @cached_property
    def fields(self) -> list[FieldView]:
        """The fields, in the order of the frame."""
        return field_views(self.model, self.layout)

    @cached_property
    def examples(self) -> list[ExampleView]:
        """The documented frames."""
        return example_views(self.model, self.layout)

    @property
    def sends(self) -> bool:
        """Whether the user of the library sends it, rather than receives it."""
        return self.layout.direction == self.model.roles.sent

    @property
    def usage(self) -> list[Usage]:
        """How each target sends or receives it; nothing where the spec has no example."""
        return [
            Usage(target, show(self.model, self.layout, example))
            for target, show in self.snippets.items()
            for example in self.said.examples[:1]
        ]

    @property
    def drawing(self) -> Drawing | None:
        """The sequence diagram of what follows it."""
        return drawing(self.model, self.name)
