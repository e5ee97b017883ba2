"""The examples in the docstrings of the library, run."""

import doctest
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import busservo

from tests.in_turn import in_turn

# The examples of the clients need a controller: tests/unit/runtime/client/test_examples.py has one.
ELSEWHERE = {
    "busservo.__main__",
    "busservo._controller",
    "busservo._async_controller",
}


def with_examples() -> Iterator[str]:
    """Yield the modules that have examples; to import all others would take longer than these."""
    home = Path(busservo.__file__).parent
    for file in home.rglob("*.py"):
        name = ".".join(file.relative_to(home.parent).with_suffix("").parts)
        if name not in ELSEWHERE and ">>>" in file.read_text(encoding="utf-8"):
            yield name.removesuffix(".__init__")


@in_turn("name", with_examples)
def test_examples_are_true(name: str) -> None:
    assert doctest.testmod(import_module(name)).failed == 0


def test_every_message_has_an_example() -> None:
    for kind in busservo.MESSAGES:
        assert doctest.DocTestParser().get_examples(kind.__doc__ or "")
