"""The codecs of this project that answer questions: a row for each language."""

from __future__ import annotations

from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

from framegen.render import snippets
from framegen.site.project import Project
from framegen.site.rendering import render_page
from framegen.site.scripts.javascript_module import javascript_module
from framegen.site.site import Site

from tests.factories import library, library_files, write_files
from tests.unit.conformance.harness import run
from tests.unit.site.reference import NODE

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from framegen.compile import Compiled

ANSWER = Path(__file__).parent / "answer.js"


def of_the_library(compiled: Compiled, _folder: Path, questions: Sequence[str]) -> list[list[str]]:
    """Import the library; return what its verb `answer` prints for each question."""
    with library(library_files(compiled)) as module:
        answer = import_module(f"{module.__name__}._cli.answer").answer
        return [answer(question) for question in questions]


def of_the_page(compiled: Compiled, folder: Path, questions: Sequence[str]) -> list[list[str]]:
    """Write the page with the decoder to `folder`; return the answers of its script."""
    return run(page_command(compiled, folder), questions)


def page_command(compiled: Compiled, folder: Path) -> list[str]:
    """Write the page with the decoder to `folder`; return the command that runs its script."""
    page = folder / "decoder.html"
    page.write_text(decoder_page(compiled), encoding="utf-8")
    return [str(NODE), str(ANSWER), str(page)]


def decoder_page(compiled: Compiled) -> str:
    """Return the page with the decoder, as it is in a site, of which it is one of many."""
    site = Site(Project([compiled]), snippets())
    path = f"reference/{compiled.spec.protocol.name}/decoder.html"
    return next(render_page(site, page) for page in site.pages if page.path == path)


def of_the_module(compiled: Compiled, folder: Path, questions: Sequence[str]) -> list[list[str]]:
    """Write the JavaScript module to `folder`; return its answers."""
    write_files(javascript_module(compiled.model), folder)
    module = folder / f"{compiled.spec.protocol.name}.mjs"
    return run([str(NODE), str(ANSWER), str(module)], questions)


# By language, what answers questions with the codec that is made of a spec.
ANSWERERS: dict[str, Callable[[Compiled, Path, Sequence[str]], list[list[str]]]] = {
    "python": of_the_library,
    "page": of_the_page,
    "module": of_the_module,
}
