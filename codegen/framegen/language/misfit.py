"""Findings on a spec that does not fit the language: pydantic's errors, in our words."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from framewire.codec.hextext import is_hex, read_hex
from pydantic import BaseModel

from framegen.language.edition import LATEST
from framegen.language.other_words import kind_of, other_key, other_kind
from framegen.language.spec import ListField, NumberField, Spec
from framegen.language.values import to_hex
from framegen.reading.findings import MOST_FINDINGS, Finding, did_you_mean
from framegen.reading.scalars import Ambiguous, resolve
from framegen.reading.source import Source, Span
from framegen.reading.yamltree import KeyPath, Tree, dotted

if TYPE_CHECKING:
    from collections.abc import Container, Iterable, Iterator

_MESSAGES = {
    "string_type": "text is expected here, not {found}",
    "int_type": "a whole number is expected here, not {found}",
    "int_parsing": "a whole number is expected here, not {found}",
    "int_parsing_size": "a smaller number is expected here, not {found}",
    "bool_type": "`true` or `false` is expected here, not {found}",
    "dict_type": "a mapping of keys is expected here, not {found}",
    "model_type": "a mapping of keys is expected here, not {found}",
    "model_attributes_type": "a mapping of keys is expected here, not {found}",
    "list_type": "a list is expected here, not {found}",
    "literal_error": "{expected} is expected here, not {found}",
    "greater_than": "a number above {gt} is expected here, not {found}",
    "greater_than_equal": "a number from {ge} up is expected here, not {found}",
    "less_than_equal": "a number up to {le} is expected here, not {found}",
    "union_tag_not_found": "the key `is` is missing: it says what kind of part this is",
    "union_tag_invalid": "`{tag}` is no kind of part; choose one of {expected_tags}",
    "notation": "{message}",
    "notation_type": "{what} is written as text, like `{example}`, and this is {found}",
}
# A value that YAML takes for a comment, such as that of a colour.
_COMMENT = re.compile(r"[^#'\"]*: +(#\w+)")


def misfits(
    source: Source,
    tree: Tree,
    problems: Iterable[Any],
    doubtful: Container[Span],
    language: type[BaseModel] = Spec,
) -> Iterator[Finding]:
    """Turn pydantic's errors into findings, except at the `doubtful` places.

    `language` is the model of the whole file. Hints are worked out only for the findings that are
    shown.
    """
    placed = sorted((_Misfit.of(tree, problem) for problem in problems), key=lambda each: each.span)
    shown = [misfit for misfit in placed if misfit.span not in doubtful]
    for number, misfit in enumerate(shown):
        yield misfit.finding(source, tree, language if number < MOST_FINDINGS else None)


@dataclass(frozen=True, slots=True)
class _Misfit:
    """One of pydantic's errors, and its place."""

    problem: Any
    path: KeyPath
    span: Span

    @classmethod
    def of(cls, tree: Tree, problem: Any) -> _Misfit:
        path = tuple(_steps_in(tree, problem["loc"]))
        on_key = problem["type"] in ("missing", "extra_forbidden") or problem["loc"][-1] == "[key]"
        return cls(problem, path, tree.key_at(path) if on_key else tree.value_at(path))

    def finding(self, source: Source, tree: Tree, language: type[BaseModel] | None) -> Finding:
        """Return the finding, with a hint if a language is given."""
        kind, last = self.problem["type"], str(self.problem["loc"][-1])
        path = dotted(self.path)
        if kind == "missing":
            hint = _missing(tree, self.path, last, language) if language else ""
            return Finding("missing-key", self.span, path, f"the key `{last}` is missing", hint)
        if kind == "extra_forbidden":
            hint = _meant(tree, self.path, last, language) if language else ""
            return Finding("unknown-key", self.span, path, f"there is no key `{last}` here", hint)
        context = {"found": _kind(self.problem["input"]), **self.problem.get("ctx", {})}
        text: str = _MESSAGES[kind] if kind in _MESSAGES else self.problem["msg"]
        message = text.format_map(context)
        span = _part(source, self.span, context.get("part", ""))
        return Finding("wrong-value", span, path, message, self._hint(source))

    def _hint(self, source: Source) -> str:
        if self.path == ("framegen",):
            return f"write `framegen: {LATEST}`"
        if self.problem["type"].startswith("union_tag"):
            return self._kind_of_part()
        if self.problem["type"] not in ("string_type", "notation_type"):
            return ""
        if not isinstance(self.problem["input"], bool | int | float):
            lost = _COMMENT.match(source.line(self.span.line))
            return f'put it in quotes, since # begins a comment: "{lost[1]}"' if lost else ""
        start = self.span.column - 1
        text = source.line(self.span.line)[start : start + self.span.length]
        if self.problem.get("ctx", {}).get("what") == "hex":
            if not is_hex(text):
                return ""
            text = to_hex(read_hex(text))
        return f'put it in quotes: "{text}"'

    def _kind_of_part(self) -> str:
        """Say what kind of part it was meant to be."""
        if self.problem["type"] == "union_tag_invalid":
            return other_kind(str(self.problem["ctx"]["tag"]))
        kind = kind_of(self.problem["input"])
        return f"add `is: {kind}`" if kind else ""


def _kind(value: object) -> str:
    if value is None:
        return "nothing"
    if isinstance(value, dict):
        return "a mapping"
    if isinstance(value, list):
        return "a list"
    if isinstance(value, bool):
        return f"the truth value `{str(value).lower()}`"
    text = str(value)
    what = "the text " if isinstance(value, str) and not _is_plain(value) else ""
    return f"{what}`{text if len(text) <= 40 else text[:40] + '...'}`"


def _is_plain(text: str) -> bool:
    """Tell whether the text would still be text without quotes."""
    try:
        return resolve(text) == text
    except Ambiguous:
        return False


def _part(source: Source, span: Span, part: str) -> Span:
    """Find the wrong `part` of a value at `span`; all of it, if the part cannot be found."""
    word = re.compile(rf"(?<!\w){re.escape(part)}(?!\w)")
    for number in range(span.line, len(source.lines) + 1) if part else ():
        found = word.search(source.line(number), span.column - 1 if number == span.line else 0)
        if found is not None:
            return Span(number, found.start() + 1, len(part))
    return span


def _steps_in(tree: Tree, steps: tuple[str | int, ...]) -> Iterator[str | int]:
    """Keep the steps of pydantic's location that are in the file: it adds tags of its unions."""
    here: Any = tree.data
    for number, step in enumerate(steps):
        if isinstance(here, dict):
            key = str(step)
            if key in here:
                here = here[key]
                yield key
            elif number == len(steps) - 1 and key != "[key]":
                yield key
        elif isinstance(here, list) and isinstance(step, int) and step < len(here):
            here = here[step]
            yield step


def _meant(tree: Tree, path: KeyPath, key: str, language: type[BaseModel]) -> str:
    """Say what a key that there is not was meant to be."""
    model = _model_at(tree, path[:-1], language)
    if model is None:
        return ""
    if " " in key and _at(tree, path[:-1]).get(key) is None:
        return "put the whole text in quotes: between `{` and `}`, a comma ends it"
    known = _keys(model)
    hint = other_key(model, key)
    if "`covers`" in hint and "covers" not in _at(tree, path[:-1]):
        return f"write {_names_of_parts(tree, path, 'covers')}"
    if "`counts`" in hint and "counts" not in _at(tree, path[:-1]):
        return f"write {_names_of_parts(tree, path, 'counts')}"
    return hint or did_you_mean(key, known)


def _missing(tree: Tree, path: KeyPath, key: str, language: type[BaseModel]) -> str:
    """Describe a missing key, with the description that editors show, or a line to paste."""
    model = _model_at(tree, path[:-1], language)
    if model is None:
        return ""
    if key in ("covers", "counts"):
        return f"add {_names_of_parts(tree, path, key)}"
    described = (
        info.description
        for name, info in model.model_fields.items()
        if key in (name, info.alias) and info.description
    )
    return next(described, "")


def _names_of_parts(tree: Tree, path: KeyPath, key: str) -> str:
    """Return a line that names the parts which a length or a checksum mostly has."""
    *around, own, _ = path
    parts: dict[str, Any] = _at(tree, tuple(around))
    kinds = {name: part.get("is") for name, part in parts.items() if isinstance(part, dict)}
    left_out = {"constant"} if key == "counts" else {"constant", "checksum"}
    named = [name for name, kind in kinds.items() if name != own and kind not in left_out]
    if key == "counts" and own in kinds:
        behind = list(kinds)[list(kinds).index(str(own)) + 1 :]
        named = [name for name in behind if parts[name].get("sent") is not False]
    return f"`{key}: [{', '.join(named)}]`, or those of them that the document says"


def _at(tree: Tree, path: KeyPath) -> Any:
    here: Any = tree.data
    for step in path:
        here = here[step]
    return here


def _keys(model: type[BaseModel]) -> list[str]:
    return [info.alias or name for name, info in model.model_fields.items()]


def _model_at(tree: Tree, path: KeyPath, language: type[BaseModel]) -> type[BaseModel] | None:
    """Find the model of the mapping at `path`; of a union, the member that it is meant to be."""
    models, here = _models_at(path, language), _at(tree, path)
    if not isinstance(here, dict):
        return models[0] if models else None
    if ListField in models and NumberField in models:
        return ListField if {"element", "fields"} & here.keys() else NumberField
    kind = here.get("is")
    for model in models:
        tag = model.model_fields.get("is_")
        if tag is not None and kind in get_args(tag.annotation):
            return model
    return max(models, key=lambda model: len(here.keys() & {*_keys(model)}), default=None)


def _models_at(path: KeyPath, language: type[BaseModel]) -> list[type[BaseModel]]:
    """Find the model of the mapping at `path`; of a union, every member."""
    models: list[type[BaseModel]] = [language]
    for step in path:
        named = [
            info.annotation
            for model in models
            for name, info in model.model_fields.items()
            if step in (name, info.alias)
        ]
        # A step that is no key of the model is a place in a list, or a name that the author chose:
        # the mapping goes on below it.
        if named:
            models = [model for annotation in named for model in _models_in(annotation)]
    return models


def _models_in(annotation: Any) -> list[type[BaseModel]]:
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return [annotation]
    return [model for argument in get_args(annotation) for model in _models_in(argument)]
