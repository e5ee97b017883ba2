"""The checksums of the libraries agree with the catalogue, also along a stream, in linear time."""

from importlib import import_module
from typing import Any, TypeAlias
from unittest.mock import patch

from framegen.model.checksums import CHECK_DATA, CHECKSUMS
from framegen.targets.python.checksum_view import ChecksumView
from hypothesis import given
from hypothesis import strategies as st

from tests.in_turn import in_turn

METHODS = [(name, width) for name, row in CHECKSUMS.items() for width in row.widths]
# One of each class, and of each way through it.
KINDS = [
    *((name, 8) for name in ("sum", "inverted sum", "xor", "inverted xor", "negated sum-7")),
    *((name, 8) for name in ("inverted carried sum", "inverted even xor", "crc-8/dvb-s2")),
    *((name, 8) for name in ("crc-8/maxim-dow", "crc-8/trinamic")),
    *((name, 16) for name in ("negated sum", "sum-15", "word sum", "internet checksum")),
    *((name, 16) for name in ("word xor", "fletcher-8", "crc-16/modbus", "crc-16/umts")),
    *((f"crc-16/{name}", 16) for name in ("ibm-3740", "mcrf4xx", "simplebgc")),
    *(("crc-24/lte-a", 24), ("adler-32", 32), ("crc-32/iso-hdlc", 32), ("crc-32/mpeg-2", 32)),
    ("crc-64/xz", 64),
]


def make(method: str, width: int) -> Any:
    """Make a checksum as a library does."""
    view = ChecksumView(method, width)
    module = import_module(f"framewire.frame.{view.module}")
    return eval(view.made, vars(module))  # noqa: S307 - it is our own


@in_turn(
    "method, width, made",
    lambda: [
        ("sum", 8, "Sum(8)"),
        ("inverted sum", 16, "Sum(16, inverted=True)"),
        ("negated sum", 8, "Sum(8, negated=True)"),
        ("xor", 8, "Xor()"),
        ("inverted xor", 8, "Xor(0xFF)"),
        ("negated sum-7", 8, "WordSum(1, 7, negated=True)"),
        ("sum-15", 16, "WordSum(1, 15)"),
        ("internet checksum", 16, "WordSum(2, 16, inverted=True, carried=True)"),
        ("inverted even xor", 8, "WordXor(1, 0xFE, xor_out=0xFF)"),
        ("word xor", 16, "WordXor(2, 0xFFFF)"),
        ("fletcher-8", 16, "Fletcher(16, 256)"),
        ("adler-32", 32, "Fletcher(32, 65521, start=1)"),
        ("crc-8/dvb-s2", 8, "Crc(8, 0xD5)"),
        ("crc-16/modbus", 16, "Crc(16, 0x8005, init=0xFFFF, reflected=True)"),
        ("crc-8/trinamic", 8, "Crc(8, 0x07, reflected=True, mixed=True)"),
        ("crc-16/genibus", 16, "Crc(16, 0x1021, init=0xFFFF, xor_out=0xFFFF)"),
    ],
)
def test_a_method_is_made_of_what_sets_it_apart(method: str, width: int, made: str) -> None:
    assert ChecksumView(method, width).made == made


@given(data=st.binary(max_size=300))
def test_a_checksum_is_the_one_of_the_catalogue(data: bytes) -> None:
    for method, width in METHODS:
        checksum, row = make(method, width), CHECKSUMS[method]
        assert checksum.of(CHECK_DATA) == row.checks[width], method
        assert checksum.of(data) == row.of(data, width), method


Piece: TypeAlias = tuple[int, int] | bytes


@st.composite
def inquiries(draw: st.DrawFn) -> tuple[bytes, list[tuple[int, list[Piece]]]]:
    """Draw a stream, and what a decoder asks of it: pieces, and how much it has dropped by then.

    A decoder goes forwards only: by a byte behind each header that is refused, by a frame behind
    each that is not, or it asks again of the same place.
    """
    data = draw(st.binary(min_size=1, max_size=200))
    at, dropped, asked = 0, 0, []
    while at < len(data):
        end = draw(st.integers(at, len(data)))
        middle, resumed = sorted(draw(st.tuples(st.integers(at, end), st.integers(at, end))))
        choices: list[list[Piece]] = [
            [(at, end)],
            [(at, end), draw(st.binary(max_size=3))],
            [(at, middle), draw(st.binary(max_size=3)), (resumed, end)],
        ]
        dropped = draw(st.integers(dropped, at))
        asked.append((dropped, draw(st.sampled_from(choices))))
        at += draw(st.sampled_from([0, 1, 1, 1, 2, max(1, end - at)]))
        if len(asked) > 30:
            break
    return data, asked


@given(inquiry=inquiries(), copied=st.integers(0, 30))
def test_any_stretch_of_a_stream_has_the_checksum_of_the_catalogue(
    inquiry: tuple[bytes, list[tuple[int, list[Piece]]]], copied: int
) -> None:
    data, asked = inquiry
    for method, width in KINDS:
        running = make(method, width).running()
        for number, (dropped, pieces) in enumerate(asked):
            covered = b"".join(
                each if isinstance(each, bytes) else data[slice(*each)] for each in pieces
            )
            moved = [
                each if isinstance(each, bytes) else (each[0] - dropped, each[1] - dropped)
                for each in pieces
            ]
            if number == copied:
                original, running = running, running.copy()
                original.of(b"another" * 20, 0, (0, 70))
                original.of(b"another" * 20, 0, (1, 70))
            expected = CHECKSUMS[method].of(covered, width)
            assert running.of(data[dropped:], dropped, *moved) == expected, method


@in_turn("method, width", lambda: KINDS)
@in_turn("frames_between", lambda: [False, True])
def test_long_claims_at_every_byte_cost_each_byte_twice_at_most(
    method: str, width: int, frames_between: bool
) -> None:
    checksum = make(method, width)
    kind = type(checksum.running())
    summed = 0

    def counting(function: Any) -> Any:
        def counted(*arguments: Any) -> Any:
            nonlocal summed
            summed += len(arguments[-1])
            return function(*arguments)

        return counted

    data, claim, at = bytes(range(256)) * 4, 250, 0
    with patch.object(kind, "_go_on", counting(kind._go_on)):
        checksum.of = counting(checksum.of)
        running = checksum.running()
        while at + claim <= len(data):
            # What a decoder has read by then is no longer there.
            running.of(data[at:], at, (0, claim))
            at += 1
            if frames_between and at % 7 == 0:
                running.of(data[at:], at, (1, 9))
                at += 10
    assert summed <= 2 * len(data)


@in_turn("method, width", lambda: KINDS)
def test_no_more_registers_are_kept_than_two_of_the_longest_claims(method: str, width: int) -> None:
    running = make(method, width).running()
    data, claim = bytes(range(256)) * 4, 50
    for at in range(len(data) - claim):
        running.of(data[at : at + claim], at, (0, claim))
        assert len(running._registers) <= 2 * claim + 2
