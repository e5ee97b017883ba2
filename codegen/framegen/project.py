"""The project around a spec: its root, its specs, and the one to use when none is named."""

from __future__ import annotations

import os
import re
from pathlib import Path

from framewire.command.console import visible

from framegen.reading.yamltree import Unusable

FOLDER = "spec"
GUIDES = "docs"
# What all libraries of a project import, if it has that.
_RUNTIME = Path("runtime", "framewire")
# A key that every spec has, and hardly another file.
_LIKE_A_SPEC = re.compile(rb"^framegen:", re.MULTILINE)
_HEAD = 4_000


def all_specs() -> list[Path]:
    """Find spec/*.yaml here, or else in the nearest folder above. Raises Unusable for none."""
    try:
        here = Path.cwd()
    except OSError:
        raise Unusable("the current folder is gone", hint="name the spec in full") from None
    for steps, folder in enumerate((here, *here.parents)):
        found = sorted(file.name for file in (folder / FOLDER).glob("*.yaml"))
        if found:
            # Relative, so that what is printed reads the same on every machine.
            return [Path(*[".."] * steps, FOLDER, name) for name in found]
    raise Unusable(
        f"no spec is named, and neither this folder nor any above it has {FOLDER}/*.yaml",
        hint=_remedy(here),
    )


def default_spec() -> Path:
    """Find the only spec/*.yaml here, or else in the nearest folder above. Raises Unusable."""
    specs = all_specs()
    if len(specs) > 1:
        names = ", ".join(visible(spec.name) for spec in specs)
        raise Unusable(
            f"there are {len(specs)} specs to choose from: {names}",
            hint=f"name the one you mean, such as `{visible(specs[0].stem)}`",
        )
    return specs[0]


def named_spec(word: str) -> Path | None:
    """Find the spec of the project that is called so: `busservo` is spec/busservo.yaml."""
    try:
        return next((spec for spec in all_specs() if spec.stem == word), None)
    except Unusable:
        return None


def project_root(spec: Path) -> Path:
    """Return the root of output paths: the folder above `spec/`, or that of the spec."""
    folder = spec.parent.resolve()
    return folder.parent if folder.name == FOLDER else folder


def carries_runtime(spec: Path) -> bool:
    """Tell whether the library of a spec brings the runtime: the project has none to share."""
    return not (project_root(spec) / _RUNTIME).is_dir()


def near(folder: Path) -> Path:
    """Return a folder relative to the current one, where that is shorter."""
    try:
        relative = Path(os.path.relpath(folder))
    except ValueError:  # on another drive
        return folder
    return min(relative, folder, key=lambda path: len(str(path)))


def docs_folder(spec: Path) -> Path:
    """Return the folder where a project has its guides and the settings of its site, if any."""
    return near(project_root(spec)) / GUIDES


def guides_folder(spec: Path) -> Path | None:
    """Return the folder of the guides of a project, if it has a README that lists them."""
    folder = docs_folder(spec)
    return folder if (folder / "README.md").is_file() else None


def _remedy(here: Path) -> str:
    """Suggest what to name. A spec that merely lies here is not used: it may be a draft."""
    lying = [file.name for file in sorted(here.glob("*.yaml")) if _is_like_a_spec(file)]
    if lying:
        return f"name the spec, such as {visible(lying[0])}, which lies here"
    return "name a spec file, or run this where the project is"


def _is_like_a_spec(file: Path) -> bool:
    try:
        if not file.is_file():
            return False
        with file.open("rb") as stream:
            return _LIKE_A_SPEC.search(stream.read(_HEAD)) is not None
    except OSError:
        return False
