"""The small notations of a spec: their meaning, their errors, and that all of them read back."""

from collections.abc import Callable
from decimal import Decimal
from typing import Any

import pytest
from framegen.language.values import (
    Citation,
    Direction,
    Failure,
    Method,
    Range,
    Scale,
    parse_hex,
    to_hex,
)
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import in_larger_unit
from tests.in_turn import in_turn

NOTATIONS: list[Any] = [Direction, Range, Scale, Citation, Method]
WORDS = st.text("az09_", max_size=8).map(lambda rest: f"a{rest}")


@in_turn(
    "parse, text, value",
    lambda: [
        (Direction.parse, "host -> controller", Direction("host", "controller")),
        *((Direction.parse, "a->b", Direction("a", "b")), (Range.parse, "0..1000", Range(0, 1000))),
        *((Range.parse, "1..", Range(1, None)), (Range.parse, "-900..900", Range(-900, 900))),
        *((Range.parse, "-9..-3", Range(-9, -3)), (Range.parse, "0 .. 7", Range(0, 7))),
        *((Range.parse, "0x20..0x7E", Range(0x20, 0x7E)), (Range.parse, "0x1..", Range(1, None))),
        (Range.parse, "007..010", Range(7, 10)),
        (Range.parse, "0..18446744073709551615", Range(0, 2**64 - 1)),
        (Scale.parse, "0.001 V", Scale(Decimal("0.001"), "V")),
        (Scale.parse, "5 mm", Scale(Decimal(5), "mm")),
        (Scale.parse, "0.01", Scale(Decimal("0.01"), "")),
        (Scale.parse, "0.5 - 40", Scale(Decimal("0.5"), "", Decimal(-40))),
        (Scale.parse, "0.24 °", Scale(Decimal("0.24"), "°")),
        (Citation.parse, "vendor, section 1.1", Citation("vendor", "section 1.1")),
        (Citation.parse, "vendor", Citation("vendor", "")),
        (Citation.parse, " vendor ,  a, b ", Citation("vendor", "a, b")),
        (Failure.parse, "error", Failure("error")),
        (Failure.parse, " status  unless 1 ", Failure("status", 1)),
        (Failure.parse, "status unless 0xFF", Failure("status", 255)),
        (Failure.parse, "status unless -1", Failure("status", -1)),
        (Method.parse, "stop()", Method("stop", (), "")),
        (Method.parse, "run(group, times)", Method("run", ("group", "times"), "")),
        (Method.parse, "read() -> voltage", Method("read", (), "voltage")),
        (Method.parse, " read ( a ,\n b )->c ", Method("read", ("a", "b"), "c")),
        *((parse_hex, "55 55 02 07", b"\x55\x55\x02\x07"), (parse_hex, "fF", b"\xff")),
        (parse_hex, "  01\n  02\t03 ", b"\x01\x02\x03"),
    ],
)
def test_a_notation_is_read(parse: Callable[[str], Any], text: str, value: object) -> None:
    assert parse(text) == value


NO_DIRECTIONS = ("", "host", "host -> ", "host to controller", "a b -> c", "a -> b\n")
NO_RANGES = (
    *("", "..5", "0-5", "0...5", "-0x1..5", "0x..5", "+1..5", "\u0663..\u0665", f"0..{10**20}"),
    "1..5\n",
)
NO_SCALES = ("", "0.001V", "1e3 V", "nan V", "1 V s")
NO_METHODS = (
    *("stop", "run(group,)", "run(,)", "run(,group)", "run(group times)", "run(group\ttimes)"),
    *("run(group) ->", "run(group) -> a, b", "r\u00fcn()"),
)


@in_turn(
    "parse, text, hint",
    lambda: [
        *((Direction.parse, text, "write it like `host -> controller`") for text in NO_DIRECTIONS),
        *((Range.parse, text, "write it like `0..1000`") for text in NO_RANGES),
        *((Scale.parse, text, "like `0.001 V`") for text in NO_SCALES),
        *((Scale.parse, text, "a step above zero") for text in ("0 V", "0.000 V", "-1 V")),
        (Scale.parse, f"0.{'1' * 25} V", "of 24 decimals at most"),
        (Citation.parse, "", "like `vendor, section 1.1`"),
        (Citation.parse, " , section 1.1", "like `vendor, section 1.1`"),
        (Failure.parse, "", "like `error`, or the value that it has then, like `status unless 1`"),
        (Failure.parse, "status unless", "`status unless` says no failure"),
        (Failure.parse, "status unless ok", "write a field that is 0 where nothing has failed"),
        (Failure.parse, "status is 1", "`status is 1` says no failure"),
        (Method.parse, "", "like `read_positions(servo_ids) -> positions`"),
        *((Method.parse, text, "write name, arguments and what it returns") for text in NO_METHODS),
        *((parse_hex, text, "two digits a byte") for text in ("", "5", "\uff15\uff15")),
        (parse_hex, "55 5", "`5` is no hex: write two digits a byte"),
        (parse_hex, "55 G3 G4", "`G3` is no hex: write two digits a byte"),
        (parse_hex, "5555", "`5555` is no hex: write `55 55`"),
        (parse_hex, "aa 0x55", "`0x55` is no hex: write `AA 55`"),
        (parse_hex, "55, 55", "`55,` is no hex: write `55 55`"),
    ],
)
def test_a_malformed_notation_is_reported_with_what_to_write(
    parse: Callable[[str], Any], text: str, hint: str
) -> None:
    with pytest.raises(ValueError, match=r"^`|depends") as refused:
        parse(text)
    assert str(refused.value).startswith("`")
    assert hint in str(refused.value)


def test_a_long_text_that_is_no_hex_is_cut_short() -> None:
    with pytest.raises(ValueError, match=f"^`{'z' * 40}` is no hex"):
        parse_hex("z" * 500)


@given(WORDS, WORDS)
def test_a_direction_reads_back_and_turns_round(sender: str, receiver: str) -> None:
    direction = Direction(sender, receiver)
    assert Direction.parse(str(direction)) == direction
    assert direction.reversed == Direction(receiver, sender)
    assert direction.reversed.reversed == direction
    assert direction.key == f"{sender}_to_{receiver}"


@given(st.integers(-(10**20) + 1, 10**20 - 1), st.none() | st.integers(0, 10**20 - 1))
def test_a_range_reads_back(low: int, high: int | None) -> None:
    range_ = Range(low, high)
    assert Range.parse(str(range_)) == range_


@given(st.binary(min_size=1))
def test_hex_reads_back(data: bytes) -> None:
    assert parse_hex(to_hex(data)) == data
    assert to_hex(data) == " ".join(f"{byte:02X}" for byte in data)


@given(WORDS, st.text(alphabet="abc 1.,-", max_size=12).map(lambda place: place.strip()))
def test_a_citation_reads_back(source: str, place: str) -> None:
    citation = Citation(source, place)
    assert Citation.parse(str(citation)) == citation


@in_turn(
    "scale, value, said",
    lambda: [
        *(("0.001 V", 7500, "7.500 V"), ("0.001 V", 7881, "7.881 V"), ("0.001 V", 0, "0.000 V")),
        *(("0.01 K", -150, "-1.50 K"), ("0.24 °", 1000, "240.00 °"), ("5 mm", 3, "15 mm")),
        *(("0.1 V", 3, "0.3 V"), ("0.01", 250, "2.50"), ("0.125 °C - 256", 2208, "20.000 °C")),
        *(("0.5 - 40", 1, "-39.5"), ("0.0054931640625 °", 7, "0.0384521484375 °")),
        ("0.0000000001 s", 7, "0.0000000007 s"),
        ("0.000000000000000000000001 V", 2**64 - 1, "0.000018446744073709551615 V"),
    ],
)
def test_a_scaled_value_is_exact(scale: str, value: int, said: str) -> None:
    assert in_larger_unit(scale, value) == said
    assert str(Scale.parse(scale)) == scale


@given(st.text())
def test_any_text_is_read_or_refused_in_words(text: str) -> None:
    for parse in (*(kind.parse for kind in NOTATIONS), parse_hex):
        said = "`"
        try:
            parse(text)
        except ValueError as error:
            said = str(error)
        assert said.startswith("`")
