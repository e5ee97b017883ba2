"""Imports of the library: as few as possible, since every program that starts it waits for them."""

import subprocess
import sys

import busservo
import pytest

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


def imported(statement: str) -> set[str]:
    """Return the modules that a statement adds to a bare Python; of packages, the outermost."""
    code = f"import sys; bare = {{*sys.modules}}\n{statement}\nprint(*({{*sys.modules}} - bare))"
    done = subprocess.run(
        [sys.executable, "-S", "-c", f"import sys; sys.path[:] = {sys.path!r}\n{code}"],
        capture_output=True,
        text=True,
        check=True,
    )
    return {name.partition(".")[0] for name in done.stdout.split()}


@pytest.mark.parametrize(
    ("statement", "allowed"),
    [
        ("import busservo", set()),
        ("import busservo._codec.codec", CODEC),
        ("from busservo import StreamDecoder, decode", CODEC),
        ("from busservo import Controller", CLIENT),
        ("from busservo import Controller, Device, ServoMove, UnknownFrame", CLIENT),
    ],
)
def test_no_more_is_imported_than_is_needed(statement: str, allowed: set[str]) -> None:
    brought = {name for name in imported(statement) if not name.startswith("_")}
    assert brought - {"busservo"} <= allowed | BROUGHT | WARNED
