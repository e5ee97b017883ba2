"""The test of a checksum as decoders make it: one line, where the same does for all frames."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

from framegen.model.checksums import CHECKSUMS, Crc, Sum
from framegen.model.slots import Constant
from framegen.targets.python.checksum_view import ChecksumView
from framegen.targets.python.escape import literal
from framegen.targets.python.names import envelope_name

if TYPE_CHECKING:
    from framegen.model.envelope import Envelope
    from framegen.model.model import Model
    from framegen.model.slots import Number


@dataclass(frozen=True, slots=True)
class ProofView:
    """The test of a checksum that covers one stretch of a frame, from and to which byte."""

    frame: Envelope
    checksum: Number
    start: int
    end: int | None

    @property
    def holds(self) -> str:
        """The expression that says whether it is right in `frame`, whose head is.

        It is in the way of every frame, where each call or slice costs half as much as a sum.
        """
        row = CHECKSUMS[self.checksum.method]
        if isinstance(row, Crc) and self._is_divided_on:
            # A number with its remainder behind it has always the same one.
            return f"_checksum_of({self._rest}) == 0x{self._residue(row):X}"
        if self.calls or not isinstance(row, Sum):
            return f"_checksum_of({self._covered}) == {self._number}"
        mask = (1 << 8 * self.checksum.size) - 1
        if self._is_added_on:
            # What was subtracted is there again.
            return f"sum({self._rest}) & 0xFF == 0x{row.offset & mask:02X}"
        sign = {1: "", -1: "~" if row.offset else "-"}[row.factor]
        return f"{sign}sum({self._covered}) & 0x{mask:X} == {self._number}"

    @property
    def total(self) -> int | None:
        """What the bytes of any frame add up to, modulo 256; None if they are not always the same.

        What was subtracted is there again; and what stands in front is always the same, too.
        """
        row = CHECKSUMS[self.checksum.method]
        if not self._is_added_on or self._in_front is None or not isinstance(row, Sum):
            return None
        return (row.offset + self._in_front) & 0xFF

    @property
    def is_called(self) -> bool:
        """Whether decoders call it: it is more than what all bytes add up to."""
        return self.total is None

    @property
    def given(self) -> str:
        """How the decoders are told, as an argument."""
        return "proves=proves" if self.is_called else f"total=0x{self.total:02X}"

    @property
    def why(self) -> str:
        """What the expression says, where it shows only at second sight."""
        if self._is_divided_on:
            return "Divided together with the CRC behind it, any frame leaves the same."
        if self._is_added_on:
            return "Added up together with its checksum, any frame makes the same."
        return "The checksum of what it covers is the one that is there."

    @property
    def _in_front(self) -> int | None:
        """The sum of the bytes in front of what is covered; None if it is not always the same."""
        total, at = 0, 0
        for slot in self.frame.head:
            if (
                slot.at == at < self.start
                and isinstance(slot, Constant)
                and slot.role == "constant"
            ):
                total, at = total + sum(slot.data), at + slot.size
        return total if at == self.start else None

    @property
    def calls(self) -> bool:
        """Whether it calls what works the checksum out, and does not do so itself."""
        return self.method.name != "Sum"

    @property
    def checksum_of(self) -> str:
        """What works it out, where it is called."""
        return f"{envelope_name(self.frame.name)}.checksums[0].of"

    @property
    def method(self) -> ChecksumView:
        """How it is worked out."""
        return ChecksumView(self.checksum.method, 8 * self.checksum.size)

    @property
    def _is_divided_on(self) -> bool:
        """Whether a CRC stands behind what it covers, in the order in which this is divided."""
        row, (at, size) = CHECKSUMS[self.checksum.method], (self.checksum.at, self.checksum.size)
        if not isinstance(row, Crc) or row.mixed or size < 2:
            return False
        order = "little" if row.reflected else "big"
        return self.end == at == -size and self.checksum.order == order

    @property
    def _is_added_on(self) -> bool:
        """Whether one byte behind what it covers takes away what that adds up to."""
        row = CHECKSUMS[self.checksum.method]
        is_taken = not self.calls and isinstance(row, Sum) and row.factor == -1
        return is_taken and self.checksum.size == 1 and self.end == self.checksum.at == -1

    def _residue(self, row: Crc) -> int:
        width = 8 * self.checksum.size
        return row.of(self.checksum.write(row.of(b"", width)), width)

    @property
    def _rest(self) -> str:
        """What is covered, and all behind it."""
        return f"frame[{self.start}:]" if self.start else "frame"

    @property
    def _covered(self) -> str:
        start, end = self.start or "", "" if self.end is None else self.end
        return f"frame[{start}:{end}]"

    @property
    def _number(self) -> str:
        at, size, order = self.checksum.at, self.checksum.size, self.checksum.order
        if size > 2:
            stretch = f"frame[{at}:{at + size or ''}]"
            return f"int.from_bytes({stretch}, {literal(order)})"
        places = [*range(at, at + size)]
        low, *high = places if order == "little" else reversed(places)
        return " | ".join([f"frame[{low}]", *(f"frame[{each}] << 8" for each in high)])


def proof_in_place(model: Model) -> ProofView | None:
    """Return the test of the only checksum of every frame; None where these are not all alike."""
    proofs = [_proof(frame) for frame in model.envelopes.values()]
    alike = {proof and (proof.holds, proof.method) for proof in proofs}
    return proofs[0] if len(alike) == 1 else None


def _proof(frame: Envelope) -> ProofView | None:
    if len(frame.checksums) != 1 or frame.unsent:
        return None
    (checksum,) = frame.checksums
    pieces = frame.covered(checksum, {}).pieces
    if len(pieces) != 1 or isinstance(pieces[0], bytes):
        return None
    return ProofView(frame, checksum, *pieces[0])
