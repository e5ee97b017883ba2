"""The Python library: typed messages, a codec and a stream decoder, on the standard library."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.targets.python.carried_model import carried_model
from framegen.targets.python.client_view import ClientView
from framegen.targets.python.copies import copies
from framegen.targets.python.device_view import DeviceView
from framegen.targets.python.docstring import docstring
from framegen.targets.python.escape import assigned, literal, quoted
from framegen.targets.python.files import placed
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


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Render the library's files, by path below the project's root."""
    library = LibraryView(names_of(compiled.model).library)
    client = ClientView(library.model)
    files = placed({**_runtime(), **_from_templates(library, client)}, library, client)
    files |= {"_explanation/model.json": carried_model(compiled), "py.typed": ""}
    (root,) = folders(compiled.model)
    return {f"{root}/{name}": text for name, text in files.items()}


def folders(model: Model) -> tuple[str, ...]:
    """Return the folder of the package."""
    return (f"generated/{model.spec.protocol.name}",)


@cache
def _runtime() -> dict[str, str]:
    """Return the files that are the same for every protocol; read once."""
    root = _HERE / "runtime"
    own = {file.relative_to(root).as_posix(): file for file in sorted(root.rglob("*.py"))}
    return copies() | {name: file.read_text(encoding="utf-8") for name, file in own.items()}


def _from_templates(library: LibraryView, client: ClientView) -> dict[str, str]:
    templates = _environment()
    given = {"library": library, "client": client, "device": DeviceView(library.model)}
    return {
        name.removesuffix(".jinja"): templates.get_template(name).render(given)
        for name in sorted(templates.list_templates(extensions=["jinja"]))
    }


@cache
def _environment() -> Environment:
    # This is Python, not HTML: the filters escape.
    made = environment(_HERE / "templates", "python", autoescape=False)
    made.filters.update(assigned=assigned, docstring=docstring, literal=literal, quoted=quoted)
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
    reserved=RESERVED,
    bent=bent,
    snippets=snippets,
)
