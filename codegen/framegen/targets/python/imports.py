"""The imports of a module: in the order that linters want, from where the runtime is."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from jinja2 import pass_context

from framegen.targets.python.carried_runtime import FOLDER

if TYPE_CHECKING:
    from collections.abc import Iterator

    from jinja2.runtime import Context

SHARED = "framewire"
"""Where the runtime is that libraries share."""
CARRIED = f".{FOLDER}"
"""Where it is in a library that carries its own."""


@pass_context
def imports(context: Context, text: str) -> str:
    """Order the import statements of a block, whose lines are indented alike."""
    margin = text[: len(text) - len(text.lstrip(" "))]
    runtime = context.resolve("runtime")
    moved = text.replace(f"from {SHARED}.", f"from {runtime}.")
    moved = moved.replace(f"from {SHARED} import", f"from {runtime} import")
    sections: dict[int, list[str]] = {}
    for statement in sorted(_statements(moved), key=_order):
        sections.setdefault(_order(statement)[0], []).append(margin + statement)
    return "\n\n".join("\n".join(found) for _, found in sorted(sections.items())) + "\n"


def _statements(text: str) -> Iterator[str]:
    """Yield each statement, without the margin of its first line."""
    lines = iter(text.splitlines())
    for line in lines:
        statement = line.lstrip()
        while "(" in statement and ")" not in statement:
            statement += f"\n{next(lines)}"
        if statement:
            yield statement


def _order(statement: str) -> tuple[int, bool, str]:
    """Return the section of a statement, and its place there: plain imports stand first."""
    keyword, module = statement.split(maxsplit=2)[:2]
    root = module.partition(".")[0]
    section = 2 if not root else 0 if root in sys.stdlib_module_names else 1
    return section, keyword == "from", module
