"""Python that sends or receives a message, on the bytes of a documented example."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.targets.python.view import MessageView, direction_member
from framegen.values import to_hex

if TYPE_CHECKING:
    from framegen.layout import Layout, MessageLayout
    from framegen.spec import Example


def sending(layout: Layout, message: MessageLayout, example: Example) -> str:
    """Make the frame of an example."""
    call = MessageView(message, layout).call(example.values)
    return (
        f"from {layout.spec.protocol.name} import {message.name}\n\n"
        f"frame = {call}.encode()\n"
        f'assert frame == bytes.fromhex("{to_hex(example.hex)}")\n'
    )


def receiving(layout: Layout, message: MessageLayout, example: Example) -> str:
    """Find an example in what the line brings."""
    names = sorted([message.name, "Direction", "StreamDecoder"])
    return (
        f"from {layout.spec.protocol.name} import {', '.join(names)}\n\n"
        f"decoder = StreamDecoder(Direction.{direction_member(message.direction)})\n"
        f'data = bytes.fromhex("{to_hex(example.hex)}")\n'
        "for event in decoder.feed(data):\n"
        f"    if isinstance(event, {message.name}):\n"
    ) + "".join(f"        {line}\n" for line in _shown(message, example))


def _shown(message: MessageLayout, example: Example) -> list[str]:
    lines = [
        f"print(event.{field.name})  # {example.values[field.name]}"
        for field in message.numbers
        if not message.counts_with(field)
    ]
    repeat = message.repeat
    if repeat is not None and repeat.element is None:
        lines.append(f"print(*event.{repeat.name})")
    elif repeat is not None:
        names = ", ".join(field.name for field in repeat.fields)
        comma = "," if len(repeat.fields) == 1 else ""
        lines += [f"for {names}{comma} in event.{repeat.name}:", f"    print({names})"]
    return lines or ["print(event)"]
