"""Cyclic redundancy checks: the remainder of a division by a polynomial."""

from __future__ import annotations

from binascii import crc32, crc_hqx

from .running import Running

TYPE_CHECKING = False  # typing alone would double the time that the import takes
if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from .running import Piece

# Python has two polynomials in C, each in one order of bits.
_IN_HQX, _IN_CRC32 = (16, 0x1021), (32, 0x04C1_1DB7)


class Crc:
    """A remainder of `width` bits: begun with `init`, and xor `xor_out` in the end.

    Where it is reflected, the lowest bit of each byte comes first, and that of the remainder last,
    unless it is mixed. `of` is a function, which returns the checksum of some bytes.
    """

    __slots__ = ("_powers", "init", "mixed", "of", "reflected", "table", "width", "xor_out")

    def __init__(
        self,
        width: int,
        poly: int,
        *,
        init: int = 0,
        reflected: bool = False,
        xor_out: int = 0,
        mixed: bool = False,
    ) -> None:
        self.width, self.reflected, self.xor_out, self.mixed = width, reflected, xor_out, mixed
        self.init = _reversed(init, width) if reflected else init
        self.table = _byte_table(width, poly, reflected=reflected)
        make = {_IN_HQX: _with_hqx, _IN_CRC32: _with_crc32}.get((width, poly), _with_table)
        self.of = _with_table(self) if mixed else make(self)
        # What 1, 2, 4, … zero bytes make of a register: a table for each byte of it.
        self._powers: list[Sequence[Sequence[int]]] = []

    def running(self) -> RunningCrc:
        """Return what works it out along a stream."""
        return RunningCrc(self)

    def registers(self, register: int, data: bytes) -> list[int]:
        """Return what the register is after each byte."""
        table, registers = self.table, []
        if self.reflected:
            for byte in data:
                register = table[(register ^ byte) & 0xFF] ^ register >> 8
                registers.append(register)
            return registers
        shift, kept = self.width - 8, (1 << self.width - 8) - 1
        for byte in data:
            register = table[register >> shift ^ byte] ^ (register & kept) << 8
            registers.append(register)
        return registers

    def finish(self, register: int) -> int:
        """Return the checksum that a register makes."""
        return (_reversed(register, self.width) if self.mixed else register) ^ self.xor_out

    def after_zeros(self, register: int, count: int) -> int:
        """Return what the register is after `count` zero bytes, by powers of two of them."""
        powers, number = self._powers, 0
        while count:
            if number == len(powers):
                powers.append(self._next_power())
            if count & 1:
                register = _mapped(powers[number], register)
            count >>= 1
            number += 1
        return register

    def _next_power(self) -> Sequence[Sequence[int]]:
        bits = [1 << bit for bit in range(self.width)]
        if self._powers:
            last = self._powers[-1]
            images = [_mapped(last, _mapped(last, bit)) for bit in bits]
        else:
            images = [self.registers(bit, b"\0")[0] for bit in bits]
        return [_combined(images[bit : bit + 8]) for bit in range(0, self.width, 8)]


class RunningCrc(Running):
    """The remainder of any stretch of a stream, by those of what ends where it begins and ends."""

    __slots__ = ()

    _checksum: Crc

    def _begin(self) -> int:
        return 0

    def _go_on(self, data: bytes) -> None:
        self._registers += self._checksum.registers(self._registers[-1], data)

    def _joined(self, pieces: list[Piece]) -> int:
        crc, registers = self._checksum, self._registers
        register = crc.init
        for piece in pieces:
            if isinstance(piece, bytes):
                register = [register, *crc.registers(register, piece)][-1]
            else:
                start, end = piece
                # Remainders add up: what was there before the stretch is taken out again.
                register = crc.after_zeros(register ^ registers[start], end - start)
                register ^= registers[end]
        return crc.finish(register)


def _byte_table(width: int, poly: int, *, reflected: bool) -> list[int]:
    """Return what each byte makes of a register that is zero."""
    images = []
    top, poly_reflected = 1 << width - 1, _reversed(poly, width)
    for bit in range(8):
        register = 1 << bit if reflected else 1 << width - 8 + bit
        for _ in range(8):
            if reflected:
                register = register >> 1 ^ (poly_reflected if register & 1 else 0)
            else:
                register = (register & ~top) << 1 ^ (poly if register & top else 0)
        images.append(register)
    return _combined(images)


def _combined(images: Sequence[int]) -> list[int]:
    """Return what each combination of eight bits is mapped to, from what each bit is."""
    table = [0]
    for image in images:
        table += [value ^ image for value in table]
    return table


def _mapped(tables: Sequence[Sequence[int]], register: int) -> int:
    value = 0
    for table in tables:
        value ^= table[register & 0xFF]
        register >>= 8
    return value


def _reversed(value: int, width: int) -> int:
    return int(f"{value:0{width}b}"[::-1], 2)


_REVERSED = bytes(_reversed(byte, 8) for byte in range(256))


def _with_table(crc: Crc) -> Callable[[bytes], int]:
    table, init, xor_out, width = crc.table, crc.init, crc.xor_out, crc.width
    shift, kept = width - 8, (1 << width - 8) - 1

    def of_a_byte(data: bytes) -> int:
        register = init
        for byte in data:
            register = table[register ^ byte]
        return register ^ xor_out

    def reflected(data: bytes) -> int:
        register = init
        for byte in data:
            register = table[(register ^ byte) & 0xFF] ^ register >> 8
        return register ^ xor_out

    def straight(data: bytes) -> int:
        register = init
        for byte in data:
            register = table[register >> shift ^ byte] ^ (register & kept) << 8
        return register ^ xor_out

    if crc.mixed:
        return lambda data: crc.finish([init, *crc.registers(init, data)][-1])
    if width == 8:
        return of_a_byte
    if width == 16:
        return _in_halves(crc)
    return reflected if crc.reflected else straight


def _in_halves(crc: Crc) -> Callable[[bytes], int]:
    """Return a function for a register of two bytes: the first half meets the next byte.

    Half of such a number is one that Python has ready, and need not make.
    """
    first_at, second_at = (0, 8) if crc.reflected else (8, 0)
    first_init, second_init = crc.init >> first_at & 0xFF, crc.init >> second_at & 0xFF
    halves = [(value >> first_at & 0xFF, value >> second_at & 0xFF) for value in crc.table]
    xor_out = crc.xor_out

    def of(data: bytes) -> int:
        first, second = first_init, second_init
        for byte in data:
            image, behind = halves[first ^ byte]
            first, second = image ^ second, behind
        return (first << first_at | second << second_at) ^ xor_out

    return of


def _with_hqx(crc: Crc) -> Callable[[bytes], int]:
    init, xor_out, reverse = crc.init, crc.xor_out, _REVERSED
    if not crc.reflected:
        return lambda data: crc_hqx(data, init) ^ xor_out
    init = _reversed(init, 16)

    def reflected(data: bytes) -> int:
        register = crc_hqx(data.translate(reverse), init)
        return (reverse[register & 0xFF] << 8 | reverse[register >> 8]) ^ xor_out

    return reflected


def _with_crc32(crc: Crc) -> Callable[[bytes], int]:
    # Python's begins and ends with all bits inverted.
    every, reverse = 0xFFFF_FFFF, _REVERSED
    xor_out = crc.xor_out ^ every
    if crc.reflected:
        init = crc.init ^ every
        return lambda data: crc32(data, init) ^ xor_out
    init = _reversed(crc.init, 32) ^ every

    def straight(data: bytes) -> int:
        register = crc32(data.translate(reverse), init)
        return int.from_bytes(register.to_bytes(4, "little").translate(reverse), "big") ^ xor_out

    return straight
