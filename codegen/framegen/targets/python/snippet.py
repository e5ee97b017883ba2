"""Snippets that send or receive a message: by the client, by the codec, and from a shell."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.language.values import to_hex
from framegen.model.codec import encode
from framegen.model.slots import Items, Packed
from framegen.model.stream import ReferenceDecoder
from framegen.targets.python.client_snippet import client_snippet
from framegen.targets.python.escape import Bracketed
from framegen.targets.python.message_view import MessageView
from framegen.targets.python.names import names_of
from framegen.targets.python.spelling import direction_member
from framegen.targets.target import Snippet

if TYPE_CHECKING:
    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

PORT = "COM5"


def snippets(model: Model, message: MessageLayout, example: Example) -> list[Snippet]:
    """Show how an example is sent, or how such messages are received.

    What comes from a third end of the line has neither a client nor a command.
    """
    names = names_of(model)
    library, layout = names.library, names.message(message.name)
    values = names.values(message.name, example.values)
    shown = example.model_copy(update={"values": values})
    client = client_snippet(library, layout)
    shell = _shell(model, library, layout, shown)
    return [
        *([Snippet("Client", "python", client)] if client else []),
        Snippet("Codec", "python", codec_snippet(model, message, example)),
        *([Snippet("Shell", "sh", shell)] if shell else []),
    ]


def codec_snippet(model: Model, message: MessageLayout, example: Example) -> str:
    """Write code that makes what the user sends, or finds what the user receives."""
    show = _sending if message.direction == model.roles.sent else _receiving
    names = names_of(model)
    values = names.values(message.name, example.values)
    shown = example.model_copy(update={"values": values})
    return show(names.library, names.message(message.name), shown)


def _shell(model: Model, library: Model, message: MessageLayout, example: Example) -> str:
    """Write a command that sends a message or asks for it, or shows those that come."""
    program = model.spec.protocol.name
    requests = library.answers.get(message.name, []) + library.refuses.get(message.name, [])
    sent = library.exchanges_by_request
    asked = next((library.messages[each] for each in requests if each in sent), None)
    if asked is not None and asked.message.examples:
        message, example = asked, asked.message.examples[0]
    if message.direction == library.roles.sent:
        given = MessageView(message, library).command_words(example.values)
        return f"{program} send --port {PORT} {' '.join([message.name, *given])}\n"
    if message.direction == library.roles.received:
        return f"{program} monitor --port {PORT} --only {message.name}\n"
    return ""


def _sending(model: Model, message: MessageLayout, example: Example) -> str:
    """Write code that makes the frame of an example."""
    given = MessageView(message, model).given_values(example.values)
    return (
        f"from {model.spec.protocol.name} import {message.name}\n\n"
        + Bracketed(f"message = {message.name}(", given, ")\n").fitted(0)
        + _from_hex("assert message.encode() ==", encode(message, example.values))
    )


def _receiving(model: Model, message: MessageLayout, example: Example) -> str:
    """Write code that finds an example in a stream."""
    names = sorted([message.name, "Direction", "StreamDecoder"])
    so_far = ReferenceDecoder(model, [message.direction]).decode_so_far(example.hex)
    # What may be the beginning of a longer frame is one where nothing follows.
    is_certain = any(event.message is message for event in so_far)
    fed = "decoder.feed(received)"
    events = fed if is_certain else f"[*{fed}, *decoder.flush()]"
    return (
        f"from {model.spec.protocol.name} import {', '.join(names)}\n\n"
        f"decoder = StreamDecoder(Direction.{direction_member(message.direction)})\n"
        + _from_hex("received =", example.hex)
        + f"for event in {events}:\n"
        + f"    if isinstance(event, {message.name}):\n"
        + "".join(f"        {line}\n" for line in _shown(message, example))
    )


def _from_hex(before: str, frame: bytes) -> str:
    return Bracketed(f"{before} bytes.fromhex(", [f'"{to_hex(frame)}"'], ")\n").fitted(0)


def _shown(message: MessageLayout, example: Example) -> list[str]:
    lines: list[str] = []
    for field in message.arguments:
        value = example.values[field.name]
        if isinstance(value, str):
            lines.append(f"print(event.{field.name})")
        elif not isinstance(field, Items | Packed):
            lines.append(f"print(event.{field.name})  # {value}")
        elif isinstance(field, Packed) or field.element is None:
            lines.append(f"print(*event.{field.name})")
        else:
            names = ", ".join(each.name for each in field.fields)
            comma = "," if len(field.fields) == 1 else ""
            lines += [f"for {names}{comma} in event.{field.name}:", f"    print({names})"]
    return lines or ["print(event)"]
