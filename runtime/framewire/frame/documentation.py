"""Find the string below an attribute in the source: its documentation, which Python discards."""

from __future__ import annotations

import ast
import inspect
from itertools import pairwise
from textwrap import dedent


def documentation(owner: type, name: str) -> str | None:
    """Return the string below the line that assigns `name` in a class; None without a source."""
    try:
        (declared,) = ast.parse(dedent(inspect.getsource(owner))).body
    except (OSError, TypeError, SyntaxError):  # what is there now may be something else
        return None
    body = declared.body if isinstance(declared, ast.ClassDef) else []
    for line, below in pairwise(body):
        if (
            isinstance(line, ast.Assign)
            and isinstance(below, ast.Expr)
            and isinstance(below.value, ast.Constant)
            and isinstance(below.value.value, str)
            and name in [target.id for target in line.targets if isinstance(target, ast.Name)]
        ):
            return inspect.cleandoc(below.value.value)
    return None
