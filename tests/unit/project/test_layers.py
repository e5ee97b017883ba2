"""Imports point only downwards, in the generator and in the libraries that it makes."""

import ast
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

GENERATOR = Path(__file__).parents[3] / "codegen" / "framegen"

# From the bottom up. The parts of one layer do not import each other.
LAYERS = [
    {"visible"},
    {
        "__version__",
        "colour",
        "console",
        "hextext",
        "recording_file",
        "recording_form",
        "shell_completion",
        "pluralize",
    },
    {"reading", "explanation"},
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
LAYER = {part: height for height, layer in enumerate(LAYERS) for part in layer}

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
    """Yield every module of the generator with its part, except those copied into libraries."""
    for file in sorted(GENERATOR.rglob("*.py")):
        parts = file.relative_to(GENERATOR).with_suffix("").parts
        if "runtime" not in parts and parts not in (("__init__",), ("targets", "__init__")):
            yield _part(parts), file


def _part(parts: tuple[str, ...]) -> str:
    return ".".join(parts[:2]) if parts[0] == "targets" else parts[0]


@cache
def statements(file: Path) -> list[ast.Import | ast.ImportFrom]:
    """Return every import in a module, for typing alone or not, wherever it stands."""
    found: list[ast.Import | ast.ImportFrom] = []
    bodies: list[ast.AST] = [ast.parse(file.read_text(encoding="utf-8"))]
    # An expression holds no statement.
    while bodies:
        for node in ast.iter_child_nodes(bodies.pop()):
            if isinstance(node, ast.Import | ast.ImportFrom):
                found.append(node)
            elif not isinstance(node, ast.expr):
                bodies.append(node)
    return found


def imported(file: Path) -> Iterator[str]:
    """Yield everything that a module imports, in full."""
    for node in statements(file):
        module = f"{node.module}." if isinstance(node, ast.ImportFrom) else ""
        yield from (f"{module}{alias.name}" for alias in node.names)


MODULES = list(modules())


def test_every_part_of_framegen_has_its_layer() -> None:
    assert {part for part, _ in MODULES} <= set(LAYER)


def test_imports_point_downwards() -> None:
    upwards = [
        (file.relative_to(GENERATOR).as_posix(), name)
        for part, file in MODULES
        for name in imported(file)
        if name.startswith("framegen.")
        if (other := _part(tuple(name.split(".")[1:]))) != part and LAYER[other] >= LAYER[part]
    ]
    assert upwards == []


@pytest.mark.parametrize("name", ALONE)
def test_a_module_with_one_user_is_imported_there_alone(name: str) -> None:
    importing = {part for part, file in MODULES if name in set(imported(file))}
    assert importing == ALONE[name]


# ------------------------------------------------------------------ a library

LIBRARY = Path(__file__).parents[3] / "generated" / "busservo"
# From the bottom up.
LIBRARY_LAYERS = [
    {"_log"},
    {"_frame"},
    {"messages", "_version", "_explanation"},
    {"_codec"},
    {"_recording"},
    {"recordings", "_serial"},
    {"_client"},
    {"device", "strategies", "_tables"},
    {"tables"},
    {"_cli"},
    {"__main__"},
    {"__init__"},
]
LIBRARY_LAYER = {
    package: height for height, layer in enumerate(LIBRARY_LAYERS) for package in layer
}
PARTS = sorted(file.relative_to(LIBRARY) for file in LIBRARY.rglob("*.py"))


def needed(path: Path) -> Iterator[str]:
    """Yield every package and module of the library that one of its modules imports."""
    for node in statements(LIBRARY / path):
        if isinstance(node, ast.ImportFrom) and node.level == len(path.parts):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from (name.partition(".")[0] for name in names)


def test_every_part_of_a_library_has_its_layer() -> None:
    assert {path.with_suffix("").parts[0] for path in PARTS} == set(LIBRARY_LAYER)


def test_imports_of_a_library_point_downwards() -> None:
    upwards = [
        (path.as_posix(), name)
        for path in PARTS
        for name in needed(path)
        if LIBRARY_LAYER[name] > LIBRARY_LAYER[path.with_suffix("").parts[0]]
    ]
    assert upwards == []


def test_parts_of_one_layer_do_not_import_each_other() -> None:
    beside = [
        (path.as_posix(), name)
        for path in PARTS
        for name in needed(path)
        if name != path.with_suffix("").parts[0]
        if LIBRARY_LAYER[name] == LIBRARY_LAYER[path.with_suffix("").parts[0]]
    ]
    assert beside == []


# ------------------------------------------------------------------ the tables of a library

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
    {"__init__"},
]
TABLES_LAYER = {part: height for height, layer in enumerate(TABLES_LAYERS) for part in layer}
TABLES = [path.relative_to("_tables") for path in PARTS if path.parts[0] == "_tables"]


def needed_in_tables(path: Path) -> Iterator[str]:
    """Yield every part of the tables that a module of another part imports."""
    for node in statements(LIBRARY / "_tables" / path):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == len(path.parts):
            yield node.module.partition(".")[0]


def test_imports_of_tables_point_downwards() -> None:
    assert {path.with_suffix("").parts[0] for path in TABLES} == set(TABLES_LAYER)
    upwards = [
        (path.as_posix(), name)
        for path in TABLES
        for name in needed_in_tables(path)
        if TABLES_LAYER[name] >= TABLES_LAYER[path.with_suffix("").parts[0]]
    ]
    assert upwards == []
