"""The Python library: typed messages, a codec and a stream decoder, on the standard library."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.targets.python.carried_model import carried_model
from framegen.targets.python.checksum_view import checksums_of
from framegen.targets.python.client_view import ClientView
from framegen.targets.python.device_view import DeviceView
from framegen.targets.python.docstring import docstring
from framegen.targets.python.escape import assigned, literal, quoted
from framegen.targets.python.library_view import LibraryView
from framegen.targets.python.names import bent, names_of, package_of
from framegen.targets.python.reserved import RESERVED
from framegen.targets.python.snippet import snippet
from framegen.targets.target import Comment, Target
from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Iterator

    from jinja2 import Environment

    from framegen.compile import Compiled
    from framegen.model.model import Model
    from framegen.targets.target import Snippets

_HERE = Path(__file__).parent
# What framegen and a library have in common is written once: where it is copied to.
_SHARED = {
    "_cli/colour.py": "colour.py",
    "_cli/console.py": "console.py",
    "_cli/shell_completion.py": "shell_completion.py",
    "_codec/hextext.py": "hextext.py",
    "_recording/file.py": "recording_file.py",
    "_frame/pluralize.py": "pluralize.py",
    **{
        f"_explanation/{name}.py": f"explanation/{name}.py"
        for name in (
            "__init__",
            "checksum",
            "explanation",
            "lookalikes",
            "protocol",
            "refusals",
            "text",
        )
    },
}
# What a shared file imports has another place in a library.
_IMPORT, _IMPORT_THERE = "from ..pluralize import", "from .._frame.pluralize import"
# What only a library has that is a distribution of its own.
_FOR_DISTRIBUTIONS = {"README.md", "pyproject.toml"}
# What only a protocol with poses has a use for.
_FOR_POSES = {"_cli/play.py", "_cli/posefile.py", "_cli/positions.py", "_cli/teach.py"}
# What only a protocol with checksums has a use for: each method needs some of it.
_FOR_CHECKSUMS = {f"_frame/{name}.py" for name in ("byte_sum", "crc", "fletcher", "running")}
# What takes the place of another file where frames are more than a header, a length and an id.
_FOR_ENVELOPES = {
    "_frame/envelope_heads.py": "_frame/heads.py",
    "_frame/envelope_parts.py": "_frame/parts.py",
    "_frame/envelope_table.py": "_frame/table.py",
}
_FOR_PLAIN = {
    "_frame/plain_heads.py": "_frame/heads.py",
    "_frame/plain_parts.py": "_frame/parts.py",
}
_WITH_ENVELOPES = {
    f"_frame/{name}.py" for name in ("envelope", "envelopes", "head_walk", "trial", "why_not")
}
# And where each of them proves by a checksum that it is one.
_FOR_PROVEN = {"_codec/certain_decoder.py": "_codec/careful_decoder.py"}
# What only a protocol with addresses has a use for, and one whose device says what has failed.
_FOR_ADDRESSES = {
    "_client/address.py",
    "_client/async_devices.py",
    "_client/devices.py",
}
_FOR_FAILURES = {"_client/failures.py"}
# What only some kinds of fields have a use for.
_FOR_FIELDS = {
    "_frame/fixed.py",
    "_frame/floating.py",
    "_frame/general_shape.py",
    "_frame/lists.py",
    "_frame/mixed_element.py",
    "_frame/optional.py",
    "_frame/packed.py",
    "_frame/quick_tests.py",
    "_frame/shape.py",
    "_frame/swapped.py",
    "_frame/text.py",
    "_frame/three_bytes.py",
}


def render(compiled: Compiled, _snippets: Snippets) -> dict[str, str]:
    """Render the library's files, by path below the project's root."""
    library = LibraryView(names_of(compiled.model).library)
    unneeded = _FOR_CHECKSUMS.difference(*(sums.files for sums in checksums_of(compiled.model)))
    client = ClientView(library.model)
    unneeded |= _FOR_FIELDS.difference(f"_frame/{name}.py" for name in library.modules)
    if compiled.model.spec.protocol.distribution is None:
        unneeded |= _FOR_DISTRIBUTIONS
    if compiled.model.spec.pose is None:
        unneeded |= _FOR_POSES
    if client.bus is None:
        unneeded |= _FOR_ADDRESSES
    if not client.failing:
        unneeded |= _FOR_FAILURES
    if library.plain:
        unneeded |= _WITH_ENVELOPES
    if not library.checksums:
        unneeded.add("_codec/proof.py")
    files = {**_runtime(), **dict(_from_templates(library))}
    for name, instead in _others(library):
        text = files.pop(name)
        if instead:
            files[instead] = text
    files = {name: text for name, text in files.items() if name not in unneeded}
    files |= {"_explanation/model.json": carried_model(compiled), "py.typed": ""}
    (root,) = folders(compiled.model)
    return {f"{root}/{name}": text for name, text in files.items()}


def _others(library: LibraryView) -> Iterator[tuple[str, str]]:
    """Yield the files that take the place of others, each with that place; "" for nowhere."""
    for places, wanted in (
        (_FOR_PLAIN, library.plain),
        (_FOR_ENVELOPES, not library.plain),
        (_FOR_PROVEN, library.proven),
    ):
        for name, place in places.items():
            yield name, place if wanted else ""


def folders(model: Model) -> tuple[str, ...]:
    """Return the folder of the package."""
    return (f"generated/{package_of(model)}",)


@cache
def _runtime() -> dict[str, str]:
    """Return the files that are the same for every protocol; read once."""
    root = _HERE / "runtime"
    files = {file.relative_to(root).as_posix(): file for file in sorted(root.rglob("*.py"))}
    files |= {name: _HERE.parents[1] / shared for name, shared in _SHARED.items()}
    return {
        name: file.read_text(encoding="utf-8").replace(_IMPORT, _IMPORT_THERE)
        for name, file in files.items()
    }


def _from_templates(library: LibraryView) -> list[tuple[str, str]]:
    templates = _environment()
    names = sorted(templates.list_templates(extensions=["jinja"]))
    return [
        (
            name.removesuffix(".jinja"),
            templates.get_template(name).render(
                library=library,
                client=ClientView(library.model),
                device=DeviceView(library.model),
                frame=library.model.frame,
            ),
        )
        for name in names
    ]


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
    snippet=snippet,
)
