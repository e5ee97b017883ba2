"""The reference as a whole: the protocol, its pages, and what all of them share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

from framegen.targets.docs.cite import CiteView, cite_view
from framegen.targets.docs.drawing import Drawing, interruption
from framegen.targets.docs.envelope import EnvelopeView
from framegen.targets.docs.errata import ErratumView, UnknownView, erratum_views, unknown_views
from framegen.targets.docs.escape import paragraphs
from framegen.targets.docs.examples import ExampleSequence, example_sequences
from framegen.targets.docs.lookalikes import LookalikeEntry, lookalike_views
from framegen.targets.docs.message import MessagePage
from framegen.targets.docs.notes import NoteView, note_views
from framegen.targets.docs.stream_examples import StreamExample, stream_examples
from framegen.targets.docs.stream_rules import StreamRules
from framegen.targets.docs.timing import (
    FrameTiming,
    RoundTrip,
    bytes_a_second,
    round_trips,
    timings,
)
from framegen.targets.docs.way import Way, way

if TYPE_CHECKING:
    from framegen.compile import Compiled
    from framegen.language.spec import HidBoard, Protocol, Release, Reserved, SourceDocument
    from framegen.model.model import Model
    from framegen.targets.target import Snippets

# What goes onto a page of A4, with room for the rest of the cheat sheet.
_LINES_A_PAGE, _PARAMETERS_A_LINE = 24, 4
# From docs/reference/<name> to the root of the project.
_TO_ROOT = "../../../"


@dataclass(frozen=True, slots=True)
class PageView:
    """One page: its name below the root, its template, title, link text and what it is about."""

    name: str
    template: str
    title: str
    label: str
    about: str
    in_markdown: bool = True
    message: MessagePage | None = None

    @property
    def html(self) -> str:
        """The file in HTML, from the root of the reference."""
        return f"{self.name}.html"

    @property
    def markdown(self) -> str:
        """The file in Markdown; forges show the README of a folder."""
        return "README.md" if self.name == "index" else f"{self.name}.md"

    @property
    def root(self) -> str:
        """The path from the page to the root of the reference."""
        return "../" * self.name.count("/")


@dataclass(frozen=True, slots=True)
class HidBoardView:
    """Boards that appear as a USB HID device, and the source of that."""

    said: HidBoard
    cite: CiteView | None

    @property
    def text(self) -> str:
        """The ids and report size, and a description."""
        text = f"{self.said.ids}, a frame in each report of {self.said.report_size} bytes"
        return f"{text}. {self.said.about}" if self.said.about else text


@dataclass(frozen=True, slots=True)
class EndpointView:
    """An end of the line: its part, and what else is known of it."""

    name: str
    about: str
    notes: list[NoteView]


@dataclass(frozen=True, slots=True)
class ReservedView:
    """A reserved id or name, and why it is reserved."""

    said: Reserved
    cite: CiteView | None

    @property
    def way(self) -> str:
        """The direction in which it is reserved, if only one."""
        way = self.said.direction
        return "" if way is None else f"{way.sender} to {way.receiver}"


@dataclass(frozen=True)
class ReferenceView:
    """The content of all pages."""

    compiled: Compiled
    snippets: Snippets
    # Where the spec lies, from the root of the reference in Markdown; "" where the project has it.
    spec_file: str = ""

    @property
    def model(self) -> Model:
        """The model of the protocol."""
        return self.compiled.model

    @property
    def protocol(self) -> Protocol:
        """The protocol's name, title, version and summary."""
        return self.model.spec.protocol

    @property
    def folder(self) -> str:
        """The folder of the pages, beside those of other protocols."""
        return self.protocol.name

    @property
    def spec(self) -> str:
        """The path of the spec, below the root of its project."""
        return self.compiled.source.path

    @property
    def spec_link(self) -> str:
        """The path from the root of the reference to the spec; empty where it lies elsewhere."""
        if self.spec_file:
            return self.spec_file
        return f"{_TO_ROOT}{self.spec}" if self.spec.startswith("spec/") else ""

    @property
    def description(self) -> list[str]:
        """The introduction, a paragraph an item."""
        return paragraphs(self.protocol.description)

    @property
    def notes(self) -> list[NoteView]:
        """What other sources know of the protocol."""
        return note_views(self.model.spec, self.protocol.notes)

    @property
    def shows(self) -> bool:
        """Whether it is known what the device shows of what it receives."""
        spec = self.model.spec
        return bool(spec.endpoints[self.model.roles.sent.receiver].notes)

    @property
    def endpoints(self) -> list[EndpointView]:
        """The endpoints, with their descriptions."""
        spec = self.model.spec
        return [
            EndpointView(name, each.about, note_views(spec, each.notes))
            for name, each in spec.endpoints.items()
        ]

    @property
    def sources(self) -> dict[str, SourceDocument]:
        """The sources that facts are cited from."""
        return self.model.spec.sources

    @property
    def link(self) -> str:
        """The settings of the serial line, as people write them."""
        link = self.model.spec.link
        letter = {"none": "N", "even": "E", "odd": "O"}[link.parity]
        return f"{link.baud} baud, {link.data_bits}{letter}{link.stop_bits}"

    @property
    def hid_boards(self) -> list[HidBoardView]:
        """The boards that have no serial port."""
        spec = self.model.spec
        return [
            HidBoardView(board, None if board.cite is None else cite_view(spec, board.cite))
            for board in spec.link.usb_hid
        ]

    @property
    def bytes_a_second(self) -> str:
        """The bytes a second that the line carries."""
        return bytes_a_second(self.model)

    @property
    def byte_order(self) -> str:
        """The byte order: little or big."""
        return self.model.spec.byte_order

    @cached_property
    def envelopes(self) -> list[EnvelopeView]:
        """Every kind of frame."""
        return [EnvelopeView(self.model, name) for name in self.model.envelopes]

    @property
    def ways(self) -> list[Way]:
        """The directions of its messages, as they are shown."""
        return [way(self.model, direction) for direction in self.model.directions]

    @property
    def id_name(self) -> str:
        """What identifies a message: `command`, say; or its name, where no one number does."""
        names = {part.name for frame in self.model.envelopes.values() for part in frame.ids}
        return names.pop() if len(names) == 1 else "id" if names else "name"

    @property
    def length_name(self) -> str:
        """What says how long a frame is: `length`, say; or its size."""
        lengths = (frame.length_part for frame in self.model.envelopes.values())
        return next((length.name for length in lengths if length is not None), "size")

    @property
    def has_ids(self) -> bool:
        """Whether any message has an id."""
        return any(message.ids for message in self.messages)

    @cached_property
    def stream(self) -> StreamRules:
        """How a stream is decoded."""
        return StreamRules(self.model)

    @cached_property
    def messages(self) -> list[MessagePage]:
        """Every message, in the order of the spec."""
        return [
            MessagePage(self.model, message, self.snippets)
            for message in self.model.messages.values()
        ]

    @cached_property
    def by_id(self) -> list[MessagePage]:
        """Every message, by id; where two share one, in the order of the spec."""
        return sorted(self.messages, key=lambda message: message.layout.ids)

    @property
    def fits_a_page(self) -> bool:
        """Whether the cheat sheet goes onto one page of A4."""
        parameters = sum(len(message.parameters) for message in self.messages)
        return len(self.messages) + parameters // _PARAMETERS_A_LINE <= _LINES_A_PAGE

    @cached_property
    def addresses(self) -> dict[str, str]:
        """The page of each message, in HTML."""
        return {message.name: f"{message.page}.html" for message in self.messages}

    @cached_property
    def example_sequences(self) -> list[ExampleSequence]:
        """Every documented frame, requests with what follows them."""
        return example_sequences(self.model)

    @cached_property
    def stream_examples(self) -> list[StreamExample]:
        """Examples of how a stream is decoded."""
        return stream_examples(self.model)

    @property
    def drawings(self) -> list[Drawing]:
        """Every sequence that has more than one message, and a report that interrupts one."""
        found = [message.drawing for message in self.messages]
        shown = [drawing for drawing in found if drawing and len(drawing.arrows) > 1]
        between = interruption(self.model)
        return [*shown, between] if between else shown

    @property
    def silent(self) -> list[str]:
        """The commands that nothing follows."""
        return [message.name for message in self.messages if message.silent]

    @property
    def timings(self) -> list[FrameTiming]:
        """The frame sizes and times of each message."""
        return timings(self.model)

    @property
    def round_trips(self) -> list[RoundTrip]:
        """The times of a request with its reply."""
        return round_trips(self.model)

    @cached_property
    def errata(self) -> list[ErratumView]:
        """The mistakes in the documents."""
        return erratum_views(self.model)

    @cached_property
    def unknowns(self) -> list[UnknownView]:
        """The questions that no source answers."""
        return unknown_views(self.model)

    @cached_property
    def lookalikes(self) -> list[LookalikeEntry]:
        """The protocols easily taken for this one."""
        return lookalike_views(self.model)

    @property
    def reserved(self) -> list[ReservedView]:
        """The reserved ids and names."""
        spec = self.model.spec
        return [
            ReservedView(
                reserved, None if reserved.cite is None else cite_view(spec, reserved.cite)
            )
            for reserved in spec.reserved
        ]

    @property
    def releases(self) -> list[Release]:
        """The history, the latest version first."""
        return self.model.spec.history

    @cached_property
    def pages(self) -> list[PageView]:
        """The pages in the navigation."""
        title = self.protocol.title
        # The decoder needs a script, the cheat sheet paper, and the spec is YAML: HTML alone.
        return [
            PageView("index", "index", title, "Frames", self.protocol.summary),
            PageView(
                "examples",
                "examples",
                "Examples, byte by byte",
                "Examples",
                f"Every documented frame of the {title}, with what comes back.",
            ),
            PageView(
                "decoder",
                "decoder",
                "Workbench",
                "Workbench",
                f"Decode captures of the {title}, make frames, and talk to a device.",
                in_markdown=False,
            ),
            PageView(
                "stream",
                "stream",
                "How the stream is decoded",
                "Stream",
                f"How frames of the {title} are told from noise.",
            ),
            PageView(
                "sequences",
                "sequences",
                "Sequences and timing",
                "Sequences",
                f"Which messages of the {title} follow which, and how long they take.",
            ),
            PageView(
                "errata",
                "errata",
                "Errata and unknowns",
                "Errata",
                f"Where the documents of the {title} are wrong, and what they leave open.",
            ),
            PageView(
                "lookalikes",
                "lookalikes",
                "Is this your protocol?",
                "Look-alikes",
                f"Protocols that are easily taken for the {title}.",
            ),
            PageView(
                "cheatsheet",
                "cheatsheet",
                "Cheat sheet",
                "Cheat sheet",
                f"The {title} on paper.",
                in_markdown=False,
            ),
            PageView(
                "changelog",
                "changelog",
                "Versions and changes",
                "Versions",
                f"What changed from version to version of the {title}, and what that breaks.",
            ),
            PageView(
                "downloads",
                "downloads",
                "Downloads",
                "Downloads",
                f"The spec, the test vectors and the pages of the {title} as files.",
                in_markdown=False,
            ),
            PageView(
                "spec",
                "spec",
                "The spec",
                "Spec",
                f"The {title} as data, of which all these pages are made.",
                in_markdown=False,
            ),
        ]

    @cached_property
    def message_pages(self) -> list[PageView]:
        """A page for each message."""
        return [
            PageView(
                message.page,
                "message",
                message.name,
                message.name,
                message.said.summary,
                message=message,
            )
            for message in self.messages
        ]
