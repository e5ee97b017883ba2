"""One message as its page shows it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.pluralize import describe_range
from framegen.targets.docs.address import message_page
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.drawing import Drawing, drawing
from framegen.targets.docs.escape import paragraphs
from framegen.targets.docs.examples import ExampleView, example_views
from framegen.targets.docs.field import FieldView, field_views
from framegen.targets.docs.strip import Cell, pattern_strip
from framegen.targets.docs.timing import milliseconds

if TYPE_CHECKING:
    from framegen.language.spec import Message
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.targets.target import Snippets


@dataclass(frozen=True)
class MessagePage:
    """The facts of one message, each ready to be shown."""

    model: Model
    layout: MessageLayout
    snippets: Snippets

    @property
    def said(self) -> Message:
        """What the spec says of it: name, summary, since and the like."""
        return self.layout.message

    @property
    def name(self) -> str:
        """Its name, which is also its anchor."""
        return self.layout.name

    @property
    def page(self) -> str:
        """Its page, from the root of the reference, whatever it is written in."""
        return message_page(self.name)

    @property
    def id(self) -> int:
        """The id of the message."""
        return self.layout.id

    @property
    def hex(self) -> str:
        """Its id in hex, as wide as the frame has it."""
        return f"0x{self.id:0{2 * self.layout.frame.id.size}X}"

    @property
    def direction(self) -> str:
        """Who sends it to whom."""
        return f"{self.layout.direction.sender} to {self.layout.direction.receiver}"

    @property
    def kind(self) -> str:
        """Command, query, reply or report."""
        return self.model.kind(self.name)

    @property
    def description(self) -> list[str]:
        """Its description, a paragraph an item."""
        return paragraphs(self.said.description)

    @property
    def cite(self) -> CiteView:
        """Where it is known from."""
        return cite_view(self.model.spec, self.said.cite)

    @property
    def place(self) -> Place:
        """Where the spec says all this."""
        return Place(("messages", self.name))

    @property
    def answers(self) -> list[str]:
        """The requests that it answers."""
        return self.model.answers.get(self.name, [])

    @property
    def reports_on(self) -> list[str]:
        """The commands that it may follow."""
        return self.model.reports_on.get(self.name, [])

    @property
    def silent(self) -> bool:
        """Whether nothing ever comes back."""
        asks = self.kind in ("command", "query")
        return asks and self.said.reply is None and not self.said.reports

    @property
    def posed(self) -> list[str]:
        """The methods of a client that send it besides its own."""
        pose = self.model.spec.pose
        if pose is None:
            return []
        found = {
            pose.read: [pose.present, pose.hold],
            pose.move: [pose.hold],
        }
        return found.get(self.name, [])

    @property
    def formula(self) -> str:
        """The length rule."""
        return f"{self.layout.frame.length.name} = {self.layout.formula}"

    @property
    def lengths(self) -> str:
        """The legal lengths, in words."""
        return describe_range(self.layout.lengths)

    @property
    def largest(self) -> str:
        """The largest frame and its time on the wire."""
        size, layout = self.layout.largest, self.layout
        return f"{size} bytes, {milliseconds(layout.wire_seconds(size))} at {layout.link.baud} baud"

    @cached_property
    def cells(self) -> list[Cell]:
        """What every frame of it looks like."""
        return pattern_strip(self.layout)

    @property
    def parameters(self) -> list[Cell]:
        """Of those cells, the ones between the id and the end."""
        return [cell for cell in self.cells if cell.role in ("field", "count", "repeated")]

    @cached_property
    def fields(self) -> list[FieldView]:
        """Its fields, in the order of the frame."""
        return field_views(self.model, self.layout)

    @cached_property
    def examples(self) -> list[ExampleView]:
        """Its documented frames."""
        return example_views(self.model, self.layout)

    @property
    def sends(self) -> bool:
        """Whether the user of the library sends it, rather than receives it."""
        return self.layout.direction == self.model.roles.sent

    @property
    def snippet(self) -> str:
        """Python that sends or receives it; empty where the spec has no example."""
        show = self.snippets.get("python")
        if show is None or not self.said.examples:
            return ""
        return show(self.model, self.layout, self.said.examples[0])

    @property
    def drawing(self) -> Drawing | None:
        """What it sets off, as a picture."""
        return drawing(self.model, self.name)

    @property
    def words(self) -> str:
        """What a search finds it by, in lower case."""
        names = [field.path.replace("[i]", "") for field in self.fields]
        return " ".join(
            [self.name, self.said.vendor_name, self.kind, self.direction, *names]
        ).lower()

    @property
    def id_spellings(self) -> str:
        """Its id in every way that people write it."""
        digits = self.hex.removeprefix("0x").lower()
        return " ".join(dict.fromkeys([str(self.id), digits, f"0x{digits}", f"0x{self.id:x}"]))
