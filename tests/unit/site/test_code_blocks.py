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


# The pieces of code that have a colour, by language and class.
COLOURED = """
python keyword «import» x | python text x = «'a'» | python number x = «12»
python name def «f»(): ... | python comment «# why» | pycon prompt «>>> »x | console prompt «$ »x
sh keyword «if» true; then | bat comment «REM why» | powershell comment «# why»
yaml name «a»: 1 | json name {«"a"»: 1} | toml number a = «1» | c keyword «return» 1;
"""
BELOW = [
    *(("diff", "inserted", "«+a»\n"), ("diff", "deleted", "«-a»\n")),
    ("pycon", "printed", ">>> x\n«1\n»"),
    ("console", "typed", "$ «x\n»"),
    ("console", "printed", "$ x\n«y\n»"),
]


@in_turn(
    "language, name, code",
    lambda: BELOW + [each.split(" ", 2) for each in re.split(r" \| |\n", COLOURED.strip())],
)
def test_code_is_coloured_by_classes(language: str, name: str, code: str) -> None:
    text = str(code_block(re.sub("[«»]", "", code), language))
    found = re.findall(rf'<span class="{name}">(.*?)</span>', text, re.DOTALL)
    assert re.findall("«(.*)»", code, re.DOTALL)[0] in map(html.unescape, found)


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
