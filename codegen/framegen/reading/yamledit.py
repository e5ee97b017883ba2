"""Edits of a YAML file that leave all other text as it is, comments and layout included."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from framegen.reading.yamltext import block, flow

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from framegen.reading.source import Source
    from framegen.reading.yamltree import KeyPath, Tree


class NoPlace(ValueError):  # noqa: N818 - says what is missing
    """The text is laid out in a way in which nothing can be put there."""


class YamlEditor:
    """A collection of edits to one file. Each raises NoPlace where the layout does not allow it.

    Whoever uses it reads the result again, and sees that it says what it should.
    """

    def __init__(self, source: Source, tree: Tree) -> None:
        self._source = source
        self._tree = tree
        self._starts = [0]
        for line in source.lines:
            self._starts.append(self._starts[-1] + len(line) + 1)
        self._edits: list[tuple[int, int, str]] = []
        self._tail: list[str] = []

    def text(self) -> str:
        """Return the text with all edits."""
        text = self._source.text
        # Of several at one place, the first comes first.
        ordered = sorted(enumerate(self._edits), key=lambda each: (each[1][0], each[0]))
        for _, (start, end, new) in reversed(ordered):
            text = text[:start] + new + text[end:]
        if self._tail and not text.endswith("\n"):
            text += "\n"
        return text + "".join(f"\n{lines}" for lines in self._tail)

    def replace(self, path: KeyPath, value: str) -> None:
        """Replace the text at `path`; it stands in quotes."""
        start, end = self._scalar(path)
        self._edits.append((start, end, f'"{value}"'))

    def put_first(self, path: KeyPath, items: Sequence[Any]) -> None:
        """Put items in front of those of the list at `path`, or begin it at the end of the file."""
        if path not in self._tree.values:
            if len(path) != 1:
                raise NoPlace
            self._tail.append("".join(f"{line}\n" for line in block({str(path[0]): items})))
            return
        start, has_items = self._start(path), (*path, 0) in self._tree.values
        if self._source.text[start] == "[":
            inside = flow(items)[1:-1] + ", " * has_items
            self._edits.append((start + 1, start + 1, inside))
        else:
            self._put_lines(path, list(block(items)))

    def put_behind(self, path: KeyPath, entry: Mapping[str, Any]) -> None:
        """Put an entry behind the scalar at `path`, in the mapping that this is in."""
        _, end = self._scalar(path)
        around = self._start(path[:-1])
        if self._source.text[around] == "{":
            self._edits.append((end, end, f", {flow(entry)[1:-1]}"))
            return
        indent = " " * (self._tree.keys[path].column - 1)
        line = self._tree.values[path].line
        end = self._starts[line - 1] + len(self._source.line(line))
        self._edits.append((end, end, "".join(f"\n{indent}{each}" for each in block(entry))))

    def put_in(self, path: KeyPath, entries: Mapping[str, Any]) -> None:
        """Put entries in front of those of the mapping at `path`, which has some."""
        start = self._start(path)
        if self._source.text[start] == "{":
            self._edits.append((start + 1, start + 1, f"{flow(entries)[1:-1]}, "))
        else:
            self._put_lines(path, list(block(entries)))

    def _put_lines(self, path: KeyPath, lines: Sequence[str]) -> None:
        """Put lines in front of the block that begins at `path`."""
        span = self._tree.values[path]
        indent = self._source.line(span.line)[: span.column - 1]
        if indent.strip(" "):
            raise NoPlace
        start = self._starts[span.line - 1]
        self._edits.append((start, start, "".join(f"{indent}{line}\n" for line in lines)))

    def _start(self, path: KeyPath) -> int:
        if path not in self._tree.values:
            raise NoPlace
        span = self._tree.values[path]
        return self._starts[span.line - 1] + span.column - 1

    def _scalar(self, path: KeyPath) -> tuple[int, int]:
        start = self._start(path)
        return start, start + self._tree.values[path].length
