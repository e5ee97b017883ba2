"""Plain YAML scalars: a value only where every YAML reader has the same, and words for the rest."""

import re
from typing import Any

import pytest
import yaml
from framegen.reading.scalars import Ambiguous, resolve
from framegen.reading.text import first_invisible, is_invisible
from hypothesis import example, given
from hypothesis import strategies as st

from tests.in_turn import in_turn

# The core schema of YAML 1.2, section 10.3.2, as printed there.
CORE = {
    "null": re.compile(r"null|Null|NULL|~|"),
    "bool": re.compile(r"true|True|TRUE|false|False|FALSE"),
    "int": re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+"),
    "float": re.compile(
        r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
        r"|[-+]?(?:\.inf|\.Inf|\.INF)|\.nan|\.NaN|\.NAN"
    ),
}


def words(text: str) -> list[str]:
    return text.split(" ")


def kind_in_1_2(text: str) -> str:
    return next((kind for kind, pattern in CORE.items() if pattern.fullmatch(text)), "str")


def kind_in_1_1(text: str) -> str:
    resolver: Any = yaml.SafeLoader("")
    tag = resolver.resolve(yaml.ScalarNode, text, (True, False))
    kind = str(tag).rpartition(":")[2]
    # A rule of PyYAML for `!`, `&` and `*`, with which no plain scalar begins.
    return "str" if kind == "yaml" else kind


def agreed(text: str) -> None:
    """Check that a scalar's value is the same in both YAMLs; otherwise it must be refused."""
    try:
        value = resolve(text)
    except Ambiguous as error:
        said, hint = str(error), error.hint
    else:
        kind = "null" if value is None else type(value).__name__
        assert kind_in_1_1(text) == kind_in_1_2(text) == kind
        assert kind not in ("int", "float") or value == yaml.safe_load(text)
        return
    assert said.startswith(f"`{text}` without quotes is ")
    assert hint


@in_turn(
    "text, value",
    lambda: [
        *((text, None) for text in ("", "~", "null")),
        *(("true", True), ("false", False)),
        *(("0", 0), ("-0", 0), ("7", 7), ("+7", 7), ("-7", -7), ("65535", 65535)),
        *(("0xFF", 255), ("0x0f", 15)),
        *(("1.0", 1.0), ("-1.5", -1.5), ("0.0", 0.0), ("1.5e+3", 1500.0), ("1.5E-3", 0.0015)),
        *((text, text) for text in words("host u16 1.. 0..1000 -900..900 1.0.0 x1 none nothing")),
        *((text, text) for text in words("north - .. 0x 0b 12a")),
        *((text, text) for text in ("55 55 02 07", "3 * n + 5", "0.001 V", "host -> controller")),
    ],
)
def test_what_all_readers_agree_on_has_its_value(text: str, value: object) -> None:
    found = resolve(text)
    assert (found, type(found)) == (value, type(value))
    agreed(text)


AMBIGUOUS = {
    "a truth value": words("no No NO yes Yes on Off off y Y n N True TRUE False FALSE"),
    "nothing at all": words("Null NULL"),
    "octal": words("010 08 00 0777 -010 +07 0_7 00_ 01_0"),
    "base 60": words("1:30 12:30:45 -1:30 0:0 1:30.5 1:30.5_5 190:20:30.15 1_0:30"),
    "a number to one YAML": words("1_000 0b101 0b_1 0o17 0xF_F -0xFF +0x1 0x_ 1_ 0b1_1"),
    "a floating-point number": words(
        "1. .5 +.5 1.5e3 1e5 1E+5 1_0.5 .inf -.Inf .NaN .nan +.INF 01.5"
    ),
    "a date": ["2024-01-31", "2024-1-1", "2001-12-14t21:59:43.10-05:00", "2001-12-14 21:59:43"],
    "an instruction": ["=", "<<"],
}


@in_turn(
    "what, text", lambda: [(what, text) for what, texts in AMBIGUOUS.items() for text in texts]
)
def test_what_readers_disagree_on_is_refused_with_what_to_write(what: str, text: str) -> None:
    with pytest.raises(Ambiguous, match=f"^`{re.escape(text)}` without quotes is ") as refused:
        resolve(text)
    assert what in str(refused.value)
    assert f'"{text}"' in refused.value.hint or "write it in decimal" in refused.value.hint


@in_turn(
    "text, written",
    lambda: [
        *(("010", "10"), ("08", "8"), ("00", "0"), ("0_7", "7"), ("-010", "-10"), ("+07", "7")),
        *(("01_0", "10"), ("0_", "0")),
    ],
)
def test_an_octal_gets_its_decimal_proposed(text: str, written: str) -> None:
    with pytest.raises(Ambiguous) as refused:
        resolve(text)
    assert refused.value.hint == f'write "{text}" for text or bytes, and {written} for a number'
    assert resolve(written) == int(written)


def test_a_number_too_long_to_convert_is_refused() -> None:
    assert resolve("9" * 39) == int("9" * 39)
    for digits in (40, 5000):
        with pytest.raises(Ambiguous, match="a number to one YAML"):
            resolve("9" * digits)


@given(st.text(alphabet="0123456789+-_.:eExXbBoOaAfFnNyYtT~=< #", max_size=9))
def test_a_value_is_what_both_yamls_have(text: str) -> None:
    agreed(text)


@given(
    st.sampled_from(["yes", "no", "on", "off", "true", "false", "null", "y", "n", ".inf", ".nan"])
    .flatmap(lambda word: st.tuples(*(st.sampled_from([c.lower(), c.upper()]) for c in word)))
    .map("".join)
)
def test_no_spelling_of_a_word_means_two_things(text: str) -> None:
    agreed(text)


@given(
    st.from_regex(
        r"[-+]?[0-9_]{1,6}(:[0-9]{1,2}){0,2}(\.[0-9_]{0,3})?([eE][-+]?[0-9]{1,2})?", fullmatch=True
    )
)
def test_no_number_means_two_things(text: str) -> None:
    agreed(text)


@example("*")
@given(st.text(max_size=20))
def test_any_text_has_a_meaning_or_a_hint(text: str) -> None:
    agreed(text.strip())


UNSEEN = words(
    "\x00 \x07 \t \r \x0b \x1b \x1f \x7f \x80 \x85 \x9f \xad \u061c \u180e \u200b \u200d \u200e "
    "\u2028 \u202a \u202e \u2060 \u2066 \u2069 \ud800 \udfff \ufe00 \ufe0f \ufeff \ufff9 "
    "\U000e0001 \U000e0100"
)
SEEN = ["", *words("a \n ~ \xa0 é ß ° µ → 漢 \u0301 \u3000 \U0001f600 \ue000")]


@in_turn("character", lambda: UNSEEN, ids=ascii)
def test_a_character_that_nobody_sees_is_invisible(character: str) -> None:
    assert is_invisible(character)
    assert first_invisible(f"a{character}b\u200c") == character


@in_turn("character", lambda: SEEN, ids=ascii)
def test_a_character_that_is_seen_is_not(character: str) -> None:
    assert not character or not is_invisible(character)
    assert first_invisible(f"a {character}b\nc\n") is None


@given(st.text())
def test_the_first_of_them_is_found(text: str) -> None:
    found = [character for character in text if is_invisible(character)]
    assert first_invisible(text) == (found[0] if found else None)


def test_what_is_invisible_does_not_depend_on_the_python_that_runs() -> None:
    """As many as the ranges hold, counted by hand: 65 controls but the line feed, and so on."""
    count = sum(is_invisible(chr(code)) for code in range(0x110000))
    assert count == 64 + 3 + 5 + 7 + 16 + 2048 + 16 + 1 + 3 + 4096
