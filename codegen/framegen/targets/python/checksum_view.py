"""A checksum as the templates show it: what of the runtime works it out, and how that is made."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.checksums import CHECKSUMS, Crc, Fletcher, Sum, Xor

if TYPE_CHECKING:
    from collections.abc import Iterator

    from framegen.model.checksums import Checksum
    from framegen.model.model import Model


@dataclass(frozen=True, slots=True)
class ChecksumView:
    """A method of the catalogue, as wide as the number that holds it."""

    method: str
    width: int

    @property
    def module(self) -> str:
        modules = {"Crc": "crc", "Fletcher": "fletcher", "Sum": "byte_sum", "Xor": "byte_sum"}
        return modules.get(self.name, "word_sum")

    @property
    def name(self) -> str:
        kind = type(self._row).__name__
        return f"Word{kind}" if self._is_unusual else kind

    @property
    def made(self) -> str:
        return f"{self.name}({', '.join(self._arguments())})"

    @property
    def _row(self) -> Checksum:
        return CHECKSUMS[self.method]

    def _arguments(self) -> Iterator[str]:
        row = self._row
        if isinstance(row, Xor):
            yield from self._of_xor(row)
        elif isinstance(row, Sum):
            yield from self._of_sum(row)
        elif isinstance(row, Fletcher):
            yield f"{self.width}, {row.modulus}"
            if row.start:
                yield f"start={row.start}"
        elif isinstance(row, Crc):
            yield from self._of_crc(row)

    @property
    def _is_unusual(self) -> bool:
        """Whether it is of words, carries or leaves bits out: what few protocols have."""
        match self._row:
            case Sum() as row:
                return row.word > 1 or row.carried or row.left_out > 0
            case Xor() as row:
                return row.word > 1 or row.mask != 0xFF
            case _:
                return False

    def _of_sum(self, row: Sum) -> Iterator[str]:
        if self._is_unusual:
            yield str(row.word)
        yield str(self.width - row.left_out)
        if row.factor == -1:
            yield "inverted=True" if row.offset else "negated=True"
        if row.carried:
            yield "carried=True"

    def _of_xor(self, row: Xor) -> Iterator[str]:
        if self._is_unusual:
            yield f"{row.word}, 0x{row.mask:0{2 * row.word}X}"
            if row.xor_out:
                yield f"xor_out=0x{row.xor_out:02X}"
        elif row.xor_out:
            yield f"0x{row.xor_out:02X}"

    def _of_crc(self, row: Crc) -> Iterator[str]:
        yield f"{self.width}, {self._hex(row.poly)}"
        if row.init:
            yield f"init={self._hex(row.init)}"
        if row.reflected:
            yield "reflected=True"
        if row.mixed:
            yield "mixed=True"
        if row.xor_out:
            yield f"xor_out={self._hex(row.xor_out)}"

    def _hex(self, value: int) -> str:
        return f"0x{value:0{self.width // 4}X}"


def checksums_of(model: Model) -> list[ChecksumView]:
    """Return what works out the checksums of a protocol's own frames."""
    return [
        ChecksumView(part.method, 8 * part.size)
        for frame in model.envelopes.values()
        for part in frame.checksums
    ]
