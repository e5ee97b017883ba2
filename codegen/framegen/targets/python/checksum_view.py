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
        return {"Crc": "crc", "Fletcher": "fletcher"}.get(self.name, "byte_sum")

    @property
    def name(self) -> str:
        return type(self._row).__name__

    @property
    def made(self) -> str:
        return f"{self.name}({', '.join(self._arguments())})"

    @property
    def files(self) -> set[str]:
        return {f"_frame/{self.module}.py", "_frame/running.py"}

    @property
    def _row(self) -> Checksum:
        return CHECKSUMS[self.method]

    def _arguments(self) -> Iterator[str]:
        row = self._row
        if isinstance(row, Xor):
            if row.xor_out:
                yield f"0x{row.xor_out:02X}"
        elif isinstance(row, Sum):
            yield str(self.width)
            if row.factor == -1:
                yield "inverted=True" if row.offset else "negated=True"
        elif isinstance(row, Fletcher):
            yield f"{self.width}, {row.modulus}"
            if row.start:
                yield f"start={row.start}"
        elif isinstance(row, Crc):
            yield from self._of_crc(row)

    def _of_crc(self, row: Crc) -> Iterator[str]:
        yield f"{self.width}, {self._hex(row.poly)}"
        if row.init:
            yield f"init={self._hex(row.init)}"
        if row.reflected:
            yield "reflected=True"
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
