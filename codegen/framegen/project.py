"""The project around a spec: which spec is meant when none is named, and where its root is."""

from __future__ import annotations

from pathlib import Path

from framegen.reading.yamltree import Unusable

FOLDER = "spec"


def default_spec() -> Path:
    """Find the only spec/*.yaml here, or else in the nearest folder above. Raises Unusable."""
    found = all_specs()
    if len(found) > 1:
        names = ", ".join(file.name for file in found)
        raise Unusable(
            f"there are {len(found)} specs to choose from: {names}",
            hint=f"name the one you mean, such as {found[0].as_posix()}",
        )
    return found[0]


def all_specs() -> list[Path]:
    """Find every spec/*.yaml here, or else in the nearest folder above. Raises Unusable."""
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
        hint="name a spec file, or run this where the project is",
    )


def project_root(spec: Path) -> Path:
    """Find what output paths are relative to: the folder above `spec/`, or else the spec's own."""
    folder = spec.parent.resolve()
    return folder.parent if folder.name == FOLDER else folder
