"""Rule: the name of the client is not taken where it names classes, functions and a variable."""

from __future__ import annotations

from typing import TYPE_CHECKING

from framegen.checks.named import classes
from framegen.checks.rule import Problem, StructureRule
from framegen.language.class_names import (
    AMBIGUOUS_CLASSES,
    DEFAULT_CLIENT,
    LIBRARY_CLASSES,
    PYTHON_CLASSES,
)
from framegen.language.package_names import BUILTINS, KEYWORDS
from framegen.model.client_names import client_names

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.language.spec import Spec
    from framegen.model.client_names import ClientNames

_PATH = ("protocol", "client")
_ASYNC = "Async"
# What a class is called where its own name is taken, or that of all messages of an end.
_ENDINGS = ("Message", "Element")


def _look(spec: Spec) -> Iterator[Problem]:
    names = client_names(spec)
    name = names.threads
    # A message that has the usual name is bent: nobody has chosen the other. What is spelt like no
    # class at all is found by `identifier`.
    if name == DEFAULT_CLIENT or not name[:1].isupper():
        return
    why = _why_taken(names)
    rest = name.removeprefix(_ASYNC)
    if rest != name and rest[:1].isupper():
        what = f"`{name}` begins with `{_ASYNC}`, as the client for asyncio does"
        yield Problem(_PATH, what, f"write `{rest}`")
    elif why:
        yield Problem(_PATH, f"`{name}` {why}", f"choose another name, such as `{name}Client`")
    for path, other, _ in classes(spec):
        if other in names.classes:
            makes = f"`{name}`" if other == name else f"`{name}` makes `{other}`, which"
            what = f"{makes} is a class of this protocol already"
            hint = f"choose another name, such as `{name}Client`"
            yield Problem(_PATH, what, hint, also=(path, "it is here"))


def _why_taken(names: ClientNames) -> str:
    """Return why a library cannot have this client, behind its name in a sentence."""
    called = f"would be called `{names.variable}` in programs"
    return next(
        (
            why
            for taken, why in (
                (names.threads in PYTHON_CLASSES, "is a class of Python's own"),
                (names.threads in LIBRARY_CLASSES, "is a class of every library"),
                (names.threads in AMBIGUOUS_CLASSES, "is taken for a digit"),
                (names.threads.endswith(_ENDINGS), "ends as classes of messages and elements do"),
                (names.variable in KEYWORDS, f"{called}, which is a word of Python itself"),
                (names.variable in BUILTINS, f"{called}, and hide what Python has under this name"),
            )
            if taken
        ),
        "",
    )


RULE = StructureRule(
    id="client-name",
    title="The name of the client is not taken",
    why="The client's class stands beside those of messages, and those that every library has; "
    "examples call a client by the same words in lower case. A message that is called like the "
    "client is changed by its target only where the spec does not choose the client's name.",
    bad="protocol: {client: Device, ...}",
    good="protocol: {client: Arm, ...}",
    look=_look,
)
