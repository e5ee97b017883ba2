"""The interface of a target: one kind of output, such as a library for one language."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from framegen.compile import Compiled
    from framegen.language.spec import Example
    from framegen.model.layout import MessageLayout
    from framegen.model.model import Model
    from framegen.reading.yamltree import KeyPath


@dataclass(frozen=True, slots=True)
class Snippet:
    """Code that shows an example of a message: its name beside others, and its language."""

    name: str
    language: str
    code: str


ShowExample: TypeAlias = "Callable[[Model, MessageLayout, Example], list[Snippet]]"
Snippets: TypeAlias = Mapping[str, ShowExample]


@dataclass(frozen=True, slots=True)
class Comment:
    """The text around a line that makes it a comment."""

    before: str
    after: str = ""


@dataclass(frozen=True, slots=True)
class Reserved:
    """Words that a target has taken already, for names of one kind such as `field`.

    `why` continues a sentence about the name ("is a word of Python itself"); a name that is one of
    them gets `suffix` behind it.
    """

    kind: str
    words: frozenset[str]
    why: str
    suffix: str


@dataclass(frozen=True, slots=True)
class BentName:
    """A name that a target changes, its place in the spec, and the reason."""

    path: KeyPath
    kind: str
    name: str
    bent: str
    why: str


def _no_folders(_model: Model) -> tuple[str, ...]:
    return ()


def _nothing_bent(_model: Model) -> list[BentName]:
    return []


@dataclass(frozen=True, slots=True)
class Target:
    """One kind of output. Everything that the rest of framegen asks of a target stands here.

    `render` gives the files by path below the project's root: the same for the same spec, whatever
    the disk holds. It is handed the snippets of all targets, by name of the target. `folders` are
    those that hold nothing else, `comments` how a line becomes a comment, by suffix: such files get
    the banner, but for those in `copies`, folders of what is brought as it is. `reserved` are the
    words that no name may be in this target, and `bent` what became of names that are. `snippets`
    shows an example of a message as code, in several ways. `shared` says that the files are the
    same for every spec: they belong to framegen.
    """

    name: str
    about: str
    render: Callable[[Compiled, Snippets], dict[str, str]]
    folders: Callable[[Model], tuple[str, ...]] = _no_folders
    comments: Mapping[str, Comment] = field(default_factory=dict)
    copies: Callable[[Model], tuple[str, ...]] = _no_folders
    reserved: tuple[Reserved, ...] = ()
    bent: Callable[[Model], list[BentName]] = _nothing_bent
    snippets: ShowExample | None = None
    shared: bool = False
