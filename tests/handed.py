"""What a library hands to the runtime, and what the verbs of its command make of that."""

from collections.abc import Callable
from importlib import import_module
from typing import Any


def handed_by(package: str) -> Any:
    """Return what the library of that name hands to the runtime."""
    return import_module(f"{package}._library").LIBRARY


def program_of(package: str) -> Any:
    """Return what it hands to its command."""
    return import_module(f"{package}._command").PROGRAM


def answers_of(package: str) -> Callable[[str], list[str]]:
    """Return what its verb `answer` answers to a question."""
    answerer = import_module("framewire.command.answer").Answerer(handed_by(package))
    answer: Callable[[str], list[str]] = answerer.answer
    return answer


def explanations_of(package: str) -> Callable[[bytes], Any]:
    """Return how its verb `explain` explains bytes, by the model that the library carries."""
    explained = import_module("framewire.command.explain").explained
    library = handed_by(package)
    model = library.protocol()
    return lambda data: explained(model, data, library.codec)
