"""No message of a spec can have a name that a generated module needs for itself."""

from __future__ import annotations

import ast
from pathlib import Path
from typing import TYPE_CHECKING

import busservo
import pytest
from framegen.names import LIBRARY_NAMES, PYTHON_CLASSES

if TYPE_CHECKING:
    from collections.abc import Iterator

PACKAGE = Path(busservo.__file__).parent
# Those that import the messages by name.
MODULES = sorted(
    path.name
    for path in PACKAGE.glob("*.py")
    if "from .messages import" in path.read_text(encoding="utf-8") or path.name == "messages.py"
)
MINE = {kind.__name__ for kind in busservo.MESSAGES} | {"ServoTarget", "ServoPosition"}


def statements(body: list[ast.stmt]) -> Iterator[ast.stmt]:
    """The statements of a module, those below an `if` included."""
    for node in body:
        yield node
        if isinstance(node, ast.If):
            yield from statements([*node.body, *node.orelse])


def names_of(module: str) -> set[str]:
    """What a module imports and defines at its top, and for type checkers alone."""
    found: set[str] = set()
    for node in statements(ast.parse((PACKAGE / module).read_text(encoding="utf-8")).body):
        if isinstance(node, ast.Import | ast.ImportFrom):
            found |= {each.asname or each.name for each in node.names}
        elif isinstance(node, ast.ClassDef):
            found.add(node.name)
        elif isinstance(node, ast.AnnAssign | ast.Assign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            found |= {each.id for each in targets if isinstance(each, ast.Name)}
    # A message begins with a capital letter: no other name can be taken for one.
    return {name for name in found if name[0].isupper()}


def test_the_modules_that_know_messages_are_known() -> None:
    assert {"device.py", "exchanges.py", "controller.py", "messages.py"} <= set(MODULES)


@pytest.mark.parametrize("module", MODULES)
def test_what_a_module_needs_is_reserved(module: str) -> None:
    # Nor has the name of a message a line below it.
    needed = {name for name in names_of(module) - MINE if "_" not in name}
    assert needed - LIBRARY_NAMES - PYTHON_CLASSES == set()
