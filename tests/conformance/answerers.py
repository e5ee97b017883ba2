"""The codecs of this project that answer questions: a row for each language."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.render import snippets
from framegen.targets.docs.html_pages import render_site

from tests.docs.reference import NODE
from tests.factories import library_files, write_files

if TYPE_CHECKING:
    from collections.abc import Callable

    from framegen.compile import Compiled

ANSWER = Path(__file__).parent / "answer.js"


def python_command(compiled: Compiled, folder: Path) -> list[str]:
    """Write the library to `folder`; return the command that answers with it."""
    write_files(library_files(compiled), folder)
    name = compiled.spec.protocol.name
    code = f"import sys; sys.path.insert(0, sys.argv.pop(1)); from {name}._cli import main; "
    return [sys.executable, "-c", f"{code}sys.exit(main())", str(folder / "generated"), "answer"]


def page_command(compiled: Compiled, folder: Path) -> list[str]:
    """Write the page with the decoder to `folder`; return the command that runs its script."""
    page = folder / "decoder.html"
    path = f"{compiled.spec.protocol.name}/{page.name}"
    page.write_text(render_site([compiled], snippets())[path], encoding="utf-8")
    return [str(NODE), str(ANSWER), str(page)]


# By language, the program that answers with what is made of a spec.
ANSWERERS: dict[str, Callable[[Compiled, Path], list[str]]] = {
    "python": python_command,
    "page": page_command,
}
