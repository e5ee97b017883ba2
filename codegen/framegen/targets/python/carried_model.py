"""The model that a library carries as data, for the verbs that explain and look up."""

from __future__ import annotations

import json
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from framewire.protocol.form import FORM, data_of

from framegen.output import banner
from framegen.targets.python.client_snippet import client_snippet
from framegen.targets.python.message_view import MessageView
from framegen.targets.python.names import names_of
from framegen.targets.python.snippet import codec_snippet

if TYPE_CHECKING:
    from framegen.compile import Compiled
    from framegen.language.values import Method
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model

# Down to here a key is a line of its own; what is deeper shares the line.
_DEPTH = 4


def carried_model(compiled: Compiled) -> str:
    """Return the model as JSON in which a change to one message changes only its lines."""
    model = compiled.model
    library = names_of(model).library
    methods = {each.request.name: each.method for each in library.exchanges}
    protocol = replace(
        model.protocol,
        messages={
            name: replace(facts, **_usage(model, model.messages[name], methods))
            for name, facts in model.protocol.messages.items()
        },
        members={str(way): there.key for way, there in zip(model.ways, library.ways, strict=True)},
    )
    data = {"comment": banner(compiled.source.path), "form": FORM, **data_of(protocol)}
    return f"{_formatted(data, 0)}\n"


def _usage(model: Model, layout: MessageLayout, methods: dict[str, Method]) -> dict[str, Any]:
    """Return how the library and its command send or receive a message."""
    names = names_of(model)
    library, message = names.library, names.message(layout.name)
    example, program = layout.message.examples[0], model.spec.protocol.name
    given = MessageView(message, library).command_words(names.values(layout.name, example.values))
    words = " ".join([message.name, *given])
    client = client_snippet(library, message)
    shell, method = [f"{program} encode {words}"], methods.get(message.name)
    if method is not None:
        shell.append(f"{program} send --port COM7 {words}")
    return {
        "python": tuple(codec_snippet(model, layout, example).rstrip().split("\n")),
        "client": tuple(client.rstrip().split("\n")) if client else (),
        "shell": tuple(shell),
        "class_name": message.name if message.name != layout.name else "",
        "method": f"{method.name}({', '.join(method.arguments)})" if method else "",
    }


def _formatted(value: Any, depth: int) -> str:
    if depth >= _DEPTH or not value or not isinstance(value, (dict, list)):
        return json.dumps(value)
    margin = " " * depth
    if isinstance(value, dict):
        lines = [f"{json.dumps(key)}: {_formatted(each, depth + 1)}" for key, each in value.items()]
        begin, end = "{", "}"
    else:
        lines = [_formatted(each, depth + 1) for each in value]
        begin, end = "[", "]"
    inside = ",\n".join(f"{margin} {line}" for line in lines)
    return f"{begin}\n{inside}\n{margin}{end}"
