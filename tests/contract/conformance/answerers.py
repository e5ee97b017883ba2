"""The codecs of this project that answer questions: a row for each language."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TypeAlias

from framegen.compile import Compiled
from framegen.render import snippets
from framegen.site.project import Project
from framegen.site.rendering import render_page
from framegen.site.scripts.javascript_module import javascript_module
from framegen.site.site import Site

from tests.factories import library, library_files
from tests.handed import answers_of
from tests.unit.conformance.harness import run
from tests.unit.site.reference import NODE

# Specs with the questions to each, and a folder to work in, as answers to all of them.
Answerer: TypeAlias = Callable[[Sequence[tuple[Compiled, list[str]]], Path], list[list[str]]]

ANSWER = Path(__file__).parent / "answer.js"


def of_libraries(asked: Sequence[tuple[Compiled, list[str]]], _folder: Path) -> list[list[str]]:
    """Import each library; return what its verb `answer` prints for each question."""
    answers = []
    for compiled, questions in asked:
        with library(library_files(compiled)) as module:
            answer = answers_of(module.__name__)
            answers += [answer(question) for question in questions]
    return answers


def of_node(ending: str, text_of: Callable[[Compiled], str]) -> Answerer:
    """Return what asks one Node about files with such an ending, of a text for each spec."""

    def answers(asked: Sequence[tuple[Compiled, list[str]]], folder: Path) -> list[list[str]]:
        files, lines = [], []
        for number, (compiled, questions) in enumerate(asked):
            files.append(folder / f"{number}.{ending}")
            files[-1].write_text(text_of(compiled), encoding="utf-8")
            lines += [f"use {number}", *questions]
        said = run([str(NODE), str(ANSWER), *map(str, files)], lines)
        return [each for line, each in zip(lines, said, strict=True) if line[:4] != "use "]

    return answers


def decoder_page(compiled: Compiled) -> str:
    """Return the page with the decoder, as it is in a site, of which it is one of many."""
    site = Site(Project([compiled]), snippets())
    path = f"reference/{compiled.spec.protocol.name}/decoder.html"
    return next(render_page(site, page) for page in site.pages if page.path == path)


def module_of(compiled: Compiled) -> str:
    return javascript_module(compiled.model)[f"{compiled.spec.protocol.name}.mjs"]


# By language, what answers questions with the codecs that are made of specs.
ANSWERERS: dict[str, Answerer] = {
    "python": of_libraries,
    "page": of_node("html", decoder_page),
    "module": of_node("mjs", module_of),
}
