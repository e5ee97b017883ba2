"""Edges that mutation of the code has shown to be unguarded; docs/testing.md tells how."""

import pytest
from busservo import DecodeError, EncodeError, Reason, ServoMove
from framegen.codec import describe_range
from framegen.values import Citation


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        (range(4), "0, 1, 2, 3"),
        (range(5), "0..4"),
        (range(0, 10, 2), "0, 2, 4 .. 8"),
    ],
)
def test_five_numbers_are_too_many_to_be_listed(numbers: range, words: str) -> None:
    assert describe_range(numbers) == words


def test_a_citation_without_a_place_is_its_source() -> None:
    assert str(Citation("vendor", "")) == "vendor"


def test_an_error_keeps_what_it_was_made_of() -> None:
    with pytest.raises(EncodeError) as refused:
        ServoMove(70000, [(1, 800)])
    assert refused.value.args == ("time_ms", 70000, "70000 is outside 0..65535")

    with pytest.raises(DecodeError) as unread:
        ServoMove.decode(b"\x55\x56")
    expected = "a frame begins 55 55"
    assert unread.value.args == (Reason.BAD_HEADER, 1, expected)
