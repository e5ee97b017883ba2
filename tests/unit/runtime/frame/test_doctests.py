"""The examples in the docstrings of the library, run."""

import doctest
from importlib import import_module
from pkgutil import walk_packages

import busservo

from tests.in_turn import in_turn

# The examples of the clients need a controller: tests/unit/runtime/client/test_examples.py has one.
ELSEWHERE = {
    "busservo.__main__",
    "busservo._client.controller",
    "busservo._client.async_controller",
}
MODULES = [
    module.name
    for module in walk_packages(busservo.__path__, "busservo.")
    if module.name not in ELSEWHERE
]


@in_turn("name", lambda: ["busservo", *MODULES])
def test_examples_are_true(name: str) -> None:
    assert doctest.testmod(import_module(name)).failed == 0


def test_every_message_has_an_example() -> None:
    for kind in busservo.MESSAGES:
        assert doctest.DocTestParser().get_examples(kind.__doc__ or "")
