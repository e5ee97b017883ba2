"""Test vectors for codecs in any language: frames, invalid frames, streams, and replies.

Made from the spec's examples and the ends of its ranges by the reference codec, never by a
generated library, so that a library can be tested against them.
"""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

from framegen.cases.invalid import invalid_frames
from framegen.cases.replies import replies
from framegen.cases.streams import streams
from framegen.cases.unencodable import unencodable
from framegen.cases.valid import valid_frames
from framegen.language.values import to_hex
from framegen.model.codec import values_of
from framegen.model.stream import ReferenceDecoder
from framegen.output import banner
from framegen.targets.target import Target

if TYPE_CHECKING:
    from framegen.cases.invalid import InvalidFrame
    from framegen.cases.replies import Reply
    from framegen.cases.stream_case import StreamCase
    from framegen.cases.unencodable import UnencodableValues
    from framegen.cases.valid import ValidFrame
    from framegen.compile import Compiled
    from framegen.model.model import Model
    from framegen.model.stream import Event
    from framegen.targets.target import Snippets


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Render the file of vectors, by path below the project's root."""
    model = compiled.model
    protocol = model.spec.protocol
    document = {
        "comment": banner(compiled.source.path),
        "protocol": protocol.name,
        "version": protocol.version,
        "valid": [_valid(frame) for frame in valid_frames(model)],
        "unencodable": [_unencodable(values) for values in unencodable(model)],
        "invalid": [_invalid(frame) for frame in invalid_frames(model)],
        "streams": [_stream(model, case) for case in streams(model)],
    }
    # Few protocols say how many items a reply holds.
    if found := [_reply(each) for each in replies(model)]:
        document["replies"] = found
    return {f"generated/{protocol.name}/vectors.json": _one_vector_a_line(document)}


def _one_vector_a_line(document: dict[str, Any]) -> str:
    """Format JSON so that a changed vector is a changed line."""
    parts: list[str] = []
    for key, value in document.items():
        if isinstance(value, list):
            shown = "[\n" + ",\n".join(f"    {json.dumps(item)}" for item in value) + "\n  ]"
        else:
            shown = json.dumps(value)
        parts.append(f"  {json.dumps(key)}: {shown}")
    return "{\n" + ",\n".join(parts) + "\n}\n"


def _valid(frame: ValidFrame) -> dict[str, Any]:
    return {
        "title": frame.title,
        "direction": frame.message.direction.key,
        "message": frame.message.name,
        "fields": frame.values,
        "hex": to_hex(frame.data),
    }


def _unencodable(values: UnencodableValues) -> dict[str, Any]:
    return {"title": values.title, "message": values.message.name, "fields": values.values}


def _invalid(frame: InvalidFrame) -> dict[str, Any]:
    return {
        "title": frame.title,
        "direction": frame.direction.key,
        "hex": to_hex(frame.data),
        "reason": frame.reason,
        "offset": frame.offset,
    }


def _stream(model: Model, case: StreamCase) -> dict[str, Any]:
    line = ReferenceDecoder(model, [case.direction], case.max_frame)
    return {
        "title": case.title,
        "direction": case.direction.key,
        "max_frame": case.max_frame,
        "parts": ["quiet" if part is None else to_hex(part) for part in case.parts],
        "events": [_event(event) for event in line.follow(case.parts)],
    }


def _reply(reply: Reply) -> dict[str, Any]:
    return {
        "title": reply.title,
        "request": to_hex(reply.request),
        "reply": to_hex(reply.reply),
        "answers": reply.answers,
    }


def _event(event: Event | None) -> dict[str, Any]:
    if event is None:
        return {"event": "quiet"}
    shown: dict[str, Any] = {"event": event.kind}
    if event.message is not None:
        shown["message"] = event.message.name
        shown["fields"] = values_of(event.message, event.data)
    elif event.kind == "noise":
        shown["reason"] = event.reason
    return {**shown, "hex": to_hex(event.data)}


TARGET = Target(
    name="vectors",
    about="Test vectors for codecs in any language.",
    render=render,
)
