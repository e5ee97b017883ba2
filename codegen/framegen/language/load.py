"""Loads a spec: reads the text, keeps the positions, checks the shape."""

from __future__ import annotations

import stat
from dataclasses import dataclass
from typing import TYPE_CHECKING

from framewire.command.console import visible
from pydantic import ValidationError

from framegen.language.edition import is_newer, refusal
from framegen.language.misfit import misfits
from framegen.language.spec import Spec
from framegen.reading.findings import Finding
from framegen.reading.source import Source, below_root
from framegen.reading.yamltree import Tree, Unusable, read_tree

if TYPE_CHECKING:
    from pathlib import Path

MAX_BYTES = 1_000_000


@dataclass(frozen=True, slots=True)
class Loaded:
    """The result of reading a spec: the spec itself, if its shape is right, and the findings."""

    source: Source
    tree: Tree
    spec: Spec | None
    findings: list[Finding]


def read_source(file: Path) -> Source:
    """Read a spec file, with LF line ends. Raises Unusable for what is no text or too large."""
    name = visible(file.as_posix())
    try:
        status = file.stat()
        if not stat.S_ISREG(status.st_mode):
            raise Unusable(
                f"{name} is not a file", hint="name the spec itself, such as spec/busservo.yaml"
            )
        refuse_size(name, status.st_size)
        data = file.read_bytes()
    except FileNotFoundError:
        raise Unusable(
            f"{name} does not exist", hint="name a spec file, or run this where spec/*.yaml is"
        ) from None
    except (OSError, ValueError) as error:
        reason = getattr(error, "strerror", None) or str(error)
        raise Unusable(f"{name} cannot be read: {reason}") from None
    return source_of(name, data, below_root(file.parent.resolve() / file.name))


def refuse_size(name: str, size: int) -> None:
    """Raise Unusable for a file of more bytes than a spec has."""
    if size > MAX_BYTES:
        raise Unusable(
            f"{name} has {size / 1e6:.1f} MB, and a spec has at most {MAX_BYTES / 1e6:.0f} MB",
            hint="is it the right file?",
        )


def source_of(name: str, data: bytes, path: str = "") -> Source:
    """Return a spec as text, with LF line ends. Raises Unusable for what is no text."""
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as error:
        raise Unusable(
            f"{name} is not UTF-8 text: byte {error.start} is 0x{data[error.start]:02X}",
            hint="save it as UTF-8",
        ) from None
    return Source(name, text.replace("\r\n", "\n"), path)


def load(source: Source) -> Loaded:
    """Read the text of a spec. Raises Unusable for no YAML mapping; all else is findings."""
    tree, findings = read_tree(source)
    written_in = tree.data.get("framegen")
    if is_newer(written_in):
        # What such a spec says otherwise, this framegen cannot judge.
        message, hint = refusal(written_in)
        place = tree.value_at(("framegen",))
        return Loaded(source, tree, None, [Finding("edition", place, "framegen", message, hint)])
    try:
        spec = Spec.model_validate(tree.data)
    except ValidationError as error:
        # What YAML itself left in doubt is said once, not again as a value of the wrong kind.
        doubtful = {finding.span for finding in findings}
        shape = misfits(source, tree, error.errors(include_url=False), doubtful)
        return Loaded(source, tree, None, [*findings, *shape])
    return Loaded(source, tree, None if findings else spec, findings)
