"""Imports point only downwards, in the generator and in the libraries that it makes."""

import ast
from collections.abc import Iterator
from pathlib import Path

import pytest

GENERATOR = Path(__file__).parent.parent / "codegen" / "framegen"

# From the ground up. What shares a line knows nothing of each other.
STOREYS = [
    {
        "__version__",
        "colour",
        "console",
        "hextext",
        "recording_file",
        "shell_completion",
        "pluralize",
    },
    {"reading", "explanation"},
    {"project", "language"},
    {"model"},
    {"checks", "cases"},
    {"compile", "explain", "witnesses"},
    {"comparison", "output"},
    {"conformance"},
    {"targets.target", "targets.templates", "targets.filenames"},
    {"targets.python", "targets.docs", "targets.vectors", "targets.schema"},
    {"targets.table"},
    {"render", "skeleton"},
    {"writing"},
    {"commands"},
    {"completion"},
    {"cli"},
    {"__main__"},
]
STOREY = {room: height for height, storey in enumerate(STOREYS) for room in storey}

# Who alone may ask for what: everything else is handed what came of it.
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
    """Yield every module of the generator with its room, except those copied into libraries."""
    for file in sorted(GENERATOR.rglob("*.py")):
        parts = file.relative_to(GENERATOR).with_suffix("").parts
        if "runtime" not in parts and parts not in (("__init__",), ("targets", "__init__")):
            yield _room(parts), file


def _room(parts: tuple[str, ...]) -> str:
    return ".".join(parts[:2]) if parts[0] == "targets" else parts[0]


def imported(file: Path) -> Iterator[str]:
    """Return everything that a module imports, for typing alone or not, in full."""
    for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield from (f"{node.module}.{alias.name}" for alias in node.names)


MODULES = list(modules())


def test_every_room_has_its_storey() -> None:
    assert {room for room, _ in MODULES} <= set(STOREY)


@pytest.mark.parametrize(("room", "file"), MODULES, ids=lambda each: Path(str(each)).stem)
def test_imports_point_downwards(room: str, file: Path) -> None:
    known = [name.split(".")[1:] for name in imported(file) if name.startswith("framegen.")]
    others = {_room(tuple(parts)) for parts in known} - {room}
    assert {other for other in others if STOREY[other] >= STOREY[room]} == set()


@pytest.mark.parametrize("name", ALONE)
def test_what_is_answered_in_one_place_is_asked_there(name: str) -> None:
    asking = {room for room, file in MODULES if name in set(imported(file))}
    assert asking == ALONE[name]


# ------------------------------------------------------------------ a library

LIBRARY = Path(__file__).parent.parent / "generated" / "busservo"
# From the ground up. A module that is private and stands alone has nobody above it to belong to.
FLOORS = [
    {"_log"},
    {"_frame"},
    {"messages", "_version", "_explanation"},
    {"_codec"},
    {"_recording"},
    {"recordings", "_serial"},
    {"_client"},
    {"device", "strategies"},
    {"_cli"},
    {"__main__"},
    {"__init__"},
]
FLOOR = {package: height for height, floor in enumerate(FLOORS) for package in floor}
PARTS = sorted(file.relative_to(LIBRARY) for file in LIBRARY.rglob("*.py"))


def needed(path: Path) -> Iterator[str]:
    """Yield every package and module of the library that one of its modules imports."""
    for node in ast.walk(ast.parse((LIBRARY / path).read_text(encoding="utf-8"))):
        if isinstance(node, ast.ImportFrom) and node.level == len(path.parts):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from (name.partition(".")[0] for name in names)


def test_every_part_of_a_library_has_its_floor() -> None:
    assert {path.with_suffix("").parts[0] for path in PARTS} == set(FLOOR)


@pytest.mark.parametrize("path", PARTS, ids=Path.as_posix)
def test_imports_of_a_library_point_downwards(path: Path) -> None:
    here = FLOOR[path.with_suffix("").parts[0]]
    assert [name for name in needed(path) if FLOOR[name] > here] == []


def test_what_stands_on_one_floor_of_a_library_does_without_the_others() -> None:
    beside = [
        (path.as_posix(), name)
        for path in PARTS
        for name in needed(path)
        if name != path.with_suffix("").parts[0]
        if FLOOR[name] == FLOOR[path.with_suffix("").parts[0]]
    ]
    assert beside == []
