"""The downloads of a reference: what its pages are made of, and what can be made with it."""

from __future__ import annotations

import json
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

from framegen.output import banner
from framegen.render import render_target
from framegen.site.recordings import recordings_of
from framegen.site.scripts.javascript_module import javascript_module
from framegen.targets import docs, schema, vectors
from framegen.targets.docs.markdown_pages import markdown_files

if TYPE_CHECKING:
    from collections.abc import Mapping

    from framegen.site.recordings import RecordingFile
    from framegen.targets.docs.reference import ReferenceView

# Below the root of the reference.
FOLDER = "downloads"
_KILO = 1000
# Larger numbers need no fraction.
_SHORT = 10


@dataclass(frozen=True, slots=True)
class Download:
    """A file by its path below the root of its reference, its size in bytes, and what it holds."""

    path: str
    size: int
    about: str

    @property
    def name(self) -> str:
        """The path below the folder of all downloads."""
        return self.path.removeprefix(f"{FOLDER}/")


@dataclass(frozen=True, eq=False)
class Downloads:
    """The files of one reference; `published` are those of the site that guides link to."""

    reference: ReferenceView
    published: Mapping[str, bytes]

    @cached_property
    def texts(self) -> dict[str, str]:
        """All files but for recordings, by path below the root of the reference."""
        files = {**self._spec, **self._vectors, **self._modules, **self._markdown}
        return {f"{FOLDER}/{name}": text for name, text in files.items()}

    @property
    def spec(self) -> list[Download]:
        """The spec, and the schema by which editors know its language."""
        name, helper = self._spec
        return [
            self._download(name, "the protocol as data"),
            self._download(helper, "the language of specs, for the editor"),
        ]

    @property
    def vectors(self) -> list[Download]:
        """The test vectors."""
        ((name, text),) = self._vectors.items()
        cases = json.loads(text)
        counts = (
            pluralize(len(cases["valid"]), "frame"),
            f"{pluralize(len(cases['unencodable']), 'case')} that no frame can hold",
            f"{pluralize(len(cases['invalid']), 'frame')} to refuse",
            pluralize(len(cases["streams"]), "stream"),
        )
        return [self._download(name, ", ".join(counts))]

    @property
    def modules(self) -> list[Download]:
        """The codec in JavaScript, and its types; empty where there is none."""
        return [
            self._download(name, "the types" if ".d." in name else "the codec")
            for name in self._modules
        ]

    @property
    def markdown(self) -> list[Download]:
        """The pages as Markdown, the first of them leads to all others."""
        views = [*self.reference.pages, *self.reference.message_pages]
        return [self._download(each.markdown, each.title) for each in views if each.in_markdown]

    @cached_property
    def recordings(self) -> list[RecordingFile]:
        """The recordings of the protocol among the files that guides link to."""
        return recordings_of(self.reference.model, self.published)

    @property
    def decoding(self) -> str:
        """The commands that show what the recordings hold."""
        command = f"{self.reference.protocol.name} decode --direction any"
        return "".join(f"{command} {each.word}\n" for each in self.recordings)

    def _download(self, name: str, about: str) -> Download:
        path = f"{FOLDER}/{name}"
        return Download(path, len(self.texts[path].encode()), about)

    @cached_property
    def _spec(self) -> dict[str, str]:
        compiled = self.reference.compiled
        (helper,) = render_target(schema.TARGET, compiled).values()
        return {self._spec_name: compiled.source.text, "framegen.schema.json": helper}

    @property
    def _spec_name(self) -> str:
        return f"{self.reference.folder}.yaml"

    @cached_property
    def _vectors(self) -> dict[str, str]:
        (text,) = render_target(vectors.TARGET, self.reference.compiled).values()
        return {"vectors.json": text}

    @cached_property
    def _modules(self) -> dict[str, str]:
        return javascript_module(self.reference.model)

    @cached_property
    def _markdown(self) -> dict[str, str]:
        """The pages as they are in a project, but that the spec lies beside them."""
        view = replace(self.reference, spec_file=self._spec_name)
        comment = docs.TARGET.comments[".md"]
        line = f"{comment.before}{banner(view.spec)}{comment.after}\n"
        return {name: f"{line}{text}" for name, text in markdown_files(view).items()}


def size_in_words(size: int) -> str:
    """Return a number of bytes as people say it: `764 bytes`, `9.3 kB`, `218 kB`."""
    if size < _KILO:
        return pluralize(size, "byte")
    unit, scale = ("kB", _KILO) if size < _KILO**2 else ("MB", _KILO**2)
    number = size / scale
    return f"{number:.1f} {unit}" if number < _SHORT else f"{number:.0f} {unit}"
