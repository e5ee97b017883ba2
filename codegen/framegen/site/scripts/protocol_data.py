"""The protocol as data for scripts: slots as plain values, and the texts that explain them.

See `slot_data` for what is said of a slot.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framewire.explain import refusals
from framewire.explain.explanation import example_in_words, facts, named
from framewire.frame.pluralize import describe_range

from framegen.language.formula import Sizes
from framegen.site.scripts.slot_data import exact, lowest, slot_data
from framegen.targets.docs.address import message_page

if TYPE_CHECKING:
    from collections.abc import Collection

    from framegen.language.values import Direction
    from framegen.model.envelope import Envelope
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# The reasons for which bytes are no frame, by what the script calls them.
REASONS = {
    "tooShort": refusals.TOO_SHORT,
    "trailing": refusals.TRAILING_BYTES,
    "header": refusals.BAD_HEADER,
    "trailer": refusals.BAD_TRAILER,
    "length": refusals.LENGTH_MISMATCH,
    "count": refusals.COUNT_MISMATCH,
    "unknown": refusals.UNKNOWN_COMMAND,
    "range": refusals.OUT_OF_RANGE,
    "checksum": refusals.BAD_CHECKSUM,
}
_ANY_BYTE = 0x100


def protocol_data(model: Model, messages: Collection[str] | None = None) -> dict[str, Any]:
    """Return all that decoding, encoding and explaining need, of some messages or of all.

    The slots of a message are those of its envelope, with its fields where the body is. Its frame
    has `size` bytes and those of as many elements as `counts` allows, or one of its `sizes`.
    """
    shown = [each for each in model.messages.values() if messages is None or each.name in messages]
    return {
        "name": model.spec.protocol.name,
        "title": model.spec.protocol.title,
        "reasons": REASONS,
        "directions": [_direction(model, way) for way in model.directions],
        # Empty where any byte may begin a frame.
        "begins": sorted(model.first_bytes) if len(model.first_bytes) < _ANY_BYTE else [],
        "frames": [_envelope(frame) for frame in model.envelopes.values()],
        "messages": [_message(message) | _said(model, message.name) for message in shown],
        **explained_elsewhere(model),
    }


def _direction(model: Model, way: Direction) -> dict[str, Any]:
    return {
        "key": way.key,
        "sender": way.sender,
        "receiver": way.receiver,
        "text": f"{way.sender} to {way.receiver}",
        "arrow": str(way),
        "opening": model.opening([way]),
    }


def explained_elsewhere(model: Model) -> dict[str, Any]:
    """Return the look-alikes, and the ids that are reserved."""
    lookalikes = [
        {
            "title": said.title,
            "about": said.about,
            "commands": {str(number): meaning for number, meaning in said.commands.items()},
            **({"frame": _envelope(model.lookalikes[name])} if said.frame else {}),
        }
        for name, said in model.spec.lookalikes.items()
    ]
    reserved = [
        {
            "id": each.id.one,
            "why": each.why,
            **({} if each.direction is None else {"direction": str(each.direction)}),
        }
        for each in model.spec.reserved
        if each.id is not None and each.id.one is not None
    ]
    return {"lookalikes": lookalikes, "reserved": reserved}


def _said(model: Model, name: str) -> dict[str, Any]:
    """Return what explanations say of a message."""
    plain = model.protocol.messages[name]
    formula = plain.formula if plain.varies else f"always {plain.formula}"
    return {
        "means": {"length": formula, "id": named(plain)},
        "lengths": describe_range(plain.lengths),
        "facts": [*facts(model.protocol, plain, b"")],
        "documented": [
            {"hex": example.hex, "text": example_in_words(example)} for example in plain.examples
        ],
    }


def _envelope(frame: Envelope) -> dict[str, Any]:
    """Return an envelope; `ids` identify a message together, those not sent among them.

    `turns` are its checksums in the order in which they are worked out.
    """
    return {
        "name": frame.name,
        "header": list(frame.header),
        "begins": sorted(frame.first_bytes) if len(frame.first_bytes) < _ANY_BYTE else [],
        "least": frame.least,
        "uncounted": frame.uncounted,
        "proves": frame.proves_unknown,
        "slots": [slot_data(slot, frame) for slot in frame.slots],
        "turns": [slot.name for slot in frame.checksums],
        "ids": [slot_data(slot) for slot in frame.ids],
    }


def _message(message: MessageLayout) -> dict[str, Any]:
    rule = message.formula
    sizes = (
        [size + message.frame.uncounted for size in rule.sizes] if isinstance(rule, Sizes) else []
    )
    return {
        "name": message.name,
        "page": message_page(message.name),
        "frame": message.frame.name,
        "ids": list(message.ids),
        "direction": message.direction.key,
        "summary": message.message.summary,
        "example": _example(message),
        "fields": [slot_data(slot) for slot in message.body],
        "given": [slot.name for slot in message.arguments],
        "counts": {"low": message.counts[0], "high": message.counts[-1]},
        "size": message.size_at(0),
        **({"sizes": sizes} if sizes else {}),
    }


def _example(message: MessageLayout) -> dict[str, Any]:
    """Return values to begin with: those of the first example, or else the lowest."""
    said = message.message.examples[0].values if message.message.examples else {}
    return {
        slot.name: exact(slot, said[slot.name] if slot.name in said else lowest(slot))
        for slot in message.arguments
    }
