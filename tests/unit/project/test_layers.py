"""Imports point only downwards, in the generator and in the libraries that it makes."""

import ast
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest

GENERATOR = Path(__file__).parents[3] / "codegen" / "framegen"

# From the bottom up. The parts of one layer do not import each other.
LAYERS = [
    {"__version__"},
    {"reading"},
    {"project", "language"},
    {"model"},
    {"checks", "cases"},
    {"compile", "explain", "witnesses"},
    {"audit", "guess", "output"},
    {"conformance"},
    {"targets.target", "targets.templates", "targets.filenames"},
    {"targets.python", "targets.docs", "targets.vectors", "targets.schema"},
    {"targets.table"},
    {"render", "skeleton"},
    {"comparison"},
    {"site"},
    {"writing"},
    {"commands"},
    {"completion"},
    {"cli"},
    {"__main__"},
]

# The only parts that may import a name: all others are given the result.
ALONE = {
    "yaml": {"reading"},
    "framegen.language.load.load": {"compile"},
    "framegen.model.model.derive": {"compile"},
    "framegen.checks.check_model": {"compile"},
    "framegen.checks.check_structure": {"compile"},
    "framegen.reading.yamltree.read_tree": {"language", "witnesses"},
    "framegen.model.roles.settle": {"model"},
}


def modules() -> Iterator[tuple[str, Path]]:
    """Yield every module of the generator with its part."""
    for file in sorted(GENERATOR.rglob("*.py")):
        parts = file.relative_to(GENERATOR).with_suffix("").parts
        if parts not in (("__init__",), ("targets", "__init__")):
            yield _part(parts), file


def _part(parts: tuple[str, ...]) -> str:
    return ".".join(parts[:2]) if parts[0] == "targets" else parts[0]


@cache
def statements(file: Path, *, to_run: bool = False) -> list[ast.Import | ast.ImportFrom]:
    """Return every import in a module, wherever it stands: for typing alone or not, or `to_run`."""
    found: list[ast.Import | ast.ImportFrom] = []
    bodies: list[ast.AST] = [ast.parse(file.read_text(encoding="utf-8"))]
    # An expression holds no statement.
    while bodies:
        for node in ast.iter_child_nodes(bodies.pop()):
            if isinstance(node, ast.Import | ast.ImportFrom):
                found.append(node)
            elif to_run and isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                bodies += node.orelse
            elif not isinstance(node, ast.expr):
                bodies.append(node)
    return found


def imported(file: Path) -> Iterator[str]:
    """Yield everything that a module imports, in full."""
    for node in statements(file):
        module = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
        yield from (f"{module}{alias.name}" for alias in node.names)


MODULES = list(modules())


def upwards(
    layers: list[set[str]], modules: Iterable[tuple[str, Path, Iterable[str]]]
) -> list[tuple[str, str]]:
    """Return the imports that do not point downwards, of (part, file, parts that it imports).

    Each part has its layer, and each layer its parts.
    """
    layer = {part: height for height, those in enumerate(layers) for part in those}
    known = [*modules]
    assert {part for part, _, _ in known} == set(layer)
    return [
        (file.as_posix(), other)
        for part, file, others in known
        for other in others
        if other != part and layer[other] >= layer[part]
    ]


def parts_imported(file: Path) -> Iterator[str]:
    """Yield the parts of the generator that one of its modules imports."""
    names = (name.split(".") for name in imported(file))
    yield from (_part(tuple(inner)) for package, *inner in names if package == "framegen")


def test_imports_point_downwards() -> None:
    package = [("__version__", GENERATOR / "__init__.py")]
    found = ((part, file, parts_imported(file)) for part, file in [*package, *MODULES])
    assert upwards(LAYERS, found) == []


@pytest.mark.parametrize("name", ALONE)
def test_a_module_with_one_user_is_imported_there_alone(name: str) -> None:
    importing = {part for part, file in MODULES if name in set(imported(file))}
    assert importing == ALONE[name]


# ------------------------------------------------------------------ what libraries have in common

COMMON = Path(__file__).parents[3] / "runtime" / "framewire"
# From the bottom up.
COMMON_LAYERS = [
    {"edition", "part", "frame", "protocol"},
    {"explain"},
    {"codec"},
    {"recording", "line"},
    {"client"},
    {"tables"},
    {"command"},
]
COMMON_PARTS = [file.relative_to(COMMON) for file in sorted(COMMON.rglob("*.py"))]
COMMON_PARTS.remove(Path("__init__.py"))


def needed_in_common(path: Path) -> Iterator[str]:
    """Yield every room that a module in another one imports from."""
    for node in statements(COMMON / path):
        if isinstance(node, ast.ImportFrom) and node.level == len(path.parts):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from (name.partition(".")[0] for name in names)


def test_imports_of_the_common_runtime_point_downwards() -> None:
    found = ((path.with_suffix("").parts[0], path, needed_in_common(path)) for path in COMMON_PARTS)
    assert upwards(COMMON_LAYERS, found) == []


# What ports, strategies, tables and settings need; imported by those who ask for them.
OF_OTHERS = {
    *("hypothesis", "matplotlib", "numpy", "pyarrow", "shtab", "tomli", "typing_extensions"),
    *("hid", "serial"),
}


def test_the_common_runtime_works_wherever_it_is_copied_to() -> None:
    outside = {
        (path.as_posix(), name.partition(".")[0])
        for path in COMMON_PARTS
        for node in statements(COMMON / path)
        for name in (
            [alias.name for alias in node.names]
            if isinstance(node, ast.Import)
            else [node.module or ""] * (node.level == 0)
        )
    }
    known = sys.stdlib_module_names | OF_OTHERS
    assert [(path, name) for path, name in sorted(outside) if name not in known] == []
    above = [
        path.as_posix()
        for path in COMMON_PARTS
        for node in statements(COMMON / path)
        if isinstance(node, ast.ImportFrom) and node.level > len(path.parts)
    ]
    assert above == []


# ------------------------------------------------------------------ a library

LIBRARY = Path(__file__).parents[3] / "generated" / "lxservo"
# From the bottom up.
LIBRARY_LAYERS = [
    {"_library"},
    {"_envelopes", "_lookalikes", "_version", "recordings", "tables"},
    {"messages"},
    {"_codec", "_exchanges"},
    {"device", "strategies", "_devices", "_async_devices"},
    {"_controller", "_async_controller"},
    {"_command"},
    {"__main__"},
    {"__init__"},
]


def modules_needed(file: Path, *, to_run: bool = False) -> Iterator[str]:
    """Yield the modules of a library that one of them imports from.

    `to_run` leaves out what is imported for typing alone.
    """
    for node in statements(file, to_run=to_run):
        if isinstance(node, ast.ImportFrom) and node.level:
            yield from [node.module] if node.module else [alias.name for alias in node.names]


def test_imports_of_a_library_point_downwards() -> None:
    files = sorted(LIBRARY.glob("*.py"))
    found = ((file.stem, file, modules_needed(file, to_run=True)) for file in files)
    assert upwards(LIBRARY_LAYERS, found) == []


# ------------------------------------------------------------------ its tables

# From the bottom up.
TABLES_LAYERS = [
    {"extra"},
    {"events"},
    {"places", "by_entry"},
    {"schema", "search"},
    {"columns", "source"},
    {"noise_rows"},
    {"reader"},
    {"tables", "files", "stats"},
    {"archive"},
    {"captures"},
    {"__init__"},
]
TABLES = [path.relative_to("tables") for path in COMMON_PARTS if path.parts[0] == "tables"]


def needed_in_tables(path: Path) -> Iterator[str]:
    """Yield every part of the tables that a module of another part imports."""
    for node in statements(COMMON / "tables" / path):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == len(path.parts):
            yield node.module.partition(".")[0]


def test_imports_of_tables_point_downwards() -> None:
    found = ((path.with_suffix("").parts[0], path, needed_in_tables(path)) for path in TABLES)
    assert upwards(TABLES_LAYERS, found) == []
