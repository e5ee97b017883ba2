"""From a file to a Spec: reads the text, keeps the positions, tests the shape."""

from __future__ import annotations

import stat
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, get_args

from pydantic import BaseModel, ValidationError

from framegen.console import visible
from framegen.language.spec import Spec
from framegen.reading.findings import Finding, did_you_mean
from framegen.reading.source import Source
from framegen.reading.yamltree import KeyPath, Tree, Unusable, dotted, read_tree

if TYPE_CHECKING:
    from collections.abc import Iterator
    from pathlib import Path

MAX_BYTES = 1_000_000


@dataclass(frozen=True, slots=True)
class Loaded:
    """What came of reading a spec: the spec itself, if its shape was right, and the findings."""

    source: Source
    tree: Tree
    spec: Spec | None
    findings: list[Finding]


def read_source(file: Path) -> Source:
    """Read a spec file, with LF line ends. Raises Unusable where it is no text of sane size."""
    name = visible(file.as_posix())
    try:
        status = file.stat()
        if not stat.S_ISREG(status.st_mode):
            raise Unusable(
                f"{name} is not a file", hint="name the spec itself, such as spec/busservo.yaml"
            )
        if status.st_size > MAX_BYTES:
            size = f"{status.st_size / 1e6:.1f} MB"
            raise Unusable(
                f"{name} has {size}, and a spec has at most {MAX_BYTES / 1e6:.0f} MB",
                hint="is it the right file?",
            )
        data = file.read_bytes()
    except FileNotFoundError:
        raise Unusable(
            f"{name} does not exist", hint="name a spec file, or run this where spec/*.yaml is"
        ) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise Unusable(f"{name} cannot be read: {reason}") from None
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unusable(
            f"{name} is not UTF-8 text: byte {error.start} is 0x{data[error.start]:02X}",
            hint="save it as UTF-8",
        ) from None
    return Source(name, text.replace("\r\n", "\n"))


def load(source: Source) -> Loaded:
    """Read a spec's text. Raises Unusable where it is no YAML mapping; the rest are findings."""
    tree, findings = read_tree(source)
    try:
        spec = Spec.model_validate(tree.data)
    except ValidationError as error:
        # What YAML itself left in doubt is said once, not again as a value of the wrong kind.
        doubtful = {finding.span for finding in findings}
        shape = [_finding(tree, problem) for problem in error.errors(include_url=False)]
        shape = [finding for finding in shape if finding.span not in doubtful]
        return Loaded(source, tree, None, [*findings, *shape])
    return Loaded(source, tree, None if findings else spec, findings)


def _finding(tree: Tree, problem: Any) -> Finding:
    """One of pydantic's errors, in the words of the spec language and at its place."""
    steps = problem["loc"]
    path = tuple(_steps_in(tree, steps))
    kind, context = problem["type"], problem.get("ctx", {})
    last = str(steps[-1])
    if kind == "missing":
        message, hint = f"the key `{last}` is missing", _described(path, last)
        return Finding("missing-key", tree.key_at(path), dotted(path), message, hint)
    if kind == "extra_forbidden":
        message = f"there is no key `{last}` here"
        return Finding(
            "unknown-key",
            tree.key_at(path),
            dotted(path),
            message,
            did_you_mean(last, _keys_at(tree, path[:-1])),
        )
    message = _MESSAGES.get(kind, "{msg}").format(
        msg=problem["msg"], found=_kind(problem["input"]), **context
    )
    place = tree.key_at(path) if last == "[key]" else tree.value_at(path)
    return Finding("wrong-value", place, dotted(path), message)


_MESSAGES = {
    "string_type": "text is expected here, not {found}; put a number or a word like true in quotes",
    "int_type": "a whole number is expected here, not {found}",
    "int_parsing": "a whole number is expected here, not {found}",
    "dict_type": "a mapping of keys is expected here, not {found}",
    "model_type": "a mapping of keys is expected here, not {found}",
    "list_type": "a list is expected here, not {found}",
    "literal_error": "{expected} is expected here, not {found}",
    "greater_than": "a number above {gt} is expected here, not {found}",
    "greater_than_equal": "a number from {ge} up is expected here, not {found}",
    "union_tag_not_found": "the key `is` is missing: it says what kind of part this is",
    "union_tag_invalid": "`{tag}` is no kind of part; choose one of {expected_tags}",
}


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
    return f"`{text if len(text) <= 40 else text[:40] + '...'}`"


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


def _keys_at(tree: Tree, path: KeyPath) -> list[str]:
    """List the keys that the language has at `path`; of a union, those of what fits best there."""
    here: Any = tree.data
    for step in path:
        here = here[step]
    known = [
        [info.alias or name for name, info in model.model_fields.items()]
        for model in _models_at(path)
    ]
    return max(known, key=lambda keys: len(here.keys() & keys), default=[])


def _described(path: KeyPath, key: str) -> str:
    """Say what a missing key is for, with the description that editors show too."""
    told = [
        info.description
        for model in _models_at(path[:-1])
        for name, info in model.model_fields.items()
        if key in (name, info.alias)
    ]
    return next(filter(None, told), "")


def _models_at(path: KeyPath) -> list[type[BaseModel]]:
    """Find the model of the mapping at `path`; of a union, every member."""
    models: list[type[BaseModel]] = [Spec]
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
