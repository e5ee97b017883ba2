"""`framegen new`: the files with which the project of another protocol begins."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from framewire.command.console import visible
from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from argparse import ArgumentParser, Namespace

    from framegen.model.model import Model

SUMMARY = "Begin a project: a small spec, tests, a simulator, and what pip and CI need."
EXAMPLES = (
    ("framegen new kiln", "the project of a protocol called kiln, in the folder kiln/"),
    ("framegen new kiln --into .", "the same, in this folder"),
    ("framegen new kiln --targets python,vectors,docs", "with the reference, without a schema"),
)


def add_arguments(parser: ArgumentParser) -> None:
    """Declare the arguments of the verb."""
    parser.add_argument(
        "name", metavar="NAME", help="the name of the protocol and its library, in snake_case"
    )
    parser.add_argument(
        "--into",
        type=Path,
        metavar="FOLDER",
        help="the folder of the project, which may hold other files (default: NAME)",
    )
    parser.add_argument(
        "--targets",
        metavar="NAMES",
        help="what `framegen generate` is to write there, as `framegen targets` lists it, with "
        "commas between; pyproject.toml keeps it (default: python,vectors,schema)",
    )


def run(arguments: Namespace) -> int:
    """Write the files, and print the commands that come next. Raises Unusable for a bad name."""
    from framegen.skeleton import skeleton, spec_path  # noqa: PLC0415
    from framegen.writing import create  # noqa: PLC0415

    name: str = arguments.name
    files = skeleton(name, _targets(arguments.targets))
    model = _accepted(name, files[spec_path(name)])
    root: Path = arguments.into or Path(name)
    written = create(root, files)
    for path in written:
        print(f"wrote {visible(Path(root, path).as_posix())}")
    if not written:
        print(f"{pluralize(len(files), 'file')} are there already: nothing was written")
    frame = next(each.reply.message.examples[0].hex for each in model.exchanges if each.reply)
    print(
        f"""
next:
  framegen generate {_argument(Path(root, spec_path(name)).as_posix())}
  pip install --editable {_argument(_folder(root))}
and the library decodes:
  {name} decode {frame.hex(" ").upper()}"""
    )
    return 0


def _targets(words: str | None) -> tuple[str, ...]:
    """Return the names of the targets that are asked for. Raises Unusable."""
    from framegen.chosen_targets import targets_named  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415
    from framegen.skeleton import NEEDED, TARGETS  # noqa: PLC0415

    if words is None:
        return TARGETS
    names = [each.name for each in targets_named(words.split(","), "--targets")]
    if not {*NEEDED} <= {*names}:
        hint = f"write --targets {','.join([*NEEDED, *names])}; pyproject.toml may change it later"
        raise Unusable(f"a new project needs {' and '.join(NEEDED)} for its tests", hint=hint)
    return tuple(names)


def _accepted(name: str, spec: str) -> Model:
    """Return what the spec means. Raises Unusable where a protocol cannot be called so."""
    from framegen.compile import compile_spec  # noqa: PLC0415
    from framegen.reading.source import Source  # noqa: PLC0415
    from framegen.reading.yamltree import Unusable  # noqa: PLC0415

    try:
        compiled = compile_spec(Source("spec", spec))
    except Unusable:
        raise Unusable(f"no protocol can be called so: `{visible(name)}` is no text") from None
    for finding in compiled.findings:
        raise Unusable(f"no protocol can be called so: {finding.message}", hint=finding.hint)
    if _is_installed(name):
        hint = f"choose another name, such as `{name}_protocol`"
        raise Unusable(f"a package `{name}` is installed here, which it would hide", hint=hint)
    return compiled.model


def _is_installed(name: str) -> bool:
    """Return whether Python finds a package of this name; a mere folder is none."""
    from importlib.util import find_spec  # noqa: PLC0415

    found = find_spec(name)
    return found is not None and found.origin is not None


def _folder(root: Path) -> str:
    """Return a folder in the form that pip cannot take for the name of a package."""
    return str(root) if root.is_absolute() or root == Path() else f"./{root.as_posix()}"


def _argument(path: str) -> str:
    """Return a path, quoted for a shell."""
    return f'"{visible(path)}"' if " " in path else visible(path)
