"""Captures read as tables, and written as files of tables: what `tables` of a library does."""

from __future__ import annotations

from typing import TYPE_CHECKING, Generic, TypeVar

from .archive import cuts, pieces
from .archive.pieces import PIECE
from .files.arrow_file import arrow_written, names_in, refuse_target
from .files.parquet import parquet_written
from .files.rereading import rereadable
from .reader import BLOCK, batches
from .schema import schemas_of
from .tables import gathered

if TYPE_CHECKING:
    import os
    from collections.abc import Iterable, Iterator

    import pyarrow as pa

    from ..codec.protocol_codec import ProtocolCodec
    from ..frame.direction import Direction
    from .reader import Batches
    from .source import Source
    from .tables import Tables

_Piece = TypeVar("_Piece", bound=pieces.Piece)


class Captures(Generic[_Piece]):
    """Captures of a protocol: what `tables` of its library does.

    `piece` is the library's own class of their pieces.
    """

    def __init__(self, codec: ProtocolCodec, piece: type[_Piece]) -> None:
        self._codec = codec
        self._piece = piece

    def read(
        self, source: Source, *, form: str = "auto", direction: Direction | None = None
    ) -> Tables:
        """Read a capture into memory, as one table a message, and one of noise.

        `source` is the name of a file, bytes of any kind (a memory map, an array), or a stream of
        bytes. `form` is one of recordings.FORMS. `direction` is the sender of bytes for which the
        capture names none; None for a line on which both ends are received.

        The events are exactly those of StreamDecoder, with neighbouring noise joined. Raises
        RecordingError for text that makes no sense, OSError for a file that cannot be read, and
        TypeError for a source that is no bytes.
        """
        return gathered(schemas_of(self._codec), batches(self._codec, source, form, direction))

    def read_batches(
        self,
        source: Source,
        *,
        form: str = "auto",
        direction: Direction | None = None,
        block: int = BLOCK,
    ) -> Iterator[Batches]:
        """Yield the same stretch by stretch, of `block` bytes, so that memory is bounded.

        Each stretch is a dict of record batches by the name of their table, without those that
        would be empty. The batches of a table, one after the other, are the table that `read`
        returns. Raises as `read` does, and ValueError for a block of less than a byte.
        """
        if block < 1:
            raise ValueError(f"block: {block} is below 1, the least there can be")
        return batches(self._codec, source, form, direction, block)

    def write_parquet(
        self,
        source: Source,
        folder: str | os.PathLike[str],
        *,
        form: str = "auto",
        direction: Direction | None = None,
    ) -> dict[str, int]:
        """Write the tables of a capture as FOLDER/<Table>.parquet, and return the rows of each.

        A table without rows has no file. The folder is made; files of an earlier capture are
        replaced. Raises FileExistsError if it holds anything else, RecordingError and OSError as
        `read`, and leaves no file half-written.
        """
        names = schemas_of(self._codec).layouts.names
        return parquet_written(names, batches(self._codec, source, form, direction), folder)

    def write_arrow(
        self,
        source: Source,
        file: str | os.PathLike[str],
        *,
        form: str = "auto",
        direction: Direction | None = None,
    ) -> dict[str, int]:
        """Write a capture as one Arrow IPC file, and return the rows of each table.

        It has all events in the order of the capture: `event` is the name of a message, `noise` or
        `unknown`, and each message that occurs has a column of structs, null in the rows of others.
        The capture is read twice; a stream is copied to disk for that. Raises FileExistsError if
        the file is there and no Arrow file, RecordingError and OSError as `read`, and leaves no
        file half-written.
        """
        codec = self._codec
        refuse_target(file)
        with rereadable(source) as again:
            names = names_in(codec, again(), form, direction)
            made = batches(codec, again(), form, direction)
            return arrow_written(schemas_of(codec), made, file, names)

    def schemas(self) -> dict[str, pa.Schema]:
        """Return the schema of each table, by name: one a message, and `noise`."""
        return schemas_of(self._codec).every()

    def safe_cuts(
        self,
        file: str | os.PathLike[str] | bytes | bytearray | memoryview,
        size: int,
        *,
        direction: Direction | None = None,
    ) -> list[int]:
        """Return places of a raw capture, about `size` bytes apart, where decoders hold nothing.

        `file` is its name, or its bytes, as a memory map. A decoder that began at the beginning of
        the capture, or at an earlier one of these places, has emitted all that is in front of each.
        They are found by a few frames around them. Where noise leaves no such place, the next is
        further away. Raises OSError for a file that cannot be read, and ValueError for a size below
        1.
        """
        return cuts.safe_cuts(self._codec, file, size, direction)

    def scan(
        self,
        paths: str | os.PathLike[str] | Iterable[str | os.PathLike[str]],
        *,
        size: int = PIECE,
        form: str = "auto",
        direction: Direction | None = None,
    ) -> list[_Piece]:
        """Return the pieces of captures: independent work for any number of processes or machines.

        `paths` are files, patterns such as "captures/*.bin", and folders, or one of these. Of a
        folder all files are taken, and of those in it, but hidden ones and datasets. Raw captures
        are cut about every `size` bytes, where any decoder holds nothing; text recordings are one
        piece each. `form` and `direction` are as in `read`. A file that cannot be read, or is not
        there, is a piece whose work says so.

        Links are followed to files of the folder alone, and not to folders: a link that leads out
        of what is scanned is no capture of it, unless it is named itself.

        Captures are named below the folder that is scanned, or that holds all that is scanned.
        """
        return pieces.scan(self._piece, paths, size, form, direction)
