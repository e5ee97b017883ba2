"""A hostile spec: whatever its texts hold, every page of its reference stays inert."""

import json
from functools import cache

from framegen.site.escape import linked, script_json

from tests.factories import BUSSERVO, data_of
from tests.mutations.prose import with_prose
from tests.unit.site.compared import not_inert
from tests.unit.site.reference import Page, Reference, reference_of, respelled

# Each tries to get out of the place where it is put: HTML, an attribute, a script, a style, a
# comment, Markdown of any kind, a template, or code. What must begin a text comes first.
PAYLOADS = (
    "``` ```js x``` ~~~ # h --- * * *",
    "<script>alert(1)</script><img src=x onerror=alert(1)>",
    '" onmouseover="alert(1)" x=\'',
    "</script><script>alert(1)</script>${alert(1)}`+alert(1)+`",
    "--><script>alert(1)</script><!--",
    "</style><style>*{background:url(https://evil.test/x)}",
    "[x](javascript:alert(1)) ![x](https://evil.test/y) <b>b</b> `c` **d** | e",
    "{{ 7*7 }}{% raise %}{# x #}",
    "javascript:alert(1) https://evil.test www.evil.test me@evil.test",
    "*/ alert(1) /* `${alert(1)}`",
)
# All of it, with an odd number of backticks.
HOSTILE = " ".join(PAYLOADS)
assert HOSTILE.count("`") % 2


@cache
def hostile(payload: str = HOSTILE) -> Reference:
    """Return the reference of a spec that says it wherever it may say anything."""
    made = reference_of(respelled(with_prose(data_of(BUSSERVO), payload)))
    assert [finding.rule for finding in made.compiled.findings] == []
    return made


def skeleton(page: Page) -> list[tuple[str, tuple[str, ...]]]:
    """Return the elements of a page and the names of their attributes, without their texts."""
    return [(tag, tuple(sorted(given))) for tag, given in page.tags]


def both() -> tuple[Reference, Reference]:
    """Return the reference of hostile words, and of harmless ones."""
    return hostile(), hostile("words")


def test_the_pages_differ_from_those_of_a_harmless_spec_in_words_alone() -> None:
    site, harmless = both()
    assert site.pages.keys() == harmless.pages.keys()
    assert [*not_inert(site, harmless)] == []
    for path, page in site.pages.items():
        if path != "spec.html":
            assert skeleton(page) == skeleton(harmless.pages[path]), path
    for path, text in site.files.items():
        assert text.count("\n") == harmless.files[path].count("\n"), path
        assert "www.e" not in text, path


def test_the_data_of_the_decoder_and_of_the_search_is_data() -> None:
    data = hostile().pages["decoder.html"].data
    assert "<" not in data
    assert json.loads(data)["messages"][0]["name"] == "ServoMove"
    page, other = (each.site["search.html"] for each in both())
    assert "<" not in page.data
    for part in (found_paths, elements, listed, code):
        assert part(page) == part(other)


def found_paths(page: Page) -> list[str]:
    return [entry["path"] for entry in json.loads(page.data)["entries"]]


def elements(page: Page) -> set[tuple[str, tuple[str, ...]]]:
    return {*skeleton(page)}


def listed(page: Page) -> set[str]:
    return {link for link in page.links if link.startswith("reference/")}


def code(page: Page) -> list[str]:
    return [text for given, text in page.scripts if not given]


def test_names_in_prose_lead_to_pages_and_nothing_else_does() -> None:
    addresses = {"ServoMove": "messages/ServoMove.html"}
    assert linked("<ServoMove> & ServoMover", addresses, "../") == (
        '&lt;<a href="../messages/ServoMove.html">ServoMove</a>&gt; &amp; ServoMover'
    )


def test_json_in_a_script_closes_nothing() -> None:
    text = "</script><!--\u2028&"
    assert json.loads(script_json(text)) == text
    assert not set("<>&\u2028") & set(script_json(text))
