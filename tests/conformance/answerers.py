"""The codecs of this project that answer questions: a row for each language."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING

from framegen.render import render
from framegen.targets import python

from tests.docs.peers import page_command

if TYPE_CHECKING:
    from collections.abc import Callable
    from pathlib import Path

    from framegen.compile import Compiled


def python_command(compiled: Compiled, folder: Path) -> list[str]:
    """Write the library to `folder`; the command that answers with it."""
    for path, text in render(compiled, [python.TARGET]).files.items():
        (folder / path).parent.mkdir(parents=True, exist_ok=True)
        (folder / path).write_text(text, encoding="utf-8", newline="")
    name = compiled.spec.protocol.name
    code = f"import sys; sys.path.insert(0, sys.argv.pop(1)); from {name}.cli import main; "
    return [sys.executable, "-c", f"{code}sys.exit(main())", str(folder / "generated"), "answer"]


# By language, the program that answers with what is made of a spec.
ANSWERERS: dict[str, Callable[[Compiled, Path], list[str]]] = {
    "python": python_command,
    "javascript": page_command,
}
