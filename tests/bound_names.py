"""Every name that a module of any library binds: what a name of a spec may meet there."""

import ast
import re
from collections.abc import Iterable, Iterator
from functools import cache

from tests.factories import BUSSERVO, DEMO, ROOT, library_of

_SNAKE = re.compile(r"[a-z][a-z0-9]*(?:_[a-z0-9]+)*")
_PASCAL = re.compile(r"[A-Z][A-Za-z0-9]*")


@cache
def _modules() -> dict[str, list[ast.Module]]:
    """Return the modules of libraries, and of the runtime, by path: those that are alike once."""
    found: dict[str, dict[str, ast.Module]] = {
        file.relative_to(ROOT).as_posix(): {"": ast.parse(file.read_text(encoding="utf-8"))}
        for file in (ROOT / "runtime").rglob("*.py")
    }
    # One of plain frames, with poses, and one with all that there is besides.
    for file in (BUSSERVO, DEMO.with_name("everything.yaml")):
        for path, text in library_of(file).items():
            # Below the banner, which names the spec.
            code, known = text.partition("\n")[2], found.setdefault(path.split("/", 2)[2], {})
            if path.endswith(".py") and code not in known:
                known[code] = ast.parse(code)
    return {path: [*alike.values()] for path, alike in found.items()}


@cache
def bound_names(*, everywhere: bool = False) -> frozenset[str]:
    """Return the names that a name of a spec may meet: all of modules that are made for a spec.

    Those of the runtime bind others, in scopes of their own. Of these, what stands in classes,
    which a class of the spec may have for a base; or all, `everywhere`.
    """
    met = set[str]()
    for alike in _modules().values():
        for module in alike:
            whole = everywhere or len(alike) > 1
            met.update(_in_whole(module) if whole else _in_classes(module))
    return frozenset(met)


def _in_whole(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        yield from _bound(node)


def _in_classes(module: ast.Module) -> Iterator[str]:
    for kind in module.body:
        if isinstance(kind, ast.ClassDef):
            yield kind.name
            for each in kind.body:
                targets = each.targets if isinstance(each, ast.Assign) else [each]
                for target in targets:
                    yield from _bound(
                        target.target if isinstance(target, ast.AnnAssign) else target
                    )


def imported() -> frozenset[str]:
    modules = [module for alike in _modules().values() for module in alike]
    return frozenset(name.partition(".")[0] for each in modules for name in _packages(each))


def _packages(module: ast.Module) -> Iterator[str]:
    for node in ast.walk(module):
        if isinstance(node, ast.Import):
            yield from (each.name for each in node.names)
        elif isinstance(node, ast.ImportFrom) and not node.level and node.module:
            yield node.module


def snake_names(*, everywhere: bool = False) -> list[str]:
    """Return those that are spelt as fields are; capitals are what a value or an id becomes."""
    names = bound_names(everywhere=everywhere)
    return _spelt(_SNAKE, names | {name.lower() for name in names if name.isupper()})


def pascal_names(*, everywhere: bool = False) -> list[str]:
    """Return those that are spelt as messages are; of two that differ in capitals only one."""
    names = _spelt(_PASCAL, bound_names(everywhere=everywhere))
    return [*{name.lower(): name for name in names}.values()]


def _spelt(spelling: re.Pattern[str], names: Iterable[str]) -> list[str]:
    return sorted(name for name in names if spelling.fullmatch(name))


def _bound(node: ast.AST) -> Iterator[str]:
    match node:
        case ast.FunctionDef() | ast.AsyncFunctionDef() | ast.ClassDef():
            yield node.name
        case ast.Name() if not isinstance(node.ctx, ast.Load):
            yield node.id
        case ast.Attribute() if not isinstance(node.ctx, ast.Load):
            yield node.attr
        case ast.arg() | ast.keyword():
            yield node.arg or ""
        case ast.alias():
            yield (node.asname or node.name).partition(".")[0]
