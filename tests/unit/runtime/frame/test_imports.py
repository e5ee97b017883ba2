"""Imports of the library: as few as possible, since every program that starts it waits for them."""

import sys
from functools import cache

import busservo
import pytest

from tests.programs import ran

# What of the standard library is imported by name; what these import themselves is theirs.
CODEC = {"enum", "functools", "itertools", "operator", "struct"}
CLIENT = CODEC | {
    "collections",
    "contextlib",
    "copy",
    "errno",
    "io",
    "os",
    "stat",
    "sys",
    "threading",
    "time",
    "warnings",
    "weakref",
}
# What these bring, on one system or another.
BROUGHT = {"abc", "collections", "copyreg", "genericpath", "keyword", "nt", "ntpath"}
BROUGHT |= {"org", "posixpath", "reprlib", "types"}
# Who makes a deprecated message is warned.
WARNED = {"warnings"} if any(kind.DEPRECATED for kind in busservo.MESSAGES) else set[str]()


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


@pytest.mark.parametrize(
    ("statement", "allowed"),
    [
        ("import busservo", set()),
        ("import busservo._codec", CODEC),
        (NO_PORT, CODEC),
        ("from busservo import Controller", CLIENT),
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


def test_a_port_has_to_be_opened_before_pyserial_is_imported() -> None:
    modules = modules_after("from busservo import *\nimport framewire.line.serial_port")
    assert "framewire.line.serial_port" in modules
    assert "serial" not in modules


def test_what_opens_a_port_imports_nothing_that_looks_for_devices() -> None:
    modules = modules_after(
        "from busservo import Controller, open_controller\nimport framewire.line.serial_port"
    )
    assert "framewire.line.hid_devices" in modules
    assert "pathlib" not in modules
