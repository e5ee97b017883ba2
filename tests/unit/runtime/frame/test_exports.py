"""What the package exports: the same to Python and, by its stub, to editors and type checkers."""

import ast
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import get_args

import busservo
import pytest
from busservo import (
    MESSAGES,
    ActionGroupStop,
    ActionGroupStopped,
    Direction,
    Noise,
    Reason,
    UnknownFrame,
)

from tests.in_turn import in_turn

STUB = Path(busservo.__file__).with_suffix(".pyi")


def stub() -> list[ast.stmt]:
    return ast.parse(STUB.read_text(encoding="utf-8")).body


def imports() -> Iterator[tuple[str, ast.alias]]:
    """The module and the name of everything that the stub imports."""
    for node in stub():
        if isinstance(node, ast.ImportFrom):
            yield from ((f"{'.' * node.level}{node.module}", alias) for alias in node.names)


def test_the_stub_exports_what_the_package_does() -> None:
    assert [alias.name for _, alias in imports()] != []
    assert {alias.name for _, alias in imports()} == {*busservo.__all__}
    # What is not imported under its own name is private to a stub, and editors do not show it.
    assert all(alias.asname == alias.name for _, alias in imports())
    (named,) = [node for node in stub() if isinstance(node, ast.Assign)]
    assert ast.literal_eval(named.value) == busservo.__all__


@in_turn("module, alias", imports, ids=lambda row: f"{row[1].name} of {row[0]}")
def test_a_name_of_the_stub_is_that_of_the_package(module: str, alias: ast.alias) -> None:
    owner = import_module(module, "busservo")
    assert getattr(busservo, alias.name) is getattr(owner, alias.name)


def test_the_version_of_the_protocol_is_that_of_the_specification() -> None:
    spec = Path(__file__).parents[4] / "spec" / "busservo.yaml"
    assert f'version: "{busservo.PROTOCOL_VERSION}"' in spec.read_text(encoding="utf-8")


# ------------------------------------------------------------------ closed unions

UNIONS = {
    "HostMessage": [kind for kind in MESSAGES if kind.DIRECTION is Direction.HOST_TO_CONTROLLER],
    "ControllerMessage": [
        kind for kind in MESSAGES if kind.DIRECTION is Direction.CONTROLLER_TO_HOST
    ],
    "Event": [*MESSAGES, Noise],
}


@pytest.mark.parametrize("name", UNIONS)
def test_a_union_holds_all_that_can_come_and_no_more(name: str) -> None:
    union = getattr(busservo, name)
    assert set(get_args(union)) == set(UNIONS[name])
    for message in (ActionGroupStop(), ActionGroupStopped()):
        assert isinstance(message, union) == (type(message) in UNIONS[name])
    assert isinstance(UnknownFrame(b"UU\x02c", Reason.UNKNOWN_COMMAND), union) == (name == "Event")
    assert not isinstance(b"UU\x02\x07", union)
