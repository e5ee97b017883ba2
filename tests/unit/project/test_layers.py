"""Imports point only downwards, in the generator and in the libraries that it makes."""

import ast
import sys
from collections.abc import Iterable, Iterator
from functools import cache
from pathlib import Path

import pytest
from framegen.targets.python.copies import copies

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
    """Yield every module of the generator with its part, except those copied into libraries."""
    for file in sorted(GENERATOR.rglob("*.py")):
        parts = file.relative_to(GENERATOR).with_suffix("").parts
        if "runtime" not in parts and parts not in (("__init__",), ("targets", "__init__")):
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
    {"frame"},
    {"codec", "explain"},
    {"recording", "line"},
    {"client"},
    {"tables"},
    {"command"},
]
COMMON_PARTS = [file.relative_to(COMMON) for file in sorted(COMMON.glob("*/**/*.py"))]


def needed_in_common(path: Path) -> Iterator[str]:
    """Yield every room that a module in another one imports from."""
    for node in statements(COMMON / path):
        if isinstance(node, ast.ImportFrom) and node.level == len(path.parts):
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from (name.partition(".")[0] for name in names)


def test_imports_of_the_common_runtime_point_downwards() -> None:
    found = ((path.parts[0], path, needed_in_common(path)) for path in COMMON_PARTS)
    assert upwards(COMMON_LAYERS, found) == []


# What strategies and tables need; imported by those who ask for them.
OF_OTHERS = {"hypothesis", "numpy", "pyarrow", "shtab", "typing_extensions"}


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

LIBRARY = Path(__file__).parents[3] / "generated" / "busservo"
# From the bottom up.
LIBRARY_LAYERS = [
    {"_frame"},
    {"messages", "_explanation"},
    {"_codec"},
    {"_recording"},
    {"_serial"},
    {"_client"},
    {"_library"},
    {"line and client of the protocol"},
    {"_version", "recordings", "device", "strategies", "_tables"},
    {"tables"},
    {"_cli"},
    {"__main__"},
    {"__init__"},
]
PARTS = sorted(file.relative_to(LIBRARY) for file in LIBRARY.rglob("*.py"))
TEMPLATES = GENERATOR / "targets" / "python" / "templates"
# What is made for a protocol, by module; the rest is the same for all.
MADE = {
    ".".join(template.relative_to(TEMPLATES).parts).removesuffix(".py.jinja")
    for template in TEMPLATES.rglob("*.py.jinja")
}
# The rooms in which what is made for a protocol stands on what is the same for all.
ON_TOP = ("_client", "_serial")


def modules_needed(path: Path, *, to_run: bool = False) -> Iterator[str]:
    """Yield the name of every module of the library that one of its modules imports from.

    `to_run` leaves out what is imported for typing alone.
    """
    for node in statements(LIBRARY / path, to_run=to_run):
        if isinstance(node, ast.ImportFrom) and 0 < node.level <= len(path.parts):
            room = path.parts[: len(path.parts) - node.level]
            names = [node.module] if node.module else [alias.name for alias in node.names]
            yield from (".".join([*room, name]) for name in names)


def needed(path: Path) -> Iterator[str]:
    """Yield every part of the library that one of its modules imports from."""
    return map(part_with, modules_needed(path))


def part_of(path: Path) -> str:
    return part_with(".".join(path.with_suffix("").parts))


def part_with(module: str) -> str:
    """Return the part that a module is in: its room, or what is made for the protocol on top."""
    room = module.partition(".")[0]
    return "line and client of the protocol" if module in MADE and room in ON_TOP else room


def test_imports_of_a_library_point_downwards() -> None:
    assert upwards(LIBRARY_LAYERS, ((part_of(path), path, needed(path)) for path in PARTS)) == []


# ------------------------------------------------------------------ rooms that are given all

# The rooms whose code is the same for every protocol and is given what the specification decides,
# each with what it imports all the same to run: the names that all share.
GIVEN: dict[str, set[str]] = {
    "_explanation": set(),
    "_recording": {"_codec.event_bytes"},
    "_tables": {"_codec.event_bytes"},
    "_client": {"_frame.message"},
    "_serial": {"_frame.message"},
    # Its `__init__` is the function that a shell calls: it says whose command it is.
    "_cli": {
        *("_cli.examples", "_codec.event_bytes", "_frame.items", "_frame.number"),
    },
}


@pytest.mark.parametrize("room", GIVEN)
def test_a_room_that_is_given_the_protocol_imports_nothing_of_it(room: str) -> None:
    known = {".".join(Path(each).with_suffix("").parts) for each in copies()}
    modules = {path: ".".join(path.with_suffix("").parts) for path in PARTS}
    for path, name in modules.items():
        if path.parts[0] in GIVEN and name not in MADE:
            known.add(name)
    imports = {
        (name, other)
        for path, name in modules.items()
        if path.parts[0] == room and name not in MADE
        for other in modules_needed(path, to_run=True)
    }
    assert imports
    assert {each for each in imports if each[1] not in known | GIVEN[room]} == set()
    assert {other for _, other in imports} >= GIVEN[room]


def test_what_reads_frames_is_given_the_envelopes() -> None:
    modules = {path: ".".join(path.with_suffix("").parts) for path in PARTS}
    importing = {
        name
        for path, name in modules.items()
        if "_frame.envelopes" in modules_needed(path) and path.parts[0] in ("_frame", "_codec")
    }
    assert importing
    assert importing <= MADE


def test_what_reads_numbers_is_given_their_byte_order() -> None:
    """It is the same for every protocol: what is made for one is imported for all else alone."""
    same = [path for path in PARTS if ".".join(path.with_suffix("").parts) not in MADE]
    imports = {
        other
        for path in same
        if path.parts[0] == "_frame" or path.stem == "lookalike"
        for other in modules_needed(path, to_run=True)
    }
    assert imports & MADE == {"_codec.codec"}


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
    {"archive", "captures"},
    {"__init__"},
]
TABLES = [path.relative_to("_tables") for path in PARTS if path.parts[0] == "_tables"]


def needed_in_tables(path: Path) -> Iterator[str]:
    """Yield every part of the tables that a module of another part imports."""
    for node in statements(LIBRARY / "_tables" / path):
        if isinstance(node, ast.ImportFrom) and node.module and node.level == len(path.parts):
            yield node.module.partition(".")[0]


def test_imports_of_tables_point_downwards() -> None:
    found = ((part_of(path), path, needed_in_tables(path)) for path in TABLES)
    assert upwards(TABLES_LAYERS, found) == []
