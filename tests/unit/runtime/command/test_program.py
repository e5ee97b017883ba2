"""What a library hands to its command, and that nothing else in it is of one protocol."""

from importlib import import_module
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[4]


@pytest.mark.parametrize("package", ["busservo", "lxservo"])
def test_a_command_is_called_as_its_library_is(package: str) -> None:
    program = import_module(f"{package}._command").PROGRAM
    assert program.library is import_module(f"{package}._library").LIBRARY
    assert (program.name, program.package) == (package, package)
    assert program.settings_file == f"{package}.toml"
    assert program.port_variable == f"{package.upper()}_PORT"
    assert program.simulator == f"{package}_simulator"
    assert {*program.examples} == {*program.verbs}
    assert {*program.methods, *program.pose_methods, *program.long.values()} <= {*program.verbs}
    assert f"{program!r}" == f"<the command {package} of the library {package}>"
