"""The Markdown pages: the same facts, links that lead somewhere, and no accidental markup."""

import re

from framegen.targets.docs.escape import code, markdown, verbatim

from tests.in_turn import in_turn
from tests.unit.site.reference import SPECS, Page, reference

LINK = re.compile(r"(?<!\\)\]\(([^)]*)\)")


def every_file() -> list[tuple[str, str]]:
    """Return the spec and the path of each file."""
    return [(name, path) for name in SPECS for path in reference(name).files]


@in_turn("name, path", every_file)
def test_every_link_leads_somewhere(name: str, path: str) -> None:
    site, root = reference(name), f"docs/reference/{name}/"
    links = LINK.findall(site.files[path])
    assert links
    for link in links:
        found, _ = Page(f"{root}{path}", "").leads_to(link)
        assert found == "spec/busservo.yaml" or found.removeprefix(root) in site.files, link


@in_turn("name, path", every_file)
def test_tables_have_as_many_cells_in_every_row(name: str, path: str) -> None:
    width = 0
    for line in reference(name).files[path].splitlines():
        cells = len(re.findall(r"(?<!\\)\|", line))
        assert not (line.startswith("|") and width) or cells == width, line
        width = cells if line.startswith("|") else 0


@in_turn("name", lambda: SPECS)
def test_every_page_of_a_message_has_a_markdown_version(name: str) -> None:
    site = reference(name)
    for message in site.model.messages.values():
        text = site.files[f"messages/{message.name}.md"]
        assert text.count("\n# ") == 1
        assert markdown(message.message.summary) in text
        for slot in message.fields:
            assert slot.name in text


@in_turn(
    "text, escaped",
    lambda: [
        ("plain words.", "plain words."),
        ("a\n\nb", "a b"),
        ("<b>", "&lt;b&gt;"),
        ("[x](y)", r"\[x\](y)"),
        ("a_b*c`d", r"a\_b\*c\`d"),
        ("# no heading", r"\# no heading"),
        ("- no item", r"\- no item"),
        ("12. no item", r"12\. no item"),
        ("1.5 is a number", "1.5 is a number"),
        ("a | b", r"a \| b"),
        ("https://x", "https&#58;//x"),
        ("{{ x }}", "&#123;&#123; x &#125;&#125;"),
    ],
)
def test_text_is_escaped_in_markdown(text: str, escaped: str) -> None:
    assert markdown(text) == escaped


def test_text_in_code_cannot_end_it() -> None:
    assert code("a`b|c") == r"`a'b\|c`"
    assert code("") == ""
    assert "```" not in verbatim("x\n```\ny")
