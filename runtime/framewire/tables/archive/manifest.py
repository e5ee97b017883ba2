"""Which pieces of a dataset are done: a small file for each, written last.

It is written before the piece is begun as well, so that whatever is left of one that was never
finished can be told, and removed when it is of no use any more.
"""

from __future__ import annotations

import errno
import json
import shutil
from contextlib import suppress
from functools import cache
from hashlib import blake2b
from itertools import accumulate
from typing import TYPE_CHECKING, Any
from urllib.parse import quote
from uuid import uuid4

from ..schema import schemas_of
from .capture_files import MANIFESTS

if TYPE_CHECKING:
    from collections.abc import Iterator, Mapping
    from pathlib import Path

    from ...codec.protocol_codec import ProtocolCodec
    from .pieces import Piece

_LONGEST_NAME = 200

# What a manifest says of its piece, and what it says once the piece is done.
_PIECE = {
    "capture": (str,),
    "start": (int,),
    "end": (int,),
    "form": (str,),
    "direction": (str, type(None)),
    "stamp": (list, type(None)),
}
_DONE = {"rows": (dict,), "sizes": (dict,)}


class ManifestError(ValueError):
    """A file that is in the place of a manifest, and is none; the text says what to do."""


class Manifest:
    """What a dataset knows of one piece, and where the files of that are."""

    def __init__(self, folder: Path, piece: Piece) -> None:
        self._folder = folder
        self._library = piece.codec.package.rpartition(".")[2]
        self._capture = f"capture={_file_name(piece.capture)}"
        self._said: dict[str, Any] = {
            "capture": piece.capture,
            "start": piece.start,
            "end": piece.end,
            "form": piece.form,
            "direction": None if piece.direction is None else piece.direction.value,
            "stamp": None if piece.stamp is None else [*piece.stamp],
        }
        # The same name means the same bytes, read in the same way.
        known = blake2b(json.dumps([self._said, _tables(piece.codec)]).encode(), digest_size=6)
        self._name = f"{piece.start:015}-{known.hexdigest()}"
        self._manifests = folder / MANIFESTS / self._capture
        self._own = self._manifests / f"{self._name}.json"

    @property
    def rows(self) -> dict[str, int] | None:
        """The rows of each table, if the piece is done and its files are there.

        Raises ManifestError.
        """
        said = _read(self._own)
        if said is None:
            return None
        if not _is_of_a_piece(said):
            problem = "it is damaged, and does not tell what is done: remove it"
            raise ManifestError(f"{self._own}: {problem}, and the piece is done again")
        rows: dict[str, int] | None = said.get("rows")
        # A computer that lost its power may have kept the manifest without the files.
        if rows is None or said["sizes"] != {table: _size(self._file(table)) for table in rows}:
            return None
        return rows

    def begin(self) -> Path:
        """Note that the piece is begun, and return a new folder for its files."""
        unfinished = self._manifests / f"{self._name}.{uuid4().hex[:12]}"
        unfinished.mkdir(parents=True)
        try:
            self._refuse_others(unfinished)
            if not self._own.exists():
                _write(unfinished, self._own, self._said)
        except BaseException:
            shutil.rmtree(unfinished, ignore_errors=True)
            raise
        return unfinished

    def finish(self, unfinished: Path, rows: dict[str, int]) -> None:
        """Take over the files of the piece, in place of all that is not valid any more."""
        for path in self._replaced():
            self._remove(path)
        made = {table: unfinished / f"{table}.parquet" for table in rows}
        sizes = {table: _size(path) for table, path in made.items()}
        for table, path in made.items():
            final = self._file(table)
            final.parent.mkdir(parents=True, exist_ok=True)
            path.replace(final)
        _write(unfinished, self._own, {**self._said, "rows": rows, "sizes": sizes})
        # Also those of a worker that was stopped.
        self._remove_unfinished(self._name)

    def _file(self, table: str) -> Path:
        """Return where the piece has its rows of a table."""
        return self._folder / table / self._capture / f"{self._name}.parquet"

    def _refuse_others(self, unfinished: Path) -> None:
        """Raise FileExistsError for a dataset of another protocol: its tables are not these.

        Raises ManifestError if it does not tell of which it is.
        """
        path = self._folder / MANIFESTS / "library.json"
        said = _read(path)
        if said is None:
            _write(unfinished, path, {"library": self._library})
        elif not _has(said, {"library": (str,)}):
            problem = "it is damaged, and does not tell whose captures the dataset holds"
            raise ManifestError(f"{path}: {problem}: remove it if they are of {self._library}")
        elif said["library"] != self._library:
            problem = f"it holds captures of {said['library']}: name another folder"
            raise FileExistsError(errno.EEXIST, problem, str(self._folder))

    def _replaced(self) -> Iterator[Path]:
        """Yield the manifests of what this piece takes the place of."""
        for path in sorted(self._manifests.glob("*.json")):
            other = _read(path)
            is_readable = _is_of_a_piece(other)
            if path != self._own and (not is_readable or self._takes_place_of(other)):
                yield path

    def _takes_place_of(self, other: dict[str, Any]) -> bool:
        """Tell whether another piece is of a file as it was, or has bytes of this one."""
        if other["capture"] != self._said["capture"]:
            # A disk on which small letters are large ones has one folder for both.
            return False
        if other["stamp"] != self._said["stamp"]:
            return True
        start, end = self._said["start"], self._said["end"]
        return bool(other["start"] < end and start < other["end"])

    def _remove(self, manifest: Path) -> None:
        """Remove a piece: its files first, so that whatever is left is still known."""
        name = manifest.stem
        for path in self._folder.glob(f"*/{self._capture}/{name}.parquet"):
            path.unlink(missing_ok=True)
        self._remove_unfinished(name)
        manifest.unlink(missing_ok=True)

    def _remove_unfinished(self, name: str) -> None:
        for path in self._manifests.glob(f"{name}.*"):
            if path.is_dir():
                shutil.rmtree(path, ignore_errors=True)


def _size(path: Path) -> int | None:
    """Return the size of a file; None if it is not there."""
    with suppress(FileNotFoundError):
        return path.stat().st_size
    return None


def _write(unfinished: Path, target: Path, said: dict[str, Any]) -> None:
    """Write a file, which is there as a whole or not at all."""
    part = unfinished / target.name
    part.write_text(json.dumps(said, indent=1), encoding="utf-8")
    part.replace(target)


def _read(manifest: Path) -> Any:
    """Return what a manifest says, whatever that is; None if it is not there, or no JSON."""
    with suppress(FileNotFoundError, ValueError, RecursionError):
        return json.loads(manifest.read_text(encoding="utf-8"))
    return None


def _is_of_a_piece(said: Any) -> bool:
    """Tell whether this is what a manifest says of a piece, begun or done."""
    if not _has(said, _PIECE):
        return False
    if not _DONE.keys() & said.keys():
        return True
    return _has(said, _DONE) and all(type(count) is int for count in said["rows"].values())


def _has(said: Any, kinds: Mapping[str, tuple[type, ...]]) -> bool:
    """Tell whether this is a mapping that has values of these kinds."""
    if not isinstance(said, dict):
        return False
    return all(name in said and type(said[name]) in among for name, among in kinds.items())


def _file_name(capture: str) -> str:
    """Return the name of a capture as that of one folder, which datasets turn back.

    They turn back UTF-8 alone: other bytes of a name are written as escapes.
    """
    text = capture.encode("utf-8", "backslashreplace").decode()
    name = quote(text, safe="")
    if len(name) <= _LONGEST_NAME:
        return name
    # Whole characters: half of one could not be turned back.
    ends = accumulate(len(quote(each, safe="")) for each in text)
    end = max((end for end in ends if end <= _LONGEST_NAME), default=0)
    return f"{name[:end]}~{blake2b(name.encode(), digest_size=6).hexdigest()}"


@cache
def _tables(codec: ProtocolCodec) -> str:
    """Return what the tables are made of: pieces that were written with others are done again."""
    every = schemas_of(codec).every()
    made = {name: [(each.name, str(each.type)) for each in of] for name, of in every.items()}
    return blake2b(json.dumps(made).encode(), digest_size=6).hexdigest()
