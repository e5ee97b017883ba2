"""Code blocks: what they show, what they copy, and their colours."""

import html
import re

from framegen.site.guides.guide import Guide
from framegen.site.guides.highlight import code_block

from tests.in_turn import in_turn
from tests.unit.site.lamps import lamps
from tests.unit.site.reference import Page

PYTHON_SESSION = """>>> for x in "ab":
...     print(x)
...
a
b
>>> 1 + \\
... 1
2
"""


@in_turn(
    "code, language, typed",
    lambda: [
        ("import x\n", "python", "import x\n"),
        (PYTHON_SESSION, "pycon", 'for x in "ab":\n    print(x)\n\n1 + \\\n1\n'),
        ("$ a b\nprinted\n$ c\n", "console", "a b\nc\n"),
        ("a: 1\n", "yaml", "a: 1\n"),
        ("anything <b>\n", "text", "anything <b>\n"),
        ("what is that?\n", "no-such-language", "what is that?\n"),
        ("    indented\n", "", "    indented\n"),
    ],
)
def test_a_block_shows_all_and_copies_what_is_typed(code: str, language: str, typed: str) -> None:
    page = Page("", str(code_block(code, language)))
    (button,) = [given for tag, given in page.tags if tag == "button"]
    assert button["data-copy"] == typed
    assert page.words.removesuffix("\n").removesuffix("Copy") == code
    # Without a script there is nothing to press.
    assert {"hidden", "data-script"} <= button.keys()


def test_output_is_no_code_and_cannot_be_copied() -> None:
    page = Page("", str(code_block("1 < 2\n", "output")))
    assert [tag for tag, _ in page.tags] == ["pre", "code"]
    assert page.tags[0][1]["class"] == "output"
    assert page.words.strip() == "1 < 2"


@in_turn(
    "code, language, piece",
    lambda: [
        ("import x", "python", ("keyword", "import")),
        ("x = 'a'", "python", ("text", "'a'")),
        ("x = 12", "python", ("number", "12")),
        ("# why", "python", ("comment", "# why")),
        ("def f(): ...", "python", ("name", "f")),
        (">>> x", "pycon", ("prompt", ">>> ")),
        (">>> x\n1", "pycon", ("printed", "1\n")),
        ("$ x", "console", ("prompt", "$ ")),
        ("$ x", "console", ("typed", "x\n")),
        ("$ x\ny", "console", ("printed", "y\n")),
        ("if true; then", "sh", ("keyword", "if")),
        ("REM why", "bat", ("comment", "REM why")),
        ("# why", "powershell", ("comment", "# why")),
        ("a: 1", "yaml", ("name", "a")),
        ('{"a": 1}', "json", ("name", '"a"')),
        ("+a\n", "diff", ("inserted", "+a")),
        ("-a\n", "diff", ("deleted", "-a")),
        ("a = 1", "toml", ("number", "1")),
        ("return 1;", "c", ("keyword", "return")),
    ],
)
def test_code_is_coloured_by_classes(code: str, language: str, piece: tuple[str, str]) -> None:
    text = str(code_block(code, language))
    found = re.findall(r'<span class="(\w+)">(.*?)</span>', text, re.DOTALL)
    assert piece in [(name, html.unescape(inside)) for name, inside in found]


@in_turn("language", lambda: ["python", "pycon", "console", "output", "text", "yaml", "<b>"])
def test_code_is_escaped(language: str) -> None:
    text = str(code_block("</code><script>'\"&\n$ <b>\n>>> <b>\n", language))
    assert "<script" not in text
    assert "<b>" not in text


def test_every_class_of_code_has_a_colour_in_the_style_sheet() -> None:
    style = lamps()["index.html"].styles[0]
    for name in ("prompt", "printed", "comment", "keyword", "text", "number", "name"):
        assert f".code code .{name} {{" in style


def test_what_follows_the_language_of_a_block_is_for_others() -> None:
    plain = Guide("a.md", "```python\nimport x\n```\n").body
    marked = Guide("a.md", "```python slow\nimport x\n```\n").body
    assert marked == plain
    assert "keyword" in plain
