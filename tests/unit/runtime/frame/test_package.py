"""What the package is to Python and to editors: exports, imports, annotations and documentation."""

import ast
import doctest
import inspect
import sys
import typing
from collections.abc import Iterator
from functools import cache
from importlib import import_module
from pathlib import Path
from typing import Any

import busservo
import pytest
from busservo import MESSAGES, ActionGroupStop, ActionGroupStopped, Direction, Message, ServoMove
from busservo._codec import decode
from busservo.device import Device

from tests.factories import BUSSERVO, data_of
from tests.in_turn import in_turn
from tests.programs import ran

HOME = Path(busservo.__file__).parent


# --- Exports -------------------------------------------------------------------------------------
def stub() -> list[ast.stmt]:
    return ast.parse((HOME / "__init__.pyi").read_text(encoding="utf-8")).body


def imports() -> Iterator[tuple[str, ast.alias]]:
    """The module and the name of everything that the stub imports."""
    for node in stub():
        if isinstance(node, ast.ImportFrom):
            yield from ((f"{'.' * node.level}{node.module}", alias) for alias in node.names)


def test_the_stub_exports_what_the_package_does() -> None:
    assert {alias.name for _, alias in imports()} == {*busservo.__all__} <= {*dir(busservo)}
    # What is not imported under its own name is private to a stub, and editors do not show it.
    assert all(alias.asname == alias.name for _, alias in imports())
    (named,) = [node for node in stub() if isinstance(node, ast.Assign)]
    assert ast.literal_eval(named.value) == busservo.__all__
    assert len(busservo.__all__) == len({*busservo.__all__})
    slip = "Contoller"
    with pytest.raises(AttributeError, match=f"has no attribute '{slip}'"):
        getattr(busservo, slip)


@in_turn("module, alias", imports, ids=lambda row: f"{row[1].name} of {row[0]}")
def test_a_name_of_the_stub_is_that_of_the_package(module: str, alias: ast.alias) -> None:
    owner = import_module(module, "busservo")
    assert getattr(busservo, alias.name) is getattr(owner, alias.name)


def test_the_names_that_others_build_on_are_there() -> None:
    assert [kind.__name__ for kind in MESSAGES] == [*data_of(BUSSERVO)["messages"]]
    assert all(issubclass(kind, Message) for kind in MESSAGES)
    others = """Counters DecodeError Direction EncodeError MESSAGES Message Noise PROTOCOL_VERSION
        ProtocolError Reason ServoPosition ServoTarget StreamDecoder UnknownFrame __version__
        decode"""
    assert {*busservo.__all__} >= {kind.__name__ for kind in MESSAGES} | {*others.split()}
    assert (HOME / "py.typed").exists()


def test_the_version_of_the_protocol_is_that_of_the_specification() -> None:
    assert data_of(BUSSERVO)["protocol"]["version"] == busservo.PROTOCOL_VERSION


UNIONS = {
    "HostMessage": [kind for kind in MESSAGES if kind.DIRECTION is Direction.HOST_TO_CONTROLLER],
    "ControllerMessage": [
        kind for kind in MESSAGES if kind.DIRECTION is Direction.CONTROLLER_TO_HOST
    ],
    "Event": [*MESSAGES, busservo.Noise],
}


@in_turn("name", lambda: UNIONS)
def test_a_union_holds_all_that_can_come_and_no_more(name: str) -> None:
    union = getattr(busservo, name)
    assert set(typing.get_args(union)) == set(UNIONS[name])
    for message in (ActionGroupStop(), ActionGroupStopped()):
        assert isinstance(message, union) == (type(message) in UNIONS[name])
    assert isinstance(
        busservo.UnknownFrame(b"UU\x02c", busservo.Reason.UNKNOWN_COMMAND), union
    ) == (name == "Event")
    assert not isinstance(b"UU\x02\x07", union)


# --- Imports: as few as possible, since every program that starts it waits for them ---------------

# What of the standard library is imported by name; what these import themselves is theirs.
CODEC = {"enum", "functools", "itertools", "operator", "struct"}
CLIENT = CODEC | {"collections", "contextlib", "copy", "errno", "io", "os", "stat", "sys"}
CLIENT |= {"threading", "time", "warnings", "weakref"}
# What these bring, on one system or another.
BROUGHT = {"abc", "collections", "copyreg", "genericpath", "keyword", "nt", "ntpath"}
BROUGHT |= {"org", "posixpath", "reprlib", "types"}
# Who makes a deprecated message is warned.
WARNED = {"warnings"} if any(kind.DEPRECATED for kind in MESSAGES) else set[str]()
# All that needs no port.
NO_PORT = """from busservo import (
    MESSAGES, PROTOCOL_VERSION, Counters, DecodeError, Direction, EncodeError, Message, Noise,
    ProtocolError, Reason, ServoMove, ServoTarget, StreamDecoder, UnknownFrame, decode
)"""


@cache
def modules_after(statement: str) -> set[str]:
    """Return the modules that a statement adds to a bare Python, without those of .pth files."""
    code = f"import sys; bare = {{*sys.modules}}\n{statement}\nprint(*({{*sys.modules}} - bare))"
    program = f"import sys; sys.path[:] = {sys.path!r}\n{code}"
    return {*ran(sys.executable, "-S", "-c", program).stdout.split()}


@in_turn(
    "statement, allowed",
    lambda: [
        ("import busservo", set()),
        ("import busservo._codec", CODEC),
        (NO_PORT, CODEC),
        ("from busservo import Controller, Device, ServoMove, UnknownFrame", CLIENT),
    ],
)
def test_no_more_is_imported_than_is_needed(statement: str, allowed: set[str]) -> None:
    outermost = {name.partition(".")[0] for name in modules_after(statement)}
    brought = {name for name in outermost if not name.startswith("_")}
    assert brought - {"busservo", "framewire"} <= allowed | BROUGHT | WARNED


def test_the_package_alone_imports_no_module_of_its_own() -> None:
    found = modules_after("import busservo")
    assert {name for name in found if name.startswith(("busservo", "framewire"))} == {"busservo"}


@in_turn(
    "names, module, later",
    lambda: [
        ("*", "framewire.line.serial_port", "serial"),
        ("Controller, open_controller", "framewire.line.hid_devices", "pathlib"),
        ("ActionGroupStop; ActionGroupStop()", "framewire.frame.message", "html"),
    ],
)
def test_what_few_need_is_imported_by_those_who_need_it(
    names: str, module: str, later: str
) -> None:
    found = modules_after(f"from busservo import {names}\nimport framewire.line.serial_port")
    assert module in found
    assert later not in found


# --- Annotations, which can be evaluated at run time: whoever builds on it may well do so ---------

MODULES = ("busservo", *(f"busservo.{name}" for name in ("messages", "device", "recordings")))


def public() -> Iterator[tuple[str, Any]]:
    """Every public class and function, and the public methods and properties of the classes."""
    for module in map(import_module, MODULES):
        for name in getattr(module, "__all__", vars(module)):
            value = getattr(module, name)
            owner = getattr(value, "__module__", "") if callable(value) else ""
            if owner == module.__name__ or (owner and hasattr(module, "__all__")):
                yield f"{module.__name__}.{name}", value
                if inspect.isclass(value):
                    yield from methods(value)


def methods(owner: type) -> Iterator[tuple[str, Any]]:
    for base in owner.__mro__:
        if base.__module__.startswith(("busservo", "framewire")):
            for name, value in vars(base).items():
                inner = getattr(value, "fget", None) or getattr(value, "__func__", value)
                if (not name.startswith("_") or name.endswith("__")) and inspect.isfunction(inner):
                    yield f"{base.__name__}.{name}", inner


PUBLIC = dict(public())


def test_annotations_can_be_looked_up() -> None:
    assert {"busservo.decode", "busservo.StreamDecoder", "StreamDecoder.feed"} <= PUBLIC.keys()
    assert {"ServoMove.__new__", "Controller.move_servos", "Entry.__init__"} <= PUBLIC.keys()
    for name, value in PUBLIC.items():
        hints = typing.get_type_hints(value)
        assert inspect.get_annotations(value).keys() <= hints.keys(), name
        assert not any(isinstance(hint, str) for hint in hints.values()), name


def test_annotations_are_what_they_say() -> None:
    data = bytes | bytearray | memoryview
    # The direction is as in all that is the same for every protocol.
    way = Direction.__mro__[1] | None
    assert typing.get_type_hints(decode) == {"frame": data, "direction": way, "return": Message}
    # Which messages there may be is told to type checkers alone.
    assert typing.get_type_hints(busservo.StreamDecoder.feed) == {"data": data, "return": list[Any]}
    assert typing.get_type_hints(Device.take) == {"return": list[Any]}
    made = typing.get_type_hints(ServoMove.__new__)
    assert made["time_ms"] is int
    assert made["return"] is getattr(typing, "Self", typing.Any)
    assert typing.get_type_hints(ServoMove)["COMMAND"] == typing.ClassVar[int]
    assert typing.get_type_hints(busservo.TransportError.__init__)["errno"] == int | None
    assert typing.get_type_hints(busservo.Controller.read_battery_voltage)["return"] is int


# --- Documentation -------------------------------------------------------------------------------

NO_TYPES = {"MESSAGES", "PROTOCOL_VERSION", "__version__", *UNIONS}
# The examples of the clients need a controller: tests/unit/runtime/client/test_library.py has one.
ELSEWHERE = {"busservo.__main__", "busservo._controller", "busservo._async_controller"}


@in_turn("name", lambda: [*sorted({*busservo.__all__} - NO_TYPES), "__doc__"])
def test_a_public_name_is_documented(name: str) -> None:
    public = busservo if name == "__doc__" else getattr(busservo, name)
    assert inspect.getdoc(public)
    for own, value in vars(public).items():
        has_code = callable(value) or isinstance(value, (property, classmethod, staticmethod))
        if isinstance(public, type) and not own.startswith("_") and has_code:
            assert inspect.getdoc(value), f"{name}.{own}"


def with_examples() -> Iterator[str]:
    """Yield the modules that have examples; to import all others would take longer than these."""
    for file in HOME.rglob("*.py"):
        name = ".".join(file.relative_to(HOME.parent).with_suffix("").parts)
        if name not in ELSEWHERE and ">>>" in file.read_text(encoding="utf-8"):
            yield name.removesuffix(".__init__")


@in_turn("name", with_examples)
def test_examples_are_true(name: str) -> None:
    assert doctest.testmod(import_module(name)).failed == 0


def test_every_message_has_an_example() -> None:
    for kind in MESSAGES:
        assert doctest.DocTestParser().get_examples(kind.__doc__ or "")
