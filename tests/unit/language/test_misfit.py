"""Errors of values that do not fit the language, in the language's words."""

import re
from collections.abc import Iterator, Mapping

import pytest
from framegen.language.misfit import _keys
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.other_words import (
    _BY_MODEL,
    _KINDS,
    _TYPES,
    kind_of,
    other_key,
    other_kind,
    other_type,
)
from pydantic import BaseModel

from tests.factories import DEMO, compiled_of, data_of
from tests.in_turn import in_turn
from tests.mutations.places import having

VENTS, FIRST = "messages.VentsOpen.fields.vents", "messages.VentsOpen.examples.0"
NO_TEXT = "text is expected here, not"
LONG = "abcdefghij" * 4


@in_turn(
    "path, value, said, hint",
    lambda: [
        ("link", None, "a mapping of keys is expected here, not nothing", ""),
        ("link", {}, "the key `baud` is missing", "Bits per second."),
        ("link.baud", LONG, f"a whole number is expected here, not `{LONG}`", ""),
        ("link.baud", f"{LONG}k", f"a whole number is expected here, not `{LONG}...`", ""),
        ("protocol.title", True, f"{NO_TEXT} the truth value `true`", 'put it in quotes: "true"'),
        ("protocol.title", {"en": "Greenhouse"}, f"{NO_TEXT} a mapping", ""),
        ("frame.size", {"is": "id"}, "the key `type` is missing", "The number type, such as u8."),
        ("frame.preamble", {"is": "constant"}, "the key `bytes` is missing", "The bytes, in hex."),
        (f"{VENTS}.fields.angle.unti", "V", "there is no key `unti` here", "did you mean `unit`?"),
        (f"{VENTS}.elment", "Vent", "there is no key `elment` here", "did you mean `element`?"),
        (f"{FIRST}.titel", "All", "there is no key `titel` here", "did you mean `title`?"),
    ],
)
def test_a_misfit_is_reported_in_the_words_of_the_language(
    path: str, value: object, said: str, hint: str
) -> None:
    finding = compiled_of(having(data_of(DEMO), {path: value})).findings[0]
    assert (finding.message, finding.hint) == (said, hint)
    assert finding.path.replace("[0]", ".0").startswith(path)


def test_a_key_that_is_no_number_is_reported_once_whatever_its_value() -> None:
    commands = {"lit": {"what": "It shines."}}
    data = having(data_of(DEMO), {"lookalikes.old_stations.commands": commands})
    found = [(f.path, f.message) for f in compiled_of(data).findings]
    path = "lookalikes.old_stations.commands.lit"
    assert found[0] == (path, "a whole number is expected here, not `lit`")
    assert {each for each, _ in found} == {path}


def _each(table: Mapping[str, str]) -> Iterator[tuple[str, str]]:
    return ((word, meant) for words, meant in table.items() for word in words.split())


MEANT = [(model, word, hint) for model, words in _BY_MODEL.items() for word, hint in _each(words)]


@in_turn("model, word, hint", lambda: MEANT)
def test_another_word_is_no_key_and_its_hint_names_keys(
    model: type[BaseModel], word: str, hint: str
) -> None:
    known = _keys(model)
    assert word not in known
    assert other_key(model, word) == hint
    written = re.findall(r"write `([a-z_]+)", hint)
    assert set(written) <= {*known, "big", "little"}


@in_turn("word", lambda: [word for words in _KINDS for word in words.split()])
def test_another_word_for_a_part_is_none_and_its_hint_is_one(word: str) -> None:
    kinds = ["constant", "reserved", "body", "length", "id", "address", "counter", "checksum"]
    assert word not in kinds
    [kind] = re.findall("^write `is: ([a-z]+)`", other_kind(word))
    assert kind in kinds


@in_turn(
    "word, type_",
    lambda: [(word, type_) for word, type_ in _each(_TYPES) if word not in NUMBER_TYPES],
)
def test_another_word_for_a_type_is_none_and_its_hint_is_one(word: str, type_: str) -> None:
    assert type_ in NUMBER_TYPES
    assert other_type(word) == f"write `type: {type_}`"
    if type_ not in ("u8", "i8"):
        assert other_type(f"{word}_le") == f"write `type: {type_}, byte_order: little`"


def test_a_word_for_a_type_that_takes_more_keys_is_answered_with_these() -> None:
    digits = "write `type: u4, count: 2, range: 0..9, byte_order: big` for two digits in a byte"
    assert other_type("BCD").startswith(digits)
    text = "write `type: u8, count: 16, text: ascii`, or with `sized_by` instead of"
    assert other_type("string").startswith(text)


@pytest.mark.parametrize(
    ("keys", "kind"),
    [
        ({"bytes": "AA"}, "constant"),
        ({"type": "u8", "counts": []}, "length"),
        ({"type": "u8", "method": "sum", "covers": []}, "checksum"),
        ({"type": "u8", "values": {}}, "address"),
        ({"type": "u8"}, "id"),
        ({"about": "The fields."}, ""),
    ],
)
def test_a_part_without_a_kind_is_told_by_its_keys(keys: dict[str, object], kind: str) -> None:
    assert kind_of(keys) == kind
