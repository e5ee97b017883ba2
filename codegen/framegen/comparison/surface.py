"""The surface of a library: what a program can name, read from its text without running it."""

from __future__ import annotations

import ast
from dataclasses import dataclass, field, replace
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Literal, TypeAlias

import framewire

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping

Kind: TypeAlias = Literal["class", "function", "property", "attribute", "constant", "name"]

# Modules whose own names are public, besides those that the package exports.
_PUBLIC = ("messages", "device", "strategies")
# What a class of the library declares for its own base class.
_INTERNAL = frozenset(("FRAME", "IDS", "DEFAULTS", "CONSTANTS"))
# Texts and sizes that go with any change: nothing in a program depends on them.
_PASSING = frozenset(("VENDOR_NAME", "DEPRECATED", "LENGTHS", "PROTOCOL_VERSION"))
# The types of values, by the class of the field; all others are whole numbers.
_READ_AS = {"F32": "float", "F64": "float", "Text": "str", "Packed": "tuple[int, ...]"}
_MADE = ("__new__", "__init__")


@dataclass(frozen=True, slots=True)
class Argument:
    """An argument of a function; without a `default` it must be given.

    `kind` is `by place` where it may be given by place or by name, `by name` where by name alone,
    and `many` for a starred one.
    """

    name: str
    kind: Literal["by place", "by name", "many"]
    type: str
    default: str | None


@dataclass(frozen=True, slots=True)
class Entry:
    """What one name of a library is.

    `type` is that of an attribute or a property, or of the result of a function. `value` is what a
    constant is, or how a property is read. `positions` are the names that a pattern reads by place.
    `arguments` are None for what is not called.
    """

    kind: Kind
    type: str = ""
    value: str = ""
    arguments: tuple[Argument, ...] | None = None
    bases: tuple[str, ...] = ()
    positions: tuple[str, ...] = ()


@dataclass(frozen=True, eq=False)
class Surface:
    """The public names of a library, `ServoMove.time_ms` after `ServoMove`."""

    entries: Mapping[str, Entry] = field(default_factory=dict)

    def __contains__(self, name: object) -> bool:
        return name in self.entries

    def __getitem__(self, name: str) -> Entry:
        return self.entries[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.entries)

    def is_a(self, name: str, base: str) -> bool:
        """Tell whether a class is another, or is derived from it, as far as it is read."""
        entry = self.entries.get(name)
        inherited = entry is not None and any(self.is_a(each, base) for each in entry.bases)
        return name == base or inherited


def read_surface(files: Mapping[str, str]) -> Surface:
    """Read the surface of a library from its files, by path below the package.

    What the runtime gives is the same in all of them, and is read where that is.
    """
    found: dict[str, Entry] = {}
    homes = _exported(files["__init__.pyi"])
    inner: dict[str, dict[str, Entry]] = {}
    for name, home in homes.items():
        if home not in inner:
            inner[home] = _module(files.get(f"{home}.py") or _of_runtime(home))
        owned = {each: entry for each, entry in inner[home].items() if _owner(each) == name}
        found |= owned or {name: Entry("name")}
    for module in _PUBLIC:
        names = inner.get(module) or _module(files[f"{module}.py"])
        found |= {
            f"{module}.{name}": each for name, each in names.items() if not _is_in(name, found)
        }
    return Surface(found)


@cache
def _of_runtime(module: str) -> str:
    """Return the text of a module of the runtime."""
    _, *inside = module.split(".")
    file = Path(str(framewire.__file__)).parent.joinpath(*inside)
    return file.with_suffix(".py").read_text(encoding="utf-8")


def _is_in(name: str, found: Mapping[str, Entry]) -> bool:
    return _owner(name) in found


def _owner(name: str) -> str:
    return name.partition(".")[0]


def _exported(stub: str) -> dict[str, str]:
    """Return the names that a package exports, each with its module."""
    return {
        alias.name: node.module or ""
        for node in ast.parse(stub).body
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }


@lru_cache(maxsize=64)  # many modules are the same in both editions
def _module(text: str) -> dict[str, Entry]:
    found: dict[str, Entry] = {}
    for node in ast.parse(text).body:
        for name, entry in _of(node):
            inherited = (
                base for each in entry.bases if each in found for base in found[each].bases
            )
            found[name] = replace(entry, bases=(*entry.bases, *inherited))
            if isinstance(node, ast.ClassDef):
                found |= {f"{name}.{each}": inner for each, inner in _members(node)}
    return {name: entry for name, entry in found.items() if not name.startswith("_")}


def _of(node: ast.stmt) -> Iterator[tuple[str, Entry]]:
    """Yield the names that a statement gives to something, but for imports."""
    match node:
        case ast.ClassDef():
            yield node.name, _class(node)
        case ast.FunctionDef() | ast.AsyncFunctionDef():
            yield node.name, _function(node)
        case ast.AnnAssign(target=ast.Name(id=name)) if node.value is not None:
            yield name, _assigned(name, node.value, ast.unparse(node.annotation))
        case ast.AnnAssign(target=ast.Name(id=name)):
            yield name, Entry("attribute", ast.unparse(node.annotation))
        case ast.Assign(targets=[ast.Name(id=name)]):
            yield name, _assigned(name, node.value, "")


def _members(node: ast.ClassDef) -> Iterator[tuple[str, Entry]]:
    for each in node.body:
        for name, entry in _of(each):
            if not name.startswith("_") and name not in _INTERNAL | _PASSING:
                yield name, entry


def _class(node: ast.ClassDef) -> Entry:
    made: tuple[Argument, ...] | None = None
    positions: tuple[str, ...] = ()
    for each in node.body:
        if isinstance(each, ast.FunctionDef) and each.name in _MADE:
            made = _arguments(each.args, bound=True)
        if isinstance(each, ast.Assign) and ast.unparse(each.targets[0]) == "__match_args__":
            positions = tuple(ast.literal_eval(each.value))
    bases = tuple(ast.unparse(base) for base in node.bases)
    return Entry("class", arguments=made, bases=bases, positions=positions)


def _function(node: ast.FunctionDef | ast.AsyncFunctionDef) -> Entry:
    decorators = {ast.unparse(each) for each in node.decorator_list}
    returned = "" if node.returns is None else ast.unparse(node.returns)
    if "property" in decorators:
        last = node.body[-1]
        read = last.value if isinstance(last, ast.Return) else None
        return Entry("property", returned, "" if read is None else ast.unparse(read))
    first = node.args.args[:1]
    bound = bool(first) and first[0].arg in ("self", "cls")
    return Entry("function", returned, arguments=_arguments(node.args, bound=bound))


def _arguments(given: ast.arguments, *, bound: bool) -> tuple[Argument, ...]:
    found: list[Argument] = []
    placed = [*given.posonlyargs, *given.args]
    missing = len(placed) - len(given.defaults)
    for at, each in enumerate(placed):
        default = None if at < missing else ast.unparse(given.defaults[at - missing])
        found.append(Argument(each.arg, "by place", _annotation(each), default))
    if given.vararg is not None:
        found.append(Argument(given.vararg.arg, "many", _annotation(given.vararg), ""))
    for each, value in zip(given.kwonlyargs, given.kw_defaults, strict=True):
        default = None if value is None else ast.unparse(value)
        found.append(Argument(each.arg, "by name", _annotation(each), default))
    return tuple(found[bound:])


def _annotation(argument: ast.arg) -> str:
    return "" if argument.annotation is None else ast.unparse(argument.annotation)


def _assigned(name: str, value: ast.expr, annotation: str) -> Entry:
    if name.isupper() or not isinstance(value, ast.Call):
        shown = "" if name in _PASSING or annotation.endswith("TypeAlias") else ast.unparse(value)
        return Entry("constant", value="" if name == "MESSAGES" else shown)
    return Entry("attribute", _read_as(value))


def _read_as(field_: ast.expr) -> str:
    """Return the type of what a field of a message gives, from the call that makes the field."""
    if not isinstance(field_, ast.Call):
        return ast.unparse(field_)
    kind = ast.unparse(field_.func).removeprefix("Swapped")
    if kind in ("Items", "List"):
        return f"tuple[{_read_as(field_.args[1])}, ...]"
    if kind == "Optional":
        return f"{_read_as(field_.args[0])} | None"
    return _READ_AS.get(kind, "int")
