"""The catalogue of checksums: every method that a spec can name, and what it works out.

A row is plain, slow and a reference: every language is held to it. Those of the published catalogue
of CRCs (reveng.sourceforge.io/crc-catalogue) have its names, in lower case.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from difflib import get_close_matches
from functools import cache
from typing import TYPE_CHECKING

from framewire.frame.pluralize import pluralize

if TYPE_CHECKING:
    from collections.abc import Collection, Iterator, Mapping, Sequence

CHECK_DATA = b"123456789"
"""What the check value of a method is the checksum of."""


@dataclass(frozen=True)
class Checksum:
    """A method: its name, what it is, and its check value for each width in bits that it has."""

    name: str
    about: str
    checks: Mapping[int, int]

    @property
    def widths(self) -> tuple[int, ...]:
        """The widths that it has, in bits."""
        return tuple(self.checks)

    def of(self, data: bytes, width: int) -> int:
        """Return the checksum of `data`, in one of its widths."""
        raise NotImplementedError

    def tells_apart(self, size: int) -> bool:
        """Tell whether data that differ in so many bytes on end never have the same checksum."""
        raise NotImplementedError


@dataclass(frozen=True)
class Sum(Checksum):
    """The bytes added up, with a factor and an offset, as many bits of it as the part has.

    Some highest bits may be left out. With `words`, numbers of `word` bytes are added instead, the
    low byte first; with `carried`, what goes beyond the highest bit is added to the lowest.
    """

    factor: int
    offset: int
    left_out: int = 0
    word: int = 1
    carried: bool = False

    def of(self, data: bytes, width: int) -> int:
        """Return the checksum of `data`."""
        bits = width - self.left_out
        total = sum(_words(data, self.word))
        if self.carried and total:
            total = (total - 1) % ((1 << bits) - 1) + 1
        return (self.factor * total + self.offset) % (1 << bits)

    def tells_apart(self, size: int) -> bool:
        """Tell whether data that differ in so many bytes on end never have the same checksum."""
        return size == 1 and not self.left_out and not self.carried


@dataclass(frozen=True)
class Xor(Checksum):
    """The exclusive or of all bytes, and of a last one; of this, the bits of a mask.

    Instead of bytes, it may be of numbers of `word` bytes, the low byte first.
    """

    xor_out: int
    mask: int = 0xFF
    word: int = 1

    def of(self, data: bytes, width: int) -> int:  # noqa: ARG002 - it has but one
        """Return the checksum of `data`."""
        value = self.xor_out
        for word in _words(data, self.word):
            value ^= word
        return value & self.mask

    def tells_apart(self, size: int) -> bool:
        """Tell whether data that differ in so many bytes on end never have the same checksum."""
        return size == 1 and self.mask + 1 == 1 << 8 * self.word


@dataclass(frozen=True)
class Fletcher(Checksum):
    """Two sums: of the bytes, and of what the first one was after each; the second on top."""

    modulus: int
    start: int

    def of(self, data: bytes, width: int) -> int:
        """Return the checksum of `data`."""
        first, second = self.start, 0
        for byte in data:
            first = (first + byte) % self.modulus
            second = (second + first) % self.modulus
        return second << width // 2 | first

    def tells_apart(self, size: int) -> bool:
        """Tell whether data that differ in so many bytes on end never have the same checksum."""
        return size == 1 and self.modulus > 0xFF


@dataclass(frozen=True)
class Crc(Checksum):
    """The remainder of a division by a polynomial, whose highest power is left out.

    Where it is reflected, the lowest bit of each byte comes first, and that of the remainder last;
    where it is mixed as well, the remainder is as it would be otherwise.
    """

    poly: int
    init: int
    reflected: bool
    xor_out: int
    mixed: bool = False

    @property
    def width(self) -> int:
        """Its one width in bits."""
        return self.widths[0]

    def of(self, data: bytes, width: int) -> int:
        """Return the checksum of `data`."""
        register, remainders = self.init, _remainders(self.poly, width)
        for byte in data.translate(_TURNED) if self.reflected else data:
            highest = register >> width - 8 ^ byte
            register = (register << 8) % (1 << width) ^ remainders[highest]
        if self.reflected and not self.mixed:
            register = int(f"{register:0{width}b}"[::-1], 2)
        return register ^ self.xor_out

    def tells_apart(self, size: int) -> bool:
        """Tell whether data that differ in so many bytes on end never have the same checksum."""
        return 8 * size <= self.width and bool(self.poly & 1)


# Every byte with its lowest bit first.
_TURNED = bytes(int(f"{byte:08b}"[::-1], 2) for byte in range(0x100))


@cache
def _remainders(poly: int, width: int) -> list[int]:
    """Return what each byte leaves, divided as the highest one of a register, bit by bit."""
    found = []
    for byte in range(0x100):
        register = byte << width - 8
        for _ in range(8):
            carry = register >> width - 1
            register = (register << 1) % (1 << width) ^ (poly if carry else 0)
        found.append(register)
    return found


def _words(data: bytes, size: int) -> Iterator[int]:
    """Yield the numbers of so many bytes that data consists of; missing last bytes are zeros."""
    return (int.from_bytes(data[at : at + size], "little") for at in range(0, len(data), size))


_SUMS: tuple[Checksum, ...] = (
    Sum(
        "sum",
        "all bytes added up",
        {8: 0xDD, 16: 0x01DD, 24: 0x00_01DD, 32: 0x0000_01DD},
        factor=1,
        offset=0,
    ),
    Sum(
        "inverted sum",
        "all bytes added up, with every bit inverted",
        {8: 0x22, 16: 0xFE22, 24: 0xFF_FE22, 32: 0xFFFF_FE22},
        factor=-1,
        offset=-1,
    ),
    Sum(
        "negated sum",
        "what makes zero of all bytes added up: the two's complement of their sum",
        {8: 0x23, 16: 0xFE23, 24: 0xFF_FE23, 32: 0xFFFF_FE23},
        factor=-1,
        offset=0,
    ),
    Xor("xor", "the exclusive or of all bytes", {8: 0x31}, xor_out=0),
    Xor("inverted xor", "the exclusive or of all bytes, with every bit inverted", {8: 0xCE}, 0xFF),
    Fletcher(
        "fletcher-8",
        "two running sums modulo 256, the first in the low byte (the 8-bit one of RFC 1145)",
        {16: 0x15DD},
        modulus=256,
        start=0,
    ),
    Fletcher(
        "fletcher-16",
        "two running sums modulo 255, the first in the low byte",
        {16: 0x1EDE},
        modulus=255,
        start=0,
    ),
    Fletcher(
        "adler-32",
        "two running sums modulo 65521, the first beginning at 1, in the low half",
        {32: 0x091E_01DE},
        modulus=65521,
        start=1,
    ),
)

# What few protocols have.
_UNUSUAL_SUMS: tuple[Checksum, ...] = (
    Sum(
        "sum-7",
        "all bytes added up, 7 bits of it: the highest one is 0",
        {8: 0x5D},
        factor=1,
        offset=0,
        left_out=1,
    ),
    Sum(
        "negated sum-7",
        "what makes 7 zero bits of all bytes added up; the highest bit is 0",
        {8: 0x23},
        factor=-1,
        offset=0,
        left_out=1,
    ),
    Sum(
        "sum-15",
        "all bytes added up, 15 bits of it: the highest one is 0",
        {16: 0x01DD},
        factor=1,
        offset=0,
        left_out=1,
    ),
    Sum(
        "carried sum",
        "all bytes added up, what goes beyond 8 bits added to the lowest (end-around carry)",
        {8: 0xDE},
        factor=1,
        offset=0,
        carried=True,
    ),
    Sum(
        "inverted carried sum",
        "all bytes added up with end-around carry, then every bit inverted (enhanced LIN)",
        {8: 0x21},
        factor=-1,
        offset=-1,
        carried=True,
    ),
    Sum(
        "word sum",
        "all numbers of 16 bits added up, the low byte of each first",
        {16: 0xD509},
        factor=1,
        offset=0,
        word=2,
    ),
    Sum(
        "internet checksum",
        "all numbers of 16 bits added up with end-around carry, then every bit inverted (RFC 1071)",
        {16: 0x2AF6},
        factor=-1,
        offset=-1,
        word=2,
        carried=True,
    ),
    Xor(
        "even xor",
        "the exclusive or of all bytes, with the lowest bit 0",
        {8: 0x30},
        xor_out=0,
        mask=0xFE,
    ),
    Xor(
        "inverted even xor",
        "the exclusive or of all bytes, with every bit inverted, then the lowest bit 0",
        {8: 0xCE},
        xor_out=0xFF,
        mask=0xFE,
    ),
    Xor(
        "word xor",
        "the exclusive or of all numbers of 16 bits, the low byte of each first",
        {16: 0x0839},
        xor_out=0,
        mask=0xFFFF,
        word=2,
    ),
)

# Name, polynomial, first register, what is reflected, what is added last, and the check value.
_PUBLISHED_CRCS = """
crc-8/autosar     2F  FF  none  FF  DF
crc-8/bluetooth   A7  00  both  00  26
crc-8/cdma2000    9B  FF  none  00  DA
crc-8/darc        39  00  both  00  15
crc-8/dvb-s2      D5  00  none  00  BC
crc-8/gsm-a       1D  00  none  00  37
crc-8/gsm-b       49  00  none  FF  94
crc-8/hitag       1D  FF  none  00  B4
crc-8/i-432-1     07  00  none  55  A1
crc-8/i-code      1D  FD  none  00  7E
crc-8/lte         9B  00  none  00  EA
crc-8/maxim-dow   31  00  both  00  A1
crc-8/mifare-mad  1D  C7  none  00  99
crc-8/nrsc-5      31  FF  none  00  F7
crc-8/opensafety  2F  00  none  00  3E
crc-8/rohc        07  FF  both  00  D0
crc-8/sae-j1850   1D  FF  none  FF  4B
crc-8/smbus       07  00  none  00  F4
crc-8/tech-3250   1D  FF  both  00  97
crc-8/wcdma       9B  00  both  00  25

crc-16/arc                8005  0000  both  0000  BB3D
crc-16/cdma2000           C867  FFFF  none  0000  4C06
crc-16/cms                8005  FFFF  none  0000  AEE7
crc-16/dds-110            8005  800D  none  0000  9ECF
crc-16/dect-r             0589  0000  none  0001  007E
crc-16/dect-x             0589  0000  none  0000  007F
crc-16/dnp                3D65  0000  both  FFFF  EA82
crc-16/en-13757           3D65  0000  none  FFFF  C2B7
crc-16/genibus            1021  FFFF  none  FFFF  D64E
crc-16/gsm                1021  0000  none  FFFF  CE3C
crc-16/ibm-3740           1021  FFFF  none  0000  29B1
crc-16/ibm-sdlc           1021  FFFF  both  FFFF  906E
crc-16/iso-iec-14443-3-a  1021  C6C6  both  0000  BF05
crc-16/kermit             1021  0000  both  0000  2189
crc-16/lj1200             6F63  0000  none  0000  BDF4
crc-16/m17                5935  FFFF  none  0000  772B
crc-16/maxim-dow          8005  0000  both  FFFF  44C2
crc-16/mcrf4xx            1021  FFFF  both  0000  6F91
crc-16/modbus             8005  FFFF  both  0000  4B37
crc-16/nrsc-5             080B  FFFF  both  0000  A066
crc-16/opensafety-a       5935  0000  none  0000  5D38
crc-16/opensafety-b       755B  0000  none  0000  20FE
crc-16/profibus           1DCF  FFFF  none  FFFF  A819
crc-16/riello             1021  B2AA  both  0000  63D0
crc-16/spi-fujitsu        1021  1D0F  none  0000  E5CC
crc-16/t10-dif            8BB7  0000  none  0000  D0DB
crc-16/teledisk           A097  0000  none  0000  0FB3
crc-16/tms37157           1021  89EC  both  0000  26B1
crc-16/umts               8005  0000  none  0000  FEE8
crc-16/usb                8005  FFFF  both  FFFF  B4C8
crc-16/xmodem             1021  0000  none  0000  31C3

crc-24/ble         00065B  555555  both  000000  C25A56
crc-24/flexray-a   5D6DCB  FEDCBA  none  000000  7979BD
crc-24/flexray-b   5D6DCB  ABCDEF  none  000000  1F23B8
crc-24/interlaken  328B63  FFFFFF  none  FFFFFF  B4F3E6
crc-24/lte-a       864CFB  000000  none  000000  CDE703
crc-24/lte-b       800063  000000  none  000000  23EF52
crc-24/openpgp     864CFB  B704CE  none  000000  21CF02
crc-24/os-9        800063  FFFFFF  none  FFFFFF  200FA5

crc-32/aixm        814141AB  00000000  none  00000000  3010BF7F
crc-32/autosar     F4ACFB13  FFFFFFFF  both  FFFFFFFF  1697D06A
crc-32/base91-d    A833982B  FFFFFFFF  both  FFFFFFFF  87315576
crc-32/bzip2       04C11DB7  FFFFFFFF  none  FFFFFFFF  FC891918
crc-32/cd-rom-edc  8001801B  00000000  both  00000000  6EC2EDC4
crc-32/cksum       04C11DB7  00000000  none  FFFFFFFF  765E7680
crc-32/iscsi       1EDC6F41  FFFFFFFF  both  FFFFFFFF  E3069283
crc-32/iso-hdlc    04C11DB7  FFFFFFFF  both  FFFFFFFF  CBF43926
crc-32/jamcrc      04C11DB7  FFFFFFFF  both  00000000  340BC6D9
crc-32/mef         741B8CD7  FFFFFFFF  both  00000000  D2C22F51
crc-32/mpeg-2      04C11DB7  FFFFFFFF  none  00000000  0376E6E7
crc-32/xfer        000000AF  00000000  none  00000000  BD0BE338

crc-64/ecma-182  42F0E1EBA9EA3693  0000000000000000  none  0000000000000000  6C40DF5F0B497347
crc-64/go-iso    000000000000001B  FFFFFFFFFFFFFFFF  both  FFFFFFFFFFFFFFFF  B90956C775A41001
crc-64/ms        259C84CBA6426349  FFFFFFFFFFFFFFFF  both  0000000000000000  75D4B74F024ECEEA
crc-64/nvme      AD93D23594C93659  FFFFFFFFFFFFFFFF  both  FFFFFFFFFFFFFFFF  AE8B14860A799888
crc-64/redis     AD93D23594C935A9  0000000000000000  both  0000000000000000  E9C6D914C4B8D9CA
crc-64/we        42F0E1EBA9EA3693  FFFFFFFFFFFFFFFF  none  FFFFFFFFFFFFFFFF  62EC59E3F1A4F00A
crc-64/xz        42F0E1EBA9EA3693  FFFFFFFFFFFFFFFF  both  FFFFFFFFFFFFFFFF  995DC9BBDF1939FA
"""

# Not published there, but seen on serial lines: what vendors' documents give as tables or code.
# Of the CRC of 7 bits, the polynomial is shifted up, and so is the remainder before it is turned.
_OTHER_CRCS = """
crc-7/pololu       12        00        both   00        25
crc-8/ldrobot      4D        00        none   00        C3
crc-8/odrive       37        42        none   00        8C
crc-8/robomaster   31        FF        both   00        0B
crc-8/duml         31        EE        both   00        FB
crc-8/trinamic     07        00        mixed  00        04
crc-16/odrive      3D65      1337      none   0000      AA01
crc-16/duml        1021      496C      both   0000      7109
crc-16/simplebgc   8005      0000      mixed  0000      BCDD
crc-32/novatel     04C11DB7  00000000  both   00000000  2DFD2D88
"""


_BIT_ORDERS = {
    "none": "highest bit first",
    "both": "lowest bit first",
    "mixed": "lowest bit of bytes first, highest of the CRC",
}


def _crc(row: str) -> Crc:
    name, poly, init, reflected, xor_out, check = row.split()
    width = 4 * len(poly)
    order = _BIT_ORDERS[reflected]
    about = f"CRC of {width} bits: polynomial {poly}, begun with {init}, {order}, xor {xor_out}"
    checks = {width: int(check, 16)}
    numbers = int(poly, 16), int(init, 16), reflected != "none", int(xor_out, 16)
    return Crc(name, about, checks, *numbers, mixed=reflected == "mixed")


CHECKSUMS: Mapping[str, Checksum] = {
    method.name: method
    for method in (
        *_SUMS,
        *_UNUSUAL_SUMS,
        *(_crc(row) for row in (_PUBLISHED_CRCS + _OTHER_CRCS).splitlines() if row),
    )
}
"""Every method, by the name that a spec gives it."""

UNUSUAL = frozenset(method.name for method in _UNUSUAL_SUMS)
"""Those that agree with a more usual one as long as the bytes are few and small."""

# What others call them; a spec uses one name for one method.
_OTHER_NAMES = {
    "sum": "sum-8, sum-16, sum-32, checksum, checksum-8, checksum-16, additive",
    "inverted sum": "ones' complement, one's complement, complement sum, not sum, sum complement",
    "negated sum": "two's complement, twos complement, intel hex, sum to zero",
    "xor": "bcc, xor-8, longitudinal parity, exclusive or",
    "inverted xor": "not xor, xor complement",
    "sum-7": "7-bit sum, sabertooth, syren",
    "negated sum-7": "roland, midi, system exclusive, sysex",
    "sum-15": "15-bit sum, sirf",
    "carried sum": "end-around carry, sum with carry, modulo 255",
    "inverted carried sum": "lin, enhanced checksum, f.port, s.port, smart port",
    "word sum": "sum of words, 16-bit word sum",
    "internet checksum": "rfc 1071, ip checksum",
    "even xor": "herkulex",
    "inverted even xor": "herkulex checksum 2",
    "word xor": "xor-16, xor of words, hoverboard",
    "fletcher-8": "fletcher, 8-bit fletcher, rfc 1145",
    "adler-32": "adler",
    "crc-7/pololu": "crc-7, crc7, maestro",
    "crc-8/i-432-1": "crc-8/itu",
    "crc-8/trinamic": "tmc2208, tmc2209, tmc2225, tmc2226, tmc2300",
    "crc-8/duml": "dji, robomaster s1",
    "crc-8/robomaster": "robomaster referee",
    "crc-16/simplebgc": "basecam, sbgc",
    "crc-8/maxim-dow": "crc-8/maxim, dow-crc, crc-8/dallas, 1-wire",
    "crc-8/tech-3250": "crc-8/aes, crc-8/ebu",
    "crc-16/arc": "crc-16/lha, crc-ibm",
    "crc-16/dect-r": "r-crc-16",
    "crc-16/dect-x": "x-crc-16",
    "crc-16/genibus": "crc-16/epc, crc-16/epc-c1g2, crc-16/i-code",
    "crc-16/ibm-3740": "crc-16/autosar, crc-16/ccitt-false, crc-ccitt-ffff",
    "crc-16/ibm-sdlc": "crc-16/iso-hdlc, crc-16/iso-iec-14443-3-b, crc-16/x-25, crc-b, x-25",
    "crc-16/iso-iec-14443-3-a": "crc-a",
    "crc-16/kermit": "crc-16/ccitt-true, crc-16/v-41-lsb",
    "crc-16/maxim-dow": "crc-16/maxim",
    "crc-16/profibus": "crc-16/iec-61158-2",
    "crc-16/spi-fujitsu": "crc-16/aug-ccitt",
    "crc-16/umts": "crc-16/buypass, crc-16/verifone",
    "crc-16/xmodem": "crc-16/acorn, crc-16/lte, crc-16/v-41-msb, zmodem",
    "crc-32/aixm": "crc-32q",
    "crc-32/base91-d": "crc-32d",
    "crc-32/bzip2": "crc-32/aal5, crc-32/dect-b, b-crc-32",
    "crc-32/cksum": "crc-32/posix",
    "crc-32/iscsi": "crc-32/base91-c, crc-32/castagnoli, crc-32/interlaken, crc-32c",
    "crc-32/iso-hdlc": "crc-32/adccp, crc-32/v-42, crc-32/xz, pkzip",
    "crc-64/xz": "crc-64/go-ecma",
    "crc-24/lte-a": "crc-24q",
}

# Names that stand for several methods: what the document says of them decides.
_LOOSE_NAMES = {
    "lrc": ("negated sum", "xor"),
    "crc-8/atm, crc-8-atm": ("crc-8/trinamic", "crc-8/smbus", "crc-8/i-432-1"),
    "odrive": ("crc-8/odrive", "crc-16/odrive"),
    "crc, crc-8": ("crc-8/smbus", "crc-8/maxim-dow", "crc-8/dvb-s2"),
    "crc-16, crc-16-ibm, crc-16-ansi": ("crc-16/modbus", "crc-16/arc", "crc-16/umts"),
    "crc-16/ccitt, crc-ccitt, ccitt": ("crc-16/ibm-3740", "crc-16/xmodem", "crc-16/kermit"),
    "crc-24": ("crc-24/lte-a", "crc-24/openpgp"),
    "crc-32, ethernet": ("crc-32/iso-hdlc", "crc-32/mpeg-2", "crc-32/bzip2"),
    "crc-64": ("crc-64/xz", "crc-64/ecma-182"),
}

# What most protocols use, for whoever is asked to choose.
_COMMON_CRCS = (
    *("crc-8/smbus", "crc-8/maxim-dow", "crc-8/dvb-s2", "crc-16/modbus", "crc-16/ibm-3740"),
    *("crc-16/xmodem", "crc-16/kermit", "crc-16/mcrf4xx", "crc-24/lte-a", "crc-32/iso-hdlc"),
)


def suggest(method: str) -> str:
    """Return the hint for a method that is not in the catalogue: what it is called there."""
    plain = _plain(method)
    known = _meant()
    meant = known.get(plain, ())
    if not meant and len(plain) > 3:
        # Such as `ccitt-false`, of `crc-16/ccitt-false`.
        meant = next((names for key, names in known.items() if key.endswith(plain)), ())
    if len(meant) == 1:
        return f"write `{meant[0]}`, which is the same method"
    if meant:
        choices = "; or ".join(f"`{name}`, {CHECKSUMS[name].about}" for name in meant)
        return f"that name stands for several methods: write {choices}"
    near = _near(plain, known)
    if near:
        return f"did you mean `{near}`?"
    crc = _CRC.match(plain)
    alike = [name for name in CHECKSUMS if crc and name.startswith(f"crc-{crc[1]}/")]
    if alike:
        alike.sort(key=lambda name: name not in _COMMON_CRCS)
        return f"{_listed(alike, alike)}; {_TRY}"
    common = [*(row.name for row in _SUMS), *_COMMON_CRCS]
    return _listed(common, CHECKSUMS)


# A name of other letters than these is no slip, but another method.
_ALMOST_EQUAL = 0.8
_MOST_NAMED = 12
_CRC = re.compile(r"crc([0-9]+)(.*)")
_TRY = (
    "the guide `Write a spec` has the parameters of each; if none are known, write any, and "
    "examples show which one is right"
)


def _near(plain: str, known: Mapping[str, Sequence[str]]) -> str:
    """Return the method whose name is almost the same; of CRCs, their width does not count."""
    given = _CRC.match(plain)
    names = {
        (found[2] if found else key): meant[0]
        for key, meant in known.items()
        for found in [_CRC.match(key)]
        if (found and found[1]) == (given and given[1])
    }
    near = get_close_matches(given[2] if given else plain, names, 1, _ALMOST_EQUAL)
    return names[near[0]] if near else ""


def _listed(names: Sequence[str], known: Collection[str]) -> str:
    """Offer a choice of some names of those that are known."""
    shown = ", ".join(f"`{name}`" for name in names[:_MOST_NAMED])
    others = len(known) - len(names[:_MOST_NAMED])
    return f"choose one of {shown}" + (f" or {pluralize(others, 'other')}" if others else "")


@cache
def _meant() -> dict[str, tuple[str, ...]]:
    """Return which methods each other name may mean, by its letters and digits alone."""
    tables = (
        {name: (name,) for name in CHECKSUMS},
        {names: (name,) for name, names in _OTHER_NAMES.items()},
        _LOOSE_NAMES,
    )
    return {
        _plain(name): meant
        for table in tables
        for names, meant in table.items()
        for name in names.split(", ")
    }


def _plain(name: str) -> str:
    return re.sub("[^a-z0-9]", "", name.lower())
