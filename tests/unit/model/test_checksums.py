"""The catalogue of checksums agrees with what others have written and published."""

from zlib import adler32

from crccheck.checksum import Checksum8, Checksum16, Checksum32, ChecksumXor8, ChecksumXor16
from crccheck.crc import ALLCRCCLASSES
from crccheck.crc import Crc as Peer
from framegen.model.checksums import (
    _LOOSE_NAMES,
    _OTHER_NAMES,
    CHECK_DATA,
    CHECKSUMS,
    Checksum,
    Crc,
    suggest,
)
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn

CRCS = [method for method in CHECKSUMS.values() if isinstance(method, Crc)]
PUBLISHED = {kind._names[0].lower(): kind for kind in ALLCRCCLASSES if kind._width % 8 == 0}
# Of vendors, whose documents give a table, or code.
UNPUBLISHED = {
    *("crc-7/pololu", "crc-8/duml", "crc-8/ldrobot", "crc-8/odrive", "crc-8/robomaster"),
    *("crc-8/trinamic", "crc-16/duml", "crc-16/odrive", "crc-16/simplebgc", "crc-32/novatel"),
}
# What the catalogue has of other widths goes over no line of bytes as a number.
WIDTHS = {8, 16, 24, 32, 64}

RUNS = st.binary(max_size=20)

# Bits that a method leaves out.
UNSEEN = {"sum-7": (7,), "negated sum-7": (7,), "even xor": (0,), "inverted even xor": (0,)}


def named(method: Checksum) -> str:
    return method.name


@in_turn("method", CHECKSUMS.values, ids=named)
def test_a_method_has_its_check_value_in_each_width(method: Checksum) -> None:
    assert {width: method.of(CHECK_DATA, width) for width in method.widths} == method.checks


def test_the_catalogue_has_every_published_crc_of_whole_numbers() -> None:
    published = {name for name, kind in PUBLISHED.items() if kind._width in WIDTHS}
    assert {method.name for method in CRCS} == published | UNPUBLISHED


@given(data=st.binary(max_size=40))
def test_a_crc_is_what_crccheck_makes_of_the_same_data(data: bytes) -> None:
    for method in CRCS:
        # By its published name where there is one: then the row's own numbers are in question, too.
        peer = PUBLISHED[method.name] if method.name in PUBLISHED else _peer(method)
        assert method.of(data, method.width) == peer.calc(data), method.name


def _peer(method: Crc) -> Peer:
    last = method.reflected and not method.mixed
    return Peer(method.width, method.poly, method.init, method.reflected, last, method.xor_out)


@given(data=st.binary(max_size=300))
def test_sums_are_what_crccheck_adds_up(data: bytes) -> None:
    # In its wider sums bytes are taken in groups, of which each has one of ours, and zeros.
    wide = (b"".join(bytes([*[0] * zeros, byte]) for byte in data) for zeros in (1, 3))
    totals = {8: Checksum8.calc(data), 16: Checksum16.calc(next(wide))}
    totals[32] = Checksum32.calc(next(wide))
    for width, total in totals.items():
        assert CHECKSUMS["sum"].of(data, width) == total
        assert CHECKSUMS["inverted sum"].of(data, width) == total ^ (1 << width) - 1
        assert (CHECKSUMS["negated sum"].of(data, width) + total) % (1 << width) == 0
    assert CHECKSUMS["sum"].of(data, 24) == totals[32] % (1 << 24)
    assert CHECKSUMS["sum-7"].of(data, 8) == totals[8] % 0x80
    assert (CHECKSUMS["negated sum-7"].of(data, 8) + totals[8]) % 0x80 == 0
    assert CHECKSUMS["negated sum-7"].of(data, 8) < 0x80
    assert CHECKSUMS["sum-15"].of(data, 16) == totals[16] % 0x8000


@given(data=st.binary(max_size=300))
def test_carries_are_added_byte_by_byte_as_vendors_do(data: bytes) -> None:
    total = 0
    for byte in data:
        total += byte
        total = (total & 0xFF) + (total >> 8)
    assert CHECKSUMS["carried sum"].of(data, 8) == total
    assert CHECKSUMS["inverted carried sum"].of(data, 8) == total ^ 0xFF


@given(data=st.binary(max_size=150).map(lambda data: data + data[::-1]))
def test_sums_of_words_are_what_crccheck_adds_up(data: bytes) -> None:
    # It takes the high byte first.
    swapped = bytes(byte for pair in zip(data[1::2], data[::2], strict=True) for byte in pair)
    assert CHECKSUMS["word sum"].of(data, 16) == Checksum16.calc(swapped)
    assert CHECKSUMS["word xor"].of(data, 16) == ChecksumXor16.calc(swapped)
    # As RFC 1071 says, it is the same in either order, with its own bytes in that order.
    carried = 0
    for high, low in zip(data[::2], data[1::2], strict=True):
        carried += high << 8 | low
        carried = (carried & 0xFFFF) + (carried >> 16)
    sent = CHECKSUMS["internet checksum"].of(data, 16).to_bytes(2, "little")
    assert sent == (carried ^ 0xFFFF).to_bytes(2, "big")


@given(data=st.binary(max_size=300))
def test_an_exclusive_or_is_what_crccheck_makes_of_the_same_data(data: bytes) -> None:
    assert CHECKSUMS["xor"].of(data, 8) == ChecksumXor8.calc(data)
    assert CHECKSUMS["inverted xor"].of(data, 8) == ChecksumXor8.calc(data) ^ 0xFF
    assert CHECKSUMS["even xor"].of(data, 8) == ChecksumXor8.calc(data) & 0xFE
    assert CHECKSUMS["inverted even xor"].of(data, 8) == ~ChecksumXor8.calc(data) & 0xFE


@given(data=st.binary(max_size=300))
def test_adler_32_is_what_zlib_makes_of_the_same_data(data: bytes) -> None:
    assert CHECKSUMS["adler-32"].of(data, 32) == adler32(data)


SCAN = (
    "54 2C 68 08 AB 7E E0 00 E4 DC 00 E2 D9 00 E5 D5 00 E3 D3 00 E4 D0 00 E9 CD 00 E4"
    "CA 00 E2 C7 00 E9 C5 00 E5 C2 00 E5 C0 00 E5 BE 82 3A 1A"
)


@in_turn(
    "method, data, value",
    lambda: [
        # The examples that Fletcher's checksum is explained with everywhere.
        ("fletcher-16", b"abcde", 0xC8F0),
        ("fletcher-16", b"abcdef", 0x2057),
        ("fletcher-16", b"abcdefgh", 0x0627),
        # Of a frame that turns a message of a receiver off: `… FF 19` on the wire, low byte first.
        ("fletcher-8", bytes.fromhex("06 01 03 00 F0 05 00"), 0x19FF),
        # Of the frame in the document of a laser scanner.
        ("crc-8/ldrobot", bytes.fromhex(SCAN), 0x50),
        # To read the register GCONF and the counter IFCNT of a motor driver.
        ("crc-8/trinamic", bytes.fromhex("05 00 00"), 0x48),
        ("crc-8/trinamic", bytes.fromhex("05 00 02"), 0x8F),
        # Of a motor controller's guide: leave safe start, with a CRC.
        ("crc-7/pololu", bytes.fromhex("83 01"), 0x17),
        # The two of one frame on the bus of a drone, in front of its payload and behind it.
        ("crc-8/duml", bytes.fromhex("55 0D 04"), 0x33),
        ("crc-16/duml", bytes.fromhex("55 0D 04 33 0A 0E 03 00 40 06 01"), 0x4AF4),
        # Forward at half speed, of the manual of a motor driver: 130, 0, 64, 66.
        ("sum-7", bytes([130, 0, 64]), 66),
        # The reset that every synthesizer of this kind knows.
        ("negated sum-7", bytes.fromhex("40 00 7F 00"), 0x41),
        # To ask a receiver for the version of its software.
        ("sum-15", bytes.fromhex("84 00"), 0x0084),
        # Of the specification of LIN, and of RFC 1071, whose number has the high byte first.
        ("inverted carried sum", bytes.fromhex("4A 55 93 E5"), 0xE6),
        ("internet checksum", bytes.fromhex("00 01 F2 03 F4 F5 F6 F7"), 0x0D22),
        # Steer 0 and speed 0, with the header ABCD.
        ("word xor", bytes.fromhex("CD AB 00 00 00 00"), 0xABCD),
    ],
)
def test_a_method_gives_a_published_checksum(method: str, data: bytes, value: int) -> None:
    [width] = CHECKSUMS[method].widths
    assert CHECKSUMS[method].of(data, width) == value


@given(data=st.binary(min_size=1, max_size=100), at=st.integers(0), bit=st.integers(0, 7))
def test_any_bit_that_changes_changes_any_checksum(data: bytes, at: int, bit: int) -> None:
    changed = bytearray(data)
    changed[at % len(data)] ^= 1 << bit
    for method in CHECKSUMS.values():
        if bit in UNSEEN.get(method.name, ()):
            continue
        for width in method.widths:
            assert method.of(bytes(changed), width) != method.of(data, width), method.name


SAME = [
    *(("crc-16/ccitt-false", "crc-16/ibm-3740"), ("CRC16_MODBUS", "crc-16/modbus")),
    *(("Sum", "sum"), ("x-25", "crc-16/ibm-sdlc"), ("dvb-s2", "crc-8/dvb-s2"), ("BCC", "xor")),
    *(("crc-24q", "crc-24/lte-a"), ("two's complement", "negated sum")),
    *(("TMC2209", "crc-8/trinamic"), ("end-around carry", "carried sum")),
]
LRC = (
    "write `negated sum`, what makes zero of all bytes added up: the two's complement of their sum;"
    " or `xor`, the exclusive or of all bytes"
)


@in_turn(
    "method, hint",
    lambda: [
        *((name, f"write `{same}`, which is the same method") for name, same in SAME),
        ("negatd sum", "did you mean `negated sum`?"),
        ("crc-16/modbud", "did you mean `crc-16/modbus`?"),
        ("LRC", f"that name stands for several methods: {LRC}"),
    ],
)
def test_a_method_by_another_name_is_known(method: str, hint: str) -> None:
    assert suggest(method) == hint


def test_a_method_that_is_none_is_answered_with_those_that_most_protocols_use() -> None:
    hint = suggest("magic")
    assert hint.startswith("choose one of `sum`, `inverted sum`, `negated sum`, `xor`")
    named = hint.count("`") // 2
    assert hint.endswith(f"or {len(CHECKSUMS) - named} others")


@in_turn(
    "method, width",
    lambda: [("crc-16/acme", 16), ("crc-8/zz", 8), ("CRC16-MY-OWN", 16), ("crc-32/ogg", 32)],
)
def test_another_crc_is_not_suggested_for_one_that_is_unknown(method: str, width: int) -> None:
    hint = suggest(method)
    assert "did you mean" not in hint
    named = [name for name in CHECKSUMS if f"`{name}`" in hint]
    assert len(named) == 12
    assert all(name.startswith(f"crc-{width}/") for name in named)
    assert "has the parameters of each" in hint


@in_turn("method", lambda: CHECKSUMS)
def test_a_slip_in_a_name_is_answered_with_that_name(method: str) -> None:
    near = {f"did you mean `{method}`?", f"write `{method}`, which is the same method"}
    slip = f"{method[:-1]}{method[-1] * 2}"
    assert suggest(slip) in near or len(method.partition("/")[2]) < 4


def test_every_other_name_leads_to_methods_and_is_none_itself() -> None:
    others = {**_LOOSE_NAMES, **{names: (name,) for name, names in _OTHER_NAMES.items()}}
    for names, meant in others.items():
        assert set(meant) <= CHECKSUMS.keys()
        for name in names.split(", "):
            assert name not in CHECKSUMS
            assert all(f"`{each}`" in suggest(name) for each in meant)


def some_of(size: int) -> st.SearchStrategy[list[bytes]]:
    each = st.binary(min_size=size, max_size=size)
    return st.lists(each, min_size=5, max_size=5, unique=True)


@given(drawn=st.tuples(*map(some_of, range(1, 5))), front=RUNS, behind=RUNS)
def test_bytes_that_a_checksum_tells_apart_never_have_the_same(
    drawn: tuple[list[bytes], ...], front: bytes, behind: bytes
) -> None:
    for size, different in enumerate(drawn, 1):
        lines = [front + each + behind for each in different]
        for method in CHECKSUMS.values():
            if method.tells_apart(size):
                for width in method.widths:
                    assert len({method.of(line, width) for line in lines}) == 5, method.name


def test_what_no_checksum_tells_apart_is_known() -> None:
    """Some have one value for 0 and for 255, some leave out bits, and sums know no order."""
    blind = {name for name, method in CHECKSUMS.items() if not method.tells_apart(1)}
    assert {"fletcher-16", "carried sum", "sum-7", "even xor", "crc-7/pololu"} <= blind
    assert not CHECKSUMS["sum"].tells_apart(2)
    assert CHECKSUMS["crc-16/modbus"].tells_apart(2)
    assert not CHECKSUMS["crc-16/modbus"].tells_apart(3)
