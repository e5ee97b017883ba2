"""Documented frames, alone and as a request with what may come back."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.targets.docs.address import message_page
from framegen.targets.docs.cite import CiteView, Place, cite_view
from framegen.targets.docs.strip import Cell, frame_strip

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model


# More bytes of an example than this are not on the cheat sheet.
_SHORT = 24


@dataclass(frozen=True, slots=True)
class ExampleView:
    """One documented frame, byte by byte. `number` counts from 1 within its message."""

    message: str
    number: int
    title: str
    data: bytes
    direction: str
    key: str
    cells: list[Cell]
    cite: CiteView | None
    constructed: str
    place: Place

    @property
    def page(self) -> str:
        """The page of the message."""
        return message_page(self.message)

    @property
    def hex(self) -> str:
        """The bytes as people read them."""
        return to_hex(self.data)

    @property
    def beginning(self) -> str:
        """The bytes, or as many of them as a line holds."""
        return self.hex if len(self.data) <= _SHORT else f"{to_hex(self.data[:_SHORT])} …"

    @property
    def python(self) -> str:
        """The bytes as Python reads them."""
        return f'bytes.fromhex("{self.hex}")'

    @property
    def query(self) -> str:
        """The query string that opens the decoder with these bytes."""
        return f"hex={self.data.hex()}&direction={self.key}"


@dataclass(frozen=True, slots=True)
class ExampleSequence:
    """A frame and those that follow it: its reply, or reports that may come."""

    request: ExampleView
    replies: list[ExampleView]
    certain: bool


def example_views(model: Model, message: MessageLayout) -> list[ExampleView]:
    """Return every example of a message."""
    return [
        ExampleView(
            message.name,
            number,
            example.title,
            example.hex,
            f"{message.direction.sender} to {message.direction.receiver}",
            message.direction.key,
            frame_strip(model, message, example.hex),
            None if example.cite is None else cite_view(model.spec, example.cite),
            example.constructed,
            Place(("messages", message.name, "examples", number - 1)),
        )
        for number, example in enumerate(message.message.examples, 1)
    ]


def example_sequences(model: Model) -> list[ExampleSequence]:
    """Return every documented frame once: requests with what follows them, then the rest."""
    views = {name: example_views(model, message) for name, message in model.messages.items()}
    shown: set[tuple[str, int]] = set()
    found: list[ExampleSequence] = []
    for name, message in model.messages.items():
        said = message.message
        follow = [said.reply] if said.reply is not None else said.reports
        for view in views[name]:
            if (view.message, view.number) in shown:
                continue
            replies = list(_answers(model, view, follow, views))
            shown |= {(reply.message, reply.number) for reply in replies}
            found.append(ExampleSequence(view, replies, certain=said.reply is not None))
    return found


def _answers(
    model: Model, request: ExampleView, follow: list[str], views: dict[str, list[ExampleView]]
) -> Iterator[ExampleView]:
    """Yield the example that belongs to the request, of each message that may follow."""
    requested = _example(model, request)
    for name in follow:
        for view in views[name]:
            answer = _example(model, view).values
            shared = requested.values.keys() & answer.keys()
            agree = all(requested.values[key] == answer[key] for key in shared)
            if agree if shared else view.number == request.number:
                yield view
                break


def _example(model: Model, view: ExampleView) -> Example:
    return model.messages[view.message].message.examples[view.number - 1]
