"""A YAML reader that keeps the position of each value and each key.

Built on the parser's events, not on its loader: nothing is ever constructed from a tag, an alias
cannot multiply, a duplicate key cannot hide, and depth is bounded before anything recurses.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, TypeAlias

import yaml

from framegen.reading.findings import MOST_FINDINGS, Finding, Related
from framegen.reading.scalars import Ambiguous, resolve
from framegen.reading.source import Source, Span
from framegen.reading.syntax import syntax_finding
from framegen.reading.text import first_invisible

if TYPE_CHECKING:
    from collections.abc import Iterator

# The C parser is ten times as fast; both give the same events.
_Loader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)

KeyPath: TypeAlias = "tuple[str | int, ...]"

MAX_DEPTH = 24


class Unusable(Exception):  # noqa: N818 - says what the input is
    """Input or arguments that cannot be used at all, such as a file that is no YAML mapping.

    `finding` has the place, where there is one.
    """

    def __init__(self, message: str, *, hint: str = "", finding: Finding | None = None) -> None:
        super().__init__(message)
        self.hint = hint
        self.finding = finding


@dataclass(slots=True)
class Tree:
    """The values of a YAML file, and the position of each value and each key."""

    data: dict[str, Any]
    values: dict[KeyPath, Span] = field(default_factory=dict)
    keys: dict[KeyPath, Span] = field(default_factory=dict)

    def value_at(self, path: KeyPath) -> Span:
        """Return the position of the value at `path`, or of the nearest value around it."""
        return self._nearest(path, self.values, self.keys)

    def key_at(self, path: KeyPath) -> Span:
        """Return the position of the key at `path`; in a list, of the element."""
        return self._nearest(path, self.keys, self.values)

    @staticmethod
    def _nearest(path: KeyPath, first: dict[KeyPath, Span], second: dict[KeyPath, Span]) -> Span:
        while path:
            span = first.get(path) or second.get(path)
            if span is not None:
                return span
            path = path[:-1]
        return Span(1, 1)


def dotted(path: KeyPath) -> str:
    """Write a path as people do: `messages.ServoMove.examples[0].hex`."""
    text = ""
    for step in path:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def read_tree(source: Source) -> tuple[Tree, list[Finding]]:
    """Read one YAML document. Raises Unusable where there is none, or no mapping."""
    tree, findings = read_values(source)
    data: Any = tree.data
    if not isinstance(data, dict):
        found = (
            "is empty"
            if data is None
            else "holds " + ("a list" if isinstance(data, list) else "a single value")
        )
        raise Unusable(
            f"the file {found}, but a spec is a mapping of keys",
            hint="begin with `framegen: 2` and `protocol:`; "
            "`framegen schema` prints the whole language",
        )
    return tree, findings


def read_values(source: Source) -> tuple[Tree, list[Finding]]:
    """Read one YAML document of data of any kind, even None. Raises Unusable for no YAML."""
    builder = _Builder(source)
    try:
        builder.tree.data = builder.document()
    except yaml.MarkedYAMLError as error:
        finding = syntax_finding(error, source)
        raise Unusable("the file is not YAML", finding=finding) from None
    except yaml.YAMLError as error:
        raise Unusable(f"the file is not YAML: {' '.join(str(error).split())}") from None
    return builder.tree, [*builder.findings, *_hidden(source, builder.findings)]


def _hidden(source: Source, known: list[Finding]) -> Iterator[Finding]:
    """Find invisible characters outside of values: in comments, or between tokens."""
    reported = {finding.span.line for finding in known if finding.rule == "invisible-character"}
    for number, line in enumerate(source.lines, start=1):
        character = first_invisible(line.replace("\t", " "))
        if character is not None and number not in reported:
            span = Span(number, line.index(character) + 1)
            message = f"U+{ord(character):04X} stands here, which no reader can see"
            yield Finding("invisible-character", span, "", message, "remove it")


class _Builder:
    """A builder of values from the parser's events, for one use."""

    def __init__(self, source: Source) -> None:
        self._source = source
        self._events: Iterator[Any] = yaml.parse(source.text, Loader=_Loader)
        self.tree = Tree({})
        self.findings: list[Finding] = []

    def document(self) -> Any:
        data: Any = None
        documents = 0
        for event in self._events:
            if isinstance(event, yaml.DocumentStartEvent):
                documents += 1
                if documents > 1:
                    self._report(
                        "yaml-document",
                        event,
                        (),
                        "a second document begins here",
                        "keep one spec in one file",
                    )
                    break
                data = self._value(next(self._events), ())
        return data

    def _value(self, event: Any, path: KeyPath) -> Any:
        span = self._span(event)
        self.tree.values[path] = span
        if len(path) > MAX_DEPTH:
            finding = Finding("yaml-nesting", span, "", f"nested deeper than {MAX_DEPTH} levels")
            raise Unusable("the file is no spec: it is nested too deeply", finding=finding)
        if isinstance(event, yaml.AliasEvent):
            self._report(
                "yaml-anchor",
                event,
                path,
                f"`*{event.anchor}` repeats a value by reference",
                "write the value out again",
            )
            return None
        if event.anchor is not None:
            self._report(
                "yaml-anchor",
                event,
                path,
                f"`&{event.anchor}` names a value for reuse",
                "remove the anchor",
            )
        # "!" alone is what the parser gives a quoted scalar; it is no tag of the author's.
        if event.tag not in (None, "!"):
            self._report(
                "yaml-tag",
                event,
                path,
                f"the tag `{event.tag}` has no meaning here",
                "remove the tag",
            )
        if isinstance(event, yaml.ScalarEvent):
            return self._scalar(event, path)
        if isinstance(event, yaml.SequenceStartEvent):
            return self._sequence(path)
        return self._mapping(path)

    def _sequence(self, path: KeyPath) -> list[Any]:
        items: list[Any] = []
        while not isinstance(event := next(self._events), yaml.SequenceEndEvent):
            items.append(self._value(event, (*path, len(items))))
        return items

    def _mapping(self, path: KeyPath) -> dict[str, Any]:
        entries: dict[str, Any] = {}
        while not isinstance(event := next(self._events), yaml.MappingEndEvent):
            key = self._key(event, path)
            here = (*path, key)
            span = self._span(event)
            if key in entries:
                first = Related(self.tree.keys[here], "it stands here first")
                self._report(
                    "yaml-duplicate-key",
                    event,
                    here,
                    f"the key `{key}` is given twice",
                    "keep one of them",
                    first,
                )
                self._value(next(self._events), (*path, f"{key} (again)"))
                continue
            self.tree.keys[here] = span
            entries[key] = self._value(next(self._events), here)
        return entries

    def _key(self, event: Any, path: KeyPath) -> str:
        if not isinstance(event, yaml.ScalarEvent):
            self._value(event, (*path, "(key)"))
            self._report(
                "yaml-key",
                event,
                path,
                "a key must be a single word or number",
                "write the key as plain text",
            )
            return "(key)"
        key = self._scalar(event, path)
        return str(event.value if key is None else key)

    def _scalar(self, event: Any, path: KeyPath) -> str | int | float | bool | None:
        text: str = event.value
        character = first_invisible(text)
        if character is not None:
            self._report(
                "invisible-character",
                event,
                path,
                f"the text holds U+{ord(character):04X}, which no reader can see",
                "remove it",
            )
        if not event.implicit[0]:
            return text
        try:
            return resolve(text)
        except Ambiguous as error:
            self._report("yaml-ambiguous", event, path, str(error), error.hint)
            return text

    def _report(
        self, rule: str, event: Any, path: KeyPath, message: str, hint: str, *related: Related
    ) -> None:
        self.findings.append(Finding(rule, self._span(event), dotted(path), message, hint, related))
        if len(self.findings) >= MOST_FINDINGS:
            raise Unusable(
                "the file is no spec: too many of its values are not those of a spec",
                finding=self.findings[0],
            )

    def _span(self, event: Any) -> Span:
        start, end = event.start_mark, event.end_mark
        line = start.line + 1
        if end.line == start.line:
            return Span(line, start.column + 1, max(1, end.column - start.column))
        return Span(line, start.column + 1, max(1, len(self._source.line(line)) - start.column))
