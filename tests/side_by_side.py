"""The libraries of many specs side by side, so that one run of a tool checks all of them."""

import ast
import importlib
import importlib.util
import json
import re
import subprocess
import sys
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from types import ModuleType

import pytest

from tests.factories import ROOT
from tests.programs import ran

COMMAND = "_command.py"


@dataclass(frozen=True)
class Library:
    """The generated library of one spec: its modules."""

    name: str
    modules: dict[str, str]

    def write(self, folder: Path) -> None:
        """Write it, as a package of its name."""
        (folder / self.name).mkdir(parents=True)
        for path, text in self.modules.items():
            (folder / self.name / path).write_text(text, encoding="utf-8", newline="")

    @cached_property
    def code(self) -> str:
        """The code without the contents of its texts, as type checkers see it."""
        return "\n".join(_code(text) for text in self.modules.values())


def library_of(name: str, files: dict[str, str]) -> Library:
    """Return the library among the files of a spec, under the name `name`."""
    [root] = {path.rpartition("/")[0] for path in files if path.endswith("/py.typed")}
    made = {path.removeprefix(f"{root}/"): text for path, text in files.items()}
    modules = {path: text for path, text in made.items() if path.endswith((".py", ".pyi"))}
    return Library(name, modules)


class _Said(ast.NodeTransformer):
    """A transformer that replaces every f-string by a constant."""

    def visit_JoinedStr(self, _node: ast.JoinedStr) -> ast.Constant:
        return ast.Constant("")


def _code(text: str) -> str:
    tree = _Said().visit(ast.parse(text))
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str | bytes):
            node.value = ""
        elif isinstance(node, ast.Constant) and type(node.value) is int and node.value > 99:
            node.value = 99
    return ast.dump(tree)


@contextmanager
def imported(library: Library, folder: Path) -> Iterator[ModuleType]:
    """Import every module of a library written below `folder`."""
    sys.path.insert(0, str(folder))
    try:
        made = importlib.import_module(library.name)
        for path in library.modules:
            if not path.startswith("__init__."):
                importlib.import_module(f"{library.name}.{path.removesuffix('.py')}")
        yield made
    finally:
        sys.path.remove(str(folder))
        for name in [name for name in sys.modules if name.split(".")[0] == library.name]:
            del sys.modules[name]


def _run(command: list[str], folder: Path) -> subprocess.CompletedProcess[str]:
    pytest.importorskip(command[0], reason="`pip install --group lint`")
    return ran(sys.executable, "-m", *command, status=None, cwd=folder, errors="replace")


def _by_library(found: Iterable[tuple[str, str]], folder: Path) -> dict[str, list[str]]:
    by_library: dict[str, list[str]] = {}
    for file, what in found:
        path = Path(file)
        inside = path.relative_to(folder.resolve()) if path.is_absolute() else path
        by_library.setdefault(inside.parts[0], []).append(f"{inside.as_posix()}: {what}")
    return by_library


def linted(folder: Path) -> dict[str, list[str]]:
    """Return the findings of ruff in the libraries of a folder, by library."""
    config = ["--no-cache", "--config", str(ROOT / "pyproject.toml")]
    done = _run(["ruff", "check", *config, "--output-format", "json", "."], folder)
    assert done.returncode in (0, 1), done.stderr
    found = [
        (each["filename"], f"{each['location']['row']}: {each['code']} {each['message']}")
        for each in json.loads(done.stdout)
    ]
    shaped = _run(["ruff", "format", "--check", *config, "."], folder)
    assert shaped.returncode in (0, 1), shaped.stderr
    again = re.findall(r"^Would reformat: (.*)$", shaped.stdout, re.MULTILINE)
    return _by_library([*found, *((file, "ruff would format it") for file in again)], folder)


def type_checked(folder: Path, cache: Path) -> dict[str, list[str]]:
    """Return the findings of mypy and pyright in the libraries of a folder, by library."""
    names = sorted(path.name for path in folder.iterdir())
    if not names:
        return {}
    done = _run(
        ["mypy", "--strict", "--config-file", str(ROOT / "tests" / "untyped.ini")]
        + ["--no-error-summary", "--cache-dir", str(cache)]
        + [word for name in names for word in ("-p", name)],
        folder,
    )
    assert done.returncode in (0, 1), done.stdout + done.stderr
    found = [(line.split(":")[0], line) for line in done.stdout.splitlines() if ": error:" in line]
    made = [file for name in names for file in sorted((folder / name).glob("*.py"))]
    files = [str(file) for file in made if file.name != COMMAND]
    looked = _run(["pyright", "--outputjson", "--pythonpath", sys.executable, *files], folder)
    assert looked.returncode in (0, 1), looked.stdout + looked.stderr
    found += [
        (each["file"], f"{each['range']['start']['line'] + 1}: {each['message']}")
        for each in json.loads(looked.stdout)["generalDiagnostics"]
    ]
    return _by_library(found, folder)
