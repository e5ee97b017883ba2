"""Imports point only downwards, in the generator, the runtime and the libraries that it makes."""

import ast
import sys
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

from tests.factories import ROOT
from tests.in_turn import in_turn

# From the bottom up. The parts of one layer do not import each other.
GENERATOR = ROOT / "codegen" / "framegen"
LAYERS = [
    {"__version__"},
    {"reading"},
    {"project", "language"},
    {"model"},
    {"checks", "cases"},
    {"compile", "explain", "witnesses"},
    {"audit", "guess", "output"},
    {"conformance", "vendored"},
    {"targets.target", "targets.templates", "targets.filenames"},
    {"targets.python", "targets.docs", "targets.vectors", "targets.schema"},
    {"targets.table"},
    {"render", "skeleton", "chosen_targets"},
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
COMMON = ROOT / "runtime" / "framewire"
COMMON_LAYERS = [
    {"edition", "part", "frame", "protocol"},
    {"explain"},
    {"codec"},
    {"recording", "line"},
    {"client"},
    {"tables"},
    {"command"},
    {"simulator"},
]
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
LIBRARY = ROOT / "generated" / "lxservo"
LIBRARY_LAYERS = [
    {"_library", "hatch_build", "runtime"},
    {"_envelopes", "_lookalikes", "_version", "recordings", "tables"},
    {"messages"},
    {"_codec", "_exchanges"},
    {"device", "strategies", "_devices", "_async_devices"},
    {"simulator", "_controller", "_async_controller"},
    {"_command"},
    {"__main__"},
    {"__init__"},
]
# What ports, strategies, tables and settings need; imported by those who ask for them.
OF_OTHERS = {
    *("hypothesis", "matplotlib", "numpy", "pyarrow", "shtab", "tomli", "typing_extensions"),
    *("hid", "serial"),
}


@cache
def statements(file: Path, *, to_run: bool = False) -> list[ast.ImportFrom]:
    """Return every import in a module, wherever it stands: for typing alone or not, or `to_run`.

    What is imported as a whole is a name of no module.
    """
    found: list[ast.ImportFrom] = []
    bodies: list[ast.AST] = [ast.parse(file.read_text(encoding="utf-8"))]
    # An expression holds no statement.
    while bodies:
        for node in ast.iter_child_nodes(bodies.pop()):
            if isinstance(node, ast.ImportFrom):
                found.append(node)
            elif isinstance(node, ast.Import):
                found += [ast.ImportFrom(None, [each], 0) for each in node.names]
            elif to_run and isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
                bodies += node.orelse
            elif not isinstance(node, ast.expr):
                bodies.append(node)
    return found


def imported(file: Path) -> Iterator[str]:
    """Yield everything that a module of the generator imports, in full."""
    for node in statements(file):
        yield from (".".join(filter(None, [node.module, each.name])) for each in node.names)


def part_of(*inner: str) -> str:
    return ".".join(inner[:2]) if inner[0] == "targets" else inner[0]


def above(file: Path, depth: int, *, to_run: bool = False) -> Iterator[str]:
    """Yield what a module imports from so many packages above its own."""
    for node in statements(file, to_run=to_run):
        if node.level == depth:
            names = [node.module] if node.module else [each.name for each in node.names]
            yield from (name.partition(".")[0] for name in names)


def of_the_generator() -> Iterator[tuple[str, Path, Iterator[str]]]:
    """Yield the part of each module, its file, and the parts that it imports."""
    for file in sorted(GENERATOR.rglob("*.py")):
        inner = file.relative_to(GENERATOR).with_suffix("").parts
        names = (name.split(".") for name in imported(file))
        parts = (part_of(*rest) for package, *rest in names if package == "framegen")
        if inner != ("targets", "__init__"):
            yield "__version__" if inner == ("__init__",) else part_of(*inner), file, parts


def below(folder: Path) -> Iterator[tuple[str, Path, Iterator[str]]]:
    """Yield the same of the runtime, or of a part of it."""
    for file in sorted(folder.rglob("*.py")):
        inner = file.relative_to(folder).with_suffix("").parts
        if file != COMMON / "__init__.py":
            yield inner[0], file, above(file, len(inner))


def of_a_library() -> Iterator[tuple[str, Path, Iterator[str]]]:
    """Yield the same of a library, but for what is imported for typing alone."""
    for file in sorted(LIBRARY.glob("*.py")):
        yield file.stem, file, above(file, 1, to_run=True)


@in_turn(
    "layers, modules",
    lambda: [
        (LAYERS, of_the_generator()),
        (COMMON_LAYERS, below(COMMON)),
        (TABLES_LAYERS, below(COMMON / "tables")),
        (LIBRARY_LAYERS, of_a_library()),
    ],
)
def test_imports_point_downwards(
    layers: list[set[str]], modules: Iterator[tuple[str, Path, Iterator[str]]]
) -> None:
    """Each part has its layer, and each layer its parts."""
    layer = {part: height for height, those in enumerate(layers) for part in those}
    known = [*modules]
    assert {part for part, _, _ in known} == set(layer)
    assert [
        (file.as_posix(), other)
        for part, file, others in known
        for other in others
        if other != part and layer[other] >= layer[part]
    ] == []


@pytest.mark.parametrize("name", ALONE)
def test_a_module_with_one_user_is_imported_there_alone(name: str) -> None:
    users = {part for part, file, _ in of_the_generator() if name in set(imported(file))}
    assert users == ALONE[name]


def test_the_common_runtime_works_wherever_it_is_copied_to() -> None:
    known = sys.stdlib_module_names | OF_OTHERS
    for _, file, _ in below(COMMON):
        assert {*above(file, 0)} <= known, file
        depth = len(file.relative_to(COMMON).parts)
        assert [node.module for node in statements(file) if node.level > depth] == [], file
