"""Hex is one language, for the library, its command and framegen: as a table, and cut anywhere."""

from itertools import pairwise

import pytest
from busservo.__main__ import main
from framegen.cli import main as framegen_main
from framewire.codec.hextext import HexError, HexReader, is_hex, read_hex
from hypothesis import given
from hypothesis import strategies as st

from tests.factories import BUSSERVO
from tests.hex_cases import HEX, NO_HEX, random_texts
from tests.in_turn import in_turn

# What has no place among the words of a command line.
WORDS = [text for text in NO_HEX if "\0" not in text]


@in_turn("text, data", lambda: HEX)
def test_hex_of_any_usual_shape_is_read(text: str, data: str) -> None:
    assert read_hex(text) == bytes.fromhex(data)
    assert is_hex(text) == bool(data)


@in_turn("text", lambda: NO_HEX)
def test_what_is_no_hex_is_refused(text: str) -> None:
    with pytest.raises(HexError) as caught:
        read_hex(text)
    assert text[caught.value.at :].startswith(caught.value.wrong)
    assert not is_hex(text)


@in_turn("text", lambda: WORDS)
def test_the_commands_refuse_it_as_well(text: str, capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["decode", text]) == 2
    assert capsys.readouterr().err.startswith("busservo: error: no hex: ")
    assert framegen_main(["explain", str(BUSSERVO), text]) == 2
    assert "Traceback" not in capsys.readouterr().err


@pytest.mark.parametrize(
    ("text", "problem"),
    [
        ("5", "no hex: '5' is half a byte; did you mean 05?"),
        ("55 5G", "no hex: 'G' in '5G' is no hex digit; write two digits a byte, like 0A 1B FF"),
        ("0x", "no hex: '0x' has no digits after it; write the byte whole, like 0x1B"),
        (
            "0x555",
            "no hex: '555' in '0x555' is 3 digits, which is no whole number of bytes; look for a d",
        ),
        ("z" * 99, f"no hex: 'z' in '{37 * 'z'}...' is no hex digit; write two digits a byte, "),
    ],
)
def test_malformed_hex_is_reported(text: str, problem: str) -> None:
    with pytest.raises(HexError) as caught:
        read_hex(text)
    assert str(caught.value).startswith(problem)


texts = st.sampled_from([text for text, _ in HEX] + NO_HEX + random_texts(100)) | st.text(
    st.sampled_from("0x\\51abF ,-#\ng")
)


@given(texts, st.data())
def test_hex_that_is_cut_anywhere_is_the_same_hex(text: str, data: st.DataObject) -> None:
    cuts = sorted(data.draw(st.lists(st.integers(0, len(text)), max_size=len(text) + 1)))
    reader, read = HexReader(), b""
    try:
        whole = read_hex(text)
    except HexError:
        whole = None
    try:
        for start, end in pairwise([0, *cuts, len(text)]):
            read += reader.feed(text[start:end])
        read += reader.end()
    except HexError:
        assert whole is None
    else:
        assert read == whole


@given(texts)
def test_one_more_comment_or_blank_changes_nothing(text: str) -> None:
    assert is_hex(text) == is_hex(f"# 5\n {text}\n#")
    if is_hex(text):
        assert read_hex(f"{text}\n{text}") == 2 * read_hex(text)
        assert read_hex(read_hex(text).hex(" ")) == read_hex(text)
