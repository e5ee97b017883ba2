"""A hostile spec: whatever its texts hold, every page of its reference stays inert."""

import json
import re
from functools import cache

from framegen.site.escape import linked, script_json

from tests.factories import BUSSERVO, data_of
from tests.mutations.prose import with_prose
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


def test_the_pages_have_the_elements_and_attributes_of_a_harmless_spec() -> None:
    site, harmless = both()
    assert site.pages.keys() == harmless.pages.keys()
    for path, page in site.pages.items():
        if path != "spec.html":
            assert skeleton(page) == skeleton(harmless.pages[path]), path
    tags = {tag for tag, _ in site.pages["spec.html"].tags}
    assert tags == {tag for tag, _ in harmless.pages["spec.html"].tags}


def test_scripts_and_styles_hold_nothing_of_the_spec() -> None:
    site, harmless = both()
    for path, page in site.pages.items():
        other = harmless.pages[path]
        assert page.styles == other.styles
        code = [text for given, text in page.scripts if not given]
        assert code == [text for given, text in other.scripts if not given]


def test_the_data_of_the_decoder_is_data() -> None:
    scripts = hostile().pages["decoder.html"].scripts
    (data,) = [text for given, text in scripts if given.get("type") == "application/json"]
    assert "<" not in data
    assert json.loads(data)["messages"][0]["name"] == "ServoMove"


def test_what_can_be_searched_is_data_and_text() -> None:
    page, other = (each.site["search.html"] for each in both())
    (data,) = [text for given, text in page.scripts if given.get("type") == "application/json"]
    assert "<" not in data
    found, expected = (json.loads(each)["entries"] for each in (data, _index(other)))
    assert [each["path"] for each in found] == [each["path"] for each in expected]
    assert sorted(set(skeleton(page))) == sorted(set(skeleton(other)))
    listed = {link for link in page.links if link.startswith("reference/")}
    assert listed == {link for link in other.links if link.startswith("reference/")}
    code = [text for given, text in page.scripts if not given]
    assert code == [text for given, text in other.scripts if not given]


def _index(page: Page) -> str:
    return next(text for given, text in page.scripts if given.get("id") == "search-index")


def test_links_are_those_of_a_harmless_spec() -> None:
    site, harmless = both()
    for path, page in site.pages.items():
        if path != "spec.html":
            paths = [link.partition("#")[0] for link in page.links]
            assert paths == [link.partition("#")[0] for link in harmless.pages[path].links]


def test_markdown_has_no_html_no_link_and_no_block_of_the_spec() -> None:
    site, harmless = both()
    for path, text in site.files.items():
        body = text.partition("-->")[2]
        assert "<" not in body, path
        for word in ("https://", "www.e", "{{", "{%"):
            assert word not in body, (path, word)
        targets = re.findall(r"(?<!\\)\]\(([^)]*)\)", body)
        assert targets == re.findall(r"(?<!\\)\]\(([^)]*)\)", harmless.files[path])
        other = harmless.files[path]
        assert text.count("```") == other.count("```"), path
        assert text.count("\n#") == other.count("\n#"), path
        assert text.count("\n") == other.count("\n"), path


def test_names_in_prose_lead_to_pages_and_nothing_else_does() -> None:
    addresses = {"ServoMove": "messages/ServoMove.html"}
    assert linked("<ServoMove> & ServoMover", addresses, "../") == (
        '&lt;<a href="../messages/ServoMove.html">ServoMove</a>&gt; &amp; ServoMover'
    )


def test_json_in_a_script_closes_nothing() -> None:
    text = "</script><!--\u2028&"
    assert json.loads(script_json(text)) == text
    assert not set("<>&\u2028") & set(script_json(text))
