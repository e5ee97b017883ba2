"""What a new project begins with: the files of its author, made from templates for a name."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.targets.templates import environment

if TYPE_CHECKING:
    from collections.abc import Collection

    from jinja2 import Environment

NEEDED = ("python", "vectors")
"""The targets that its tests and its virtual device need."""
TARGETS = (*NEEDED, "schema")
"""Those of a project that chooses none: a site has the reference as well."""

_FILES = Path(__file__).parent / "files"
# What stands for the name in the path of a template.
_NAME = "NAME"
_SUFFIX = ".jinja"


def spec_path(name: str) -> str:
    """Return where the spec lies in the project."""
    return f"spec/{name}.yaml"


def skeleton(name: str, targets: Collection[str] = TARGETS) -> dict[str, str]:
    """Return the files of a project by path; `name` must be a good name of a protocol.

    `targets` are the names of those that the project chooses, with the `NEEDED` ones among them.
    """
    templates = _environment()
    title = name.replace("_", " ").capitalize()
    return {
        path.removesuffix(_SUFFIX).replace(_NAME, name): templates.get_template(path).render(
            name=name, title=title, targets=[*targets]
        )
        for path in sorted(templates.list_templates(extensions=[_SUFFIX[1:]]))
    }


@cache
def _environment() -> Environment:
    # A name and a title of letters, digits, `_` and blanks need no escaping anywhere.
    return environment(_FILES, "skeleton", autoescape=False)
