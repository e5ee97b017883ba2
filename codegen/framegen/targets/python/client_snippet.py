"""A snippet that sends or receives a message with a client, from the first line to the last."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING

from framegen.model.client_names import client_names
from framegen.targets.python.client_view import ClientView
from framegen.targets.python.escape import Bracketed
from framegen.targets.python.exports import import_order

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.targets.python.method_view import MethodView


def client_snippet(library: Model, message: MessageLayout) -> str:
    """Write a program for a message under the names of the library; empty where no client has it.

    What is sent is called. Of what is received, a reply is what a method returns, a refusal what it
    raises, and a report what one waits for.
    """
    if message.direction == library.roles.sent:
        return _program(library, [], [_call(each) for each in _methods(library, [message.name])])
    if message.direction != library.roles.received:
        return ""
    for method in _methods(library, library.answers.get(message.name, [])):
        return _program(library, [], [_call(method)])
    for method in _methods(library, library.refuses.get(message.name, [])):
        lines = ["try:", f"    {_call(method, 8)}", "except RefusedError as error:"]
        return _program(library, ["RefusedError"], [*lines, "    print(error.refusal)"])
    client = client_names(library.spec).variable
    causes = _methods(library, library.reports_on.get(message.name, []))
    return _program(
        library,
        [message.name],
        [
            *(_call(method) for method in islice(causes, 1)),
            f"# Or {client}.on_report(print): every report. NoReportError: none came in time.",
            f"print({client}.wait_for({message.name}, timeout=30))",
        ],
    )


def _methods(library: Model, requests: Iterable[str]) -> Iterator[MethodView]:
    """Yield the methods of the client that send these messages."""
    found = map(ClientView(library).method, requests)
    return (method for method in found if method is not None)


def _call(method: MethodView, indent: int = 4) -> str:
    """Return the call of a method, which is printed where it returns what came back."""
    before = f"{method.flavour.variable}.{method.name}("
    if method.exchange.reply is None:
        return method.example_call(before).fitted(indent)
    call = method.example_call(f"print({before}")
    return Bracketed(call.before, call.items, f"{call.after})").fitted(indent)


def _program(library: Model, names: list[str], lines: list[str]) -> str:
    client = client_names(library.spec)
    imported = ", ".join(sorted([*names, client.opener], key=import_order))
    opened = f'with {client.opener}("COM5") as {client.variable}:  # or "/dev/ttyUSB0"'
    body = "".join(f"    {line}\n" for line in lines)
    return f"from {library.spec.protocol.name} import {imported}\n\n{opened}\n{body}"
