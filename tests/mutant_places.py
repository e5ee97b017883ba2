"""Where one line of code can be changed in a small way, for `tests/mutant_sample.py`.

Left out is what no test should notice, or what only words depend on: annotations, decorators,
what is imported for type checkers, f-strings, and what is raised, warned of or logged.
"""

from __future__ import annotations

import ast
import re
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

COMPARISONS = {
    "==": "!=",
    "!=": "==",
    "is": "is not",
    "is not": "is",
    "in": "not in",
    "not in": "in",
    "<": ">=",
    ">=": "<",
    ">": "<=",
    "<=": ">",
    "===": "!==",
    "!==": "===",
}
BOUNDARIES = {"<": "<=", "<=": "<", ">": ">=", ">=": ">"}
ARITHMETIC = {
    "+": "-",
    "-": "+",
    "*": "//",
    "//": "*",
    "%": "//",
    "&": "|",
    "|": "&",
    "<<": ">>",
    ">>": "<<",
}
JUNCTIONS = {"and": "or", "or": "and", "&&": "||", "||": "&&"}
EXTREMES = {"min": "max", "max": "min", "any": "all", "all": "any"}
# What no result depends on, if all is well.
SETTINGS = {"frozen", "repr", "slots", "strict"}
WORDS = {"debug", "info", "warn", "warning"}


class Change(NamedTuple):
    """One line, counted from 0, and what it becomes."""

    operator: str
    number: int
    becomes: str


class _Edit(NamedTuple):
    operator: str
    start: tuple[int, int]
    end: tuple[int, int]
    text: str


def changes(file: str, text: str) -> list[Change]:
    """Return all changes of a file, in their order."""
    if file.endswith(".js"):
        return [*_of_javascript(text)]
    return [*(_of_template(text) if file.endswith(".jinja") else _of_python(text))]


def _of_python(text: str) -> Iterator[Change]:
    lines = text.splitlines()
    for node in _looked_at(ast.parse(text)):
        for operator, (first, start), (last, end), new in _edits(node, lines):
            line = lines[first - 1].encode()
            if first == last:
                changed = (line[:start] + new.encode() + line[end:]).decode()
                if _is_python("\n".join([*lines[: first - 1], changed, *lines[first:]])):
                    yield Change(operator, first - 1, changed)


def _is_python(text: str) -> bool:
    try:
        ast.parse(text)
    except SyntaxError:
        return False
    return True


def _looked_at(node: ast.AST) -> Iterator[ast.AST]:
    """Yield a node and what is below it, but for what is left out."""
    match node:
        case ast.JoinedStr() | ast.If(test=ast.Name("TYPE_CHECKING")):
            return
        case ast.keyword(arg=name) if name in SETTINGS:
            return
        case ast.Raise():
            yield node
            return
        case ast.Call(func=ast.Attribute(attr=name) | ast.Name(name)) if name in WORDS:
            return
        case ast.Module(body=body):
            # The others are types: `Value = int | str`.
            below: Iterable[ast.AST] = [each for each in body if not _is_union(each)]
        case ast.AnnAssign(value=value):
            below = [value] if value else []
        case ast.FunctionDef(args=arguments, body=body):
            defaults = [*arguments.defaults, *filter(None, arguments.kw_defaults)]
            below = [*defaults, *body]
        case ast.ClassDef(body=body):
            below = body
        case _:
            below = ast.iter_child_nodes(node)
    yield node
    for each in below:
        yield from _looked_at(each)


def _is_union(node: ast.stmt) -> bool:
    value = getattr(node, "value", None)
    return isinstance(value, ast.BinOp) and isinstance(value.op, ast.BitOr)


def _edits(node: ast.AST, lines: list[str]) -> Iterator[_Edit]:
    yield from _of_operators(node, lines)
    yield from _of_values(node)
    yield from _of_statements(node)


def _of_operators(node: ast.AST, lines: list[str]) -> Iterator[_Edit]:
    match node:
        case ast.Compare(left=one, comparators=[other]):
            yield from _between("comparison", one, other, COMPARISONS, lines)
            yield from _between("boundary", one, other, BOUNDARIES, lines)
        case ast.BinOp(left=one, right=other):
            yield from _between("arithmetic", one, other, ARITHMETIC, lines)
        case ast.BoolOp(values=values):
            for one, other in pairwise(values):
                yield from _between("and or", one, other, JUNCTIONS, lines)
        case ast.UnaryOp(op=ast.Not()):
            line, start = _start(node)
            yield _Edit("not", (line, start), (line, start + len("not ")), "")


def _of_values(node: ast.AST) -> Iterator[_Edit]:
    match node:
        case ast.Constant(value=bool(value)):
            yield _instead("true false", node, str(not value))
        case ast.Constant(value=int(value)):
            yield _instead("constant", node, str(value + 1))
        case ast.Call(func=ast.Name(name) as function) if name in EXTREMES:
            yield _instead("min max", function, EXTREMES[name])
        case ast.Call(args=arguments, keywords=keywords) if len(arguments) + len(keywords) > 1:
            given: list[ast.expr | ast.keyword] = [*arguments, *keywords]
            *_, (_, before), (_, end) = sorted((_start(each), _end(each)) for each in given)
            yield _Edit("argument", before, end, "")


def _of_statements(node: ast.AST) -> Iterator[_Edit]:
    match node:
        case ast.Return(value=ast.expr() as value):
            yield _instead("return", value, "None")
        case ast.If(test=test) | ast.IfExp(test=test):
            yield _instead("condition", test, "True")
            yield _instead("condition", test, "False")
        case ast.While(test=test):
            yield _instead("condition", test, "False")
        case (
            ast.Expr(value=ast.Call() | ast.Yield() | ast.YieldFrom())
            | ast.Assign(targets=[ast.Attribute() | ast.Subscript()])
            | (ast.AugAssign() | ast.Raise())
        ):
            yield _instead("statement", node, "pass")
        case ast.Break():
            yield _instead("break continue", node, "continue")
        case ast.Continue():
            yield _instead("break continue", node, "break")


def _between(
    operator: str, one: ast.expr, other: ast.expr, words: dict[str, str], lines: list[str]
) -> Iterator[_Edit]:
    """Yield the edit of a word between two, which may have brackets beside it."""
    (first, start), (last, end) = _end(one), _start(other)
    found = lines[first - 1].encode()[start:end].decode() if first == last else ""
    word = found.strip(" ()")
    if word in words:
        yield _Edit(operator, (first, start), (last, end), found.replace(word, words[word]))


def _instead(operator: str, of: ast.expr | ast.stmt, text: str) -> _Edit:
    return _Edit(operator, _start(of), _end(of), text)


def _start(node: ast.expr | ast.stmt | ast.keyword) -> tuple[int, int]:
    return node.lineno, node.col_offset


def _end(node: ast.expr | ast.stmt | ast.keyword) -> tuple[int, int]:
    return node.end_lineno or 0, node.end_col_offset or 0


def _of_template(text: str) -> Iterator[Change]:
    """Yield changes of those lines that are Python by themselves, outside of docstrings."""
    within = False
    for number, line in enumerate(text.splitlines()):
        quotes = line.count('"""')
        if not (within or quotes or "{" in line):
            code = line.strip().removeprefix("el")
            body = " pass" if code.endswith(":") else ""
            if _is_python(code + body):
                indent = line[: line.index(code)] if code else ""
                for operator, _, becomes in _of_python(code + body):
                    yield Change(operator, number, indent + becomes.removesuffix(body))
        within ^= quotes % 2 == 1


# Comments, strings and patterns of JavaScript, nothing in which is changed.
_NO_CODE = re.compile(
    r"""//.*|/\*[\s\S]*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])*'|`(?:\\.|[^`\\])*`"""
    r"""|(?<=[=(,:!&|?\[;\s])/(?![/*\s])(?:\\.|\[(?:\\.|[^\]\\\n])*\]|[^/\n\\\[])+/[a-z]*"""
)
_JAVASCRIPT = (
    ("comparison", r"(?<= )(===|!==|[<>]=?)(?= )", COMPARISONS),
    ("boundary", r"(?<= )([<>]=?)(?= )", BOUNDARIES),
    ("arithmetic", r"(?<= )([+-]|&|\||<<)(?= )", ARITHMETIC),
    ("and or", r"(?<= )(&&|\|\|)(?= )", JUNCTIONS),
    ("not", r"(?<![=!\w])(!)(?=[\w(])", {"!": ""}),
    ("true false", r"\b(true|false)\b", {"true": "false", "false": "true"}),
    ("constant", r"(?<![\w.])(\d+)(?![\w.])", None),
    ("return", r"\breturn (?!null)([^;{]+)(?=;)", "null"),
    ("condition", r"\b(?:if|while) \((.+)\)(?= \{$| [a-z]+.*;$)", "false"),
    ("condition", r"\bif \((.+)\)(?= \{$| [a-z]+.*;$)", "true"),
    ("statement", r"^ *((?:[\w.]+(?:\(.*\)| [+-]?= .+)|throw .+);)$", ";"),
    ("break continue", r"\b(break|continue)(?=;)", {"break": "continue", "continue": "break"}),
    ("min max", r"\bMath\.(min|max)\b", EXTREMES),
    ("argument", r"\w\([^()]+(, \w+)(?=\))", ""),
)


def _of_javascript(text: str) -> Iterator[Change]:
    masked = _NO_CODE.sub(lambda found: re.sub(r"\S", "\0", found[0]), text)
    for number, (line, code) in enumerate(zip(text.splitlines(), masked.splitlines(), strict=True)):
        for operator, pattern, words in _JAVASCRIPT:
            for found in re.finditer(pattern, code):
                word, (start, end) = found[1], found.span(1)
                if words is None:
                    new = str(int(word) + 1)
                else:
                    new = words if isinstance(words, str) else words[word]
                yield Change(operator, number, line[:start] + new + line[end:])
