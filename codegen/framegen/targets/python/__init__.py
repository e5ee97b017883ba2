"""The Python library: what the spec decides of it, on a runtime that all libraries share."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.targets.python.carried_model import carried_model
from framegen.targets.python.carried_runtime import FOLDER, carried_runtime
from framegen.targets.python.client_view import ClientView
from framegen.targets.python.command_view import CommandView
from framegen.targets.python.device_view import DeviceView
from framegen.targets.python.docstring import docstring
from framegen.targets.python.escape import argument, assigned, literal, quoted
from framegen.targets.python.imports import CARRIED, SHARED, imports
from framegen.targets.python.library_view import LibraryView
from framegen.targets.python.names import bent, names_of
from framegen.targets.python.reserved import RESERVED
from framegen.targets.python.snippet import snippets
from framegen.targets.target import Comment, Target
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from jinja2 import Environment

    from framegen.compile import Compiled
    from framegen.model.model import Model
    from framegen.targets.target import Snippets

_HERE = Path(__file__).parent


# What only some libraries have.
_OF_DISTRIBUTIONS = frozenset({"README.md", "hatch_build.py", "pyproject.toml"})
_OF_ADDRESSES = frozenset({"_async_devices.py", "_devices.py"})


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Render the library's files, by path below the project's root."""
    carries = compiled.carries_runtime
    library = LibraryView(names_of(compiled.model).library, CARRIED if carries else SHARED)
    files = _from_templates(library) | {"protocol.json": carried_model(compiled), "py.typed": ""}
    files |= carried_runtime() if carries else {}
    (root,) = folders(compiled.model)
    return {f"{root}/{name}": text for name, text in files.items()}


def folders(model: Model) -> tuple[str, ...]:
    """Return the folder of the package."""
    return (f"generated/{model.spec.protocol.name}",)


def copies(model: Model) -> tuple[str, ...]:
    """Return the folder of the runtime that the package may carry."""
    return tuple(f"{folder}/{FOLDER}" for folder in folders(model))


def _from_templates(library: LibraryView) -> dict[str, str]:
    client, templates = ClientView(library.model), _environment()
    given = {
        "library": library,
        "client": client,
        "command": CommandView(library.model),
        "device": DeviceView(library.model),
        "runtime": library.runtime,
    }
    unused = frozenset[str]() if library.model.spec.protocol.distribution else _OF_DISTRIBUTIONS
    unused |= frozenset[str]() if client.bus else _OF_ADDRESSES
    names = (name.removesuffix(".jinja") for name in templates.list_templates(["jinja"]))
    return {
        name: templates.get_template(f"{name}.jinja").render(given)
        for name in sorted(names)
        if name not in unused
    }


@cache
def _environment() -> Environment:
    # This is Python, not HTML: the filters escape.
    made = environment(_HERE / "templates", "python", autoescape=False)
    made.filters.update(
        argument=argument,
        assigned=assigned,
        docstring=docstring,
        imports=imports,
        literal=literal,
        quoted=quoted,
    )
    return made


TARGET = Target(
    name="python",
    about="The Python library: messages, codec, clients, device and command.",
    render=render,
    folders=folders,
    comments={
        ".py": Comment("# "),
        ".pyi": Comment("# "),
        ".toml": Comment("# "),
        ".md": Comment("<!-- ", " -->"),
    },
    copies=copies,
    reserved=RESERVED,
    bent=bent,
    snippets=snippets,
)
