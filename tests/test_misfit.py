"""Errors of values that do not fit the language, in the language's words."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import pytest

from tests.factories import DEMO, compiled_of, data_of

if TYPE_CHECKING:
    from tests.factories import Steps

ANGLE = ("messages", "VentsOpen", "fields", "vents", "fields", "angle")
LONG = "abcdefghij" * 4


@pytest.mark.parametrize(
    ("path", "value", "said", "hint"),
    [
        (("link",), None, "a mapping of keys is expected here, not nothing", ""),
        (("link",), {}, "the key `baud` is missing", "Bits per second."),
        (("link", "baud"), LONG, f"a whole number is expected here, not `{LONG}`", ""),
        (("link", "baud"), f"{LONG}k", f"a whole number is expected here, not `{LONG}...`", ""),
        (
            ("protocol", "title"),
            True,
            "text is expected here, not the truth value `true`",
            'put it in quotes: "true"',
        ),
        (
            ("protocol", "title"),
            {"en": "Greenhouse"},
            "text is expected here, not a mapping",
            "",
        ),
        (
            ("frame", "size"),
            {"is": "id"},
            "the key `type` is missing",
            "The number type, such as u8.",
        ),
        (
            ("frame", "preamble"),
            {"is": "constant"},
            "the key `bytes` is missing",
            "The bytes, in hex.",
        ),
        ((*ANGLE, "unti"), "V", "there is no key `unti` here", "did you mean `unit`?"),
        (
            ("messages", "VentsOpen", "fields", "vents", "elment"),
            "Vent",
            "there is no key `elment` here",
            "did you mean `element`?",
        ),
        (
            ("messages", "VentsOpen", "examples", 0, "titel"),
            "All of them",
            "there is no key `titel` here",
            "did you mean `title`?",
        ),
    ],
)
def test_a_misfit_is_reported_in_the_words_of_the_language(
    path: Steps, value: object, said: str, hint: str
) -> None:
    data = data_of(DEMO)
    around: Any = data
    for step in path[:-1]:
        around = around[step]
    around[path[-1]] = value
    finding = compiled_of(data).findings[0]
    assert (finding.message, finding.hint) == (said, hint)
    steps = [f"[{step}]" if isinstance(step, int) else f".{step}" for step in path]
    assert f".{finding.path}".startswith("".join(steps))


def test_a_key_that_is_no_number_is_reported_once_whatever_its_value() -> None:
    data = data_of(DEMO)
    data["lookalikes"]["old_stations"]["commands"] = {"lit": {"what": "It shines."}}
    found = [(f.path, f.message) for f in compiled_of(data).findings]
    path = "lookalikes.old_stations.commands.lit"
    assert found[0] == (path, "a whole number is expected here, not `lit`")
    assert {each for each, _ in found} == {path}
