"""The text of the spec, with an anchor for each key."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.reading.yamltree import dotted

if TYPE_CHECKING:
    from framegen.reading.source import Source
    from framegen.reading.yamltree import KeyPath, Tree


@dataclass(frozen=True, slots=True)
class Piece:
    """Some text of a line, from a key on. `anchor` is empty where no key begins."""

    anchor: str
    text: str


@dataclass(frozen=True, slots=True)
class SpecLine:
    """One line of the spec; `anchor` is that of the first key on it, if there is any."""

    number: int
    anchor: str
    pieces: list[Piece]


def listing(source: Source, tree: Tree) -> list[SpecLine]:
    """Return every line, except the blank one at the end."""
    begins = _begins(tree)
    lines = source.text.rstrip("\n").split("\n")
    return [_line(number, text, begins.get(number, [])) for number, text in enumerate(lines, 1)]


def nearest_anchor(tree: Tree, path: KeyPath) -> str:
    """Return the anchor of a key in the listing, or of the nearest one around it; "" for none."""
    while path and not (path in tree.keys and all(map(_plain, path))):
        path = path[:-1]
    return dotted(path)


def _line(number: int, text: str, begins: list[tuple[int, str]]) -> SpecLine:
    if not begins:
        return SpecLine(number, "", [Piece("", text)])
    (_, anchor), *others = begins
    starts = [(0, ""), *others]
    ends = [*(start for start, _ in others), len(text)]
    pieces = [Piece(name, text[start:end]) for (start, name), end in zip(starts, ends, strict=True)]
    return SpecLine(number, anchor, pieces)


def _begins(tree: Tree) -> dict[int, list[tuple[int, str]]]:
    """Return the keys that begin on each line: columns from 0, with anchors, outermost first."""
    found: dict[int, list[tuple[int, str]]] = {}
    for keys in sorted({*tree.keys, *tree.values} - {()}, key=len):
        if all(map(_plain, keys)):
            span = tree.key_at(keys)
            found.setdefault(span.line, []).append((span.column - 1, dotted(keys)))
    return {line: sorted(each, key=lambda begin: begin[0]) for line, each in found.items()}


def _plain(step: str | int) -> bool:
    """Tell whether a key can be part of an anchor: a number or a word, and no free text."""
    return isinstance(step, int) or re.fullmatch(r"\w+", step, re.ASCII) is not None
