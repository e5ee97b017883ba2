"""The schema of the spec language: it accepts every good spec, and refuses typos."""

import json
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from framegen.cli import main
from framegen.language.number_types import NUMBER_TYPES
from framegen.language.site_settings import SiteSettings
from framegen.language.spec import Spec
from framegen.targets.schema import _KEYWORDS, schema_text, site_schema_text
from jsonschema import Draft202012Validator

from tests.factories import BUSSERVO, DEMO, data_of
from tests.in_turn import in_turn

SCHEMA: dict[str, Any] = json.loads(schema_text())
VALIDATOR = Draft202012Validator(SCHEMA)


def complaints(data: object) -> list[str]:
    """Return the paths at which the schema refuses `data`."""
    return sorted("/".join(map(str, error.absolute_path)) for error in VALIDATOR.iter_errors(data))


def schemas_in(schema: dict[str, Any]) -> Iterator[dict[str, Any]]:
    """Yield the schema itself and every schema within it."""
    yield schema
    for keyword, value in schema.items():
        if keyword in ("properties", "$defs"):
            inner = list(value.values())
        elif keyword in ("anyOf", "oneOf"):
            inner = value
        elif keyword in ("items", "additionalProperties") and isinstance(value, dict):
            inner = [value]
        else:
            continue
        for each in inner:
            yield from schemas_in(each)


def test_the_schema_is_a_schema() -> None:
    Draft202012Validator.check_schema(SCHEMA)
    assert SCHEMA["$schema"] == "https://json-schema.org/draft/2020-12/schema"
    assert SCHEMA["title"] == "framegen spec"
    assert "$id" not in SCHEMA


def test_the_number_types_are_named_in_a_description() -> None:
    description = SCHEMA["$defs"]["NumberField"]["properties"]["type"]["description"]
    assert description == (
        "The number type: u8, u16, u24, u32, u64, i8, i16, i24, i32, i64, f32, f64; "
        "and u1 to u63, for packed numbers in a list of a fixed `count`."
    )


def test_the_command_prints_the_text_as_json(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["schema"]) == 0
    text = json.dumps(SCHEMA, indent=2, ensure_ascii=False) + "\n"
    assert capsys.readouterr().out == schema_text() == text


@pytest.mark.parametrize("file", [BUSSERVO, DEMO], ids=lambda file: file.name)
def test_a_good_spec_is_accepted(file: Path) -> None:
    assert complaints(data_of(file)) == []


GONE = object()
_FIELD = "messages/ServoMove/fields/time_ms"
_LIST = "messages/ServoMove/fields/targets"
_ELEMENT = f"{_LIST}/fields/position"
_EXAMPLE = "messages/ServoMove/examples/0"
_INVERTED = {"is": "checksum", "type": "u8", "method": "inverted sumn", "covers": ["length"]}

# A slip: what becomes of a mapping in the spec of the bus servo controller, and the place where an
# editor shows it.
SLIPS: list[tuple[str, str, str, Any, str]] = [
    ("a key that there is not", "", "mesages", {}, ""),
    ("a missing key", "", "link", GONE, ""),
    ("a later language", "", "framegen", 3, "framegen"),
    ("a misspelt byte order", "", "byte_order", "litle", "byte_order"),
    ("a misspelt parity", "link", "parity", "non", "link/parity"),
    ("a rate of zero", "link", "baud", 0, "link/baud"),
    ("a version that is a number", "protocol", "version", 1, "protocol/version"),
    ("a misspelt type in the frame", "frame/length", "type", "u17", "frame/length"),
    ("a misspelt part", "frame/length", "is", "lenght", "frame/length"),
    ("a message without a length", "messages/ServoMove", "length", GONE, "messages/ServoMove"),
    ("a signed type in the frame", "frame/command", "type", "i8", "frame/command"),
    ("a misspelt checksum", "frame", "check", _INVERTED, "frame/check"),
    ("a negative id", "messages/ServoMove", "id", -1, "messages/ServoMove/id"),
    ("a misspelt type in a field", _FIELD, "type", "v16", _FIELD),
    ("a misspelt type in an element", _ELEMENT, "type", "word", _LIST),
    ("a misspelt key of a field", _FIELD, "untis", "ms", _FIELD),
    ("limits without the usual ones", f"{_ELEMENT}/limits", "usual", GONE, _LIST),
    ("a pose without ids", "pose", "ids", GONE, "pose"),
    ("an example without values", _EXAMPLE, "values", GONE, _EXAMPLE),
    ("a list for a mapping", "", "sources", [], "sources"),
    ("evidence of no known kind", "sources/vendor", "kind", "book", "sources/vendor/kind"),
]


@cache
def written() -> str:
    return json.dumps(data_of(BUSSERVO))


@in_turn("at, key, value, place", lambda: [pytest.param(*row, id=name) for name, *row in SLIPS])
def test_a_slip_is_refused_at_its_place(at: str, key: str, value: object, place: str) -> None:
    data = found = json.loads(written())
    for step in filter(None, at.split("/")):
        found = found[int(step) if step.isdigit() else step]
    found[key] = value
    if value is GONE:
        del found[key]
    assert complaints(data) == [place]


def test_every_number_type_is_offered() -> None:
    offered = {
        name: model["properties"]["type"]["enum"]
        for name, model in SCHEMA["$defs"].items()
        if "type" in model["properties"]
    }
    parts = ["u8", "u16", "u24", "u32", "u64"]
    packed = [f"u{bits}" for bits in range(1, 64) if bits % 8]
    assert offered.pop("NumberField") == [*NUMBER_TYPES, *packed]
    named = ["AddressPart", "ChecksumPart", "CounterPart", "IdPart", "LengthPart"]
    assert offered == dict.fromkeys(named, parts)


def test_every_signed_type_is_offered_to_read_a_number_as() -> None:
    offered, nothing = SCHEMA["$defs"]["NumberField"]["properties"]["signed_as"]["anyOf"]
    assert (offered["enum"], nothing) == (["i8", "i16", "i24", "i32", "i64"], {"type": "null"})


def test_an_editor_has_something_to_say_of_every_key() -> None:
    silent = [
        f"{name}.{key}"
        for name, model in SCHEMA["$defs"].items()
        for key, schema in model["properties"].items()
        if not {"description", "const"} & schema.keys()
    ]
    assert silent == []


def test_keywords_stand_in_one_order_and_no_title_repeats_a_key() -> None:
    for schema in schemas_in(SCHEMA):
        places = [_KEYWORDS.index(keyword) for keyword in schema]
        assert places == sorted(places)
        assert schema is SCHEMA or "title" not in schema
    assert list(SCHEMA["$defs"]) == sorted(SCHEMA["$defs"])


def test_nothing_that_the_language_means_is_left_out() -> None:
    """A keyword that pydantic gives and the schema drops is one that editors do not need."""
    raw = Spec.model_json_schema(by_alias=True, mode="validation")
    given = {keyword for schema in schemas_in(raw) for keyword in schema}
    assert given - set(_KEYWORDS) == {"discriminator"}


def test_the_schema_of_site_settings_has_their_keys_and_refuses_others(
    capsys: pytest.CaptureFixture[str],
) -> None:
    assert main(["schema", "--site"]) == 0
    text = capsys.readouterr().out
    assert text == site_schema_text()
    schema = json.loads(text)
    Draft202012Validator.check_schema(schema)
    assert schema["properties"].keys() == SiteSettings.model_fields.keys()
    assert all(each["description"] for each in schema["properties"].values())
    judge = Draft202012Validator(schema)
    every = {key: each["examples"][0] for key, each in schema["properties"].items()}
    assert SiteSettings.model_validate(every).model_dump() == every
    for good in ({}, every):
        assert judge.is_valid(good)
    bads: list[object] = [{"tilte": "x"}, {"title": 1}, {"accent": None}, []]
    for bad in bads:
        assert not judge.is_valid(bad)
