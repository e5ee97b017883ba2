"""Scripts and style sheets on a page say what their files say."""

from pathlib import Path
from typing import Any

from framegen.site.compact import compact_script, compact_style
from pygments.lexers import CssLexer, JavascriptLexer
from pygments.token import Comment, Whitespace

from tests.in_turn import in_turn

STATIC = Path(__file__).parents[3] / "codegen" / "framegen" / "site" / "static"
SCRIPTS = sorted((STATIC / "js").glob("*.js"))
STYLES = sorted((STATIC / "css").glob("*.css"))

# What is written, and what of it goes into a page.
CASES = (
    ("a();\n  b();\n", "a();\nb();\n"),
    ("// why\na();\n", "a();\n"),
    ("a(); // why\n", "a(); // why\n"),
    ("/* why */\na();\n", "a();\n"),
    ("/* why */ a();\n", "a();\n"),
    ("/**\n * why\n */\na();\n", "a();\n"),
    ("/* why\n   still */ a();\nb();\n", "a();\nb();\n"),
    ('  a("// no comment");\n', 'a("// no comment");\n'),
    ("  a(`b`);\n\n", "a(`b`);\n"),
    # Blanks have a meaning within text over several lines, so that all of it stays.
    ("a(`\n  // text\n`);\n", "a(`\n  // text\n`);\n"),
    ('a("b\\\n  c");\n', 'a("b\\\n  c");\n'),
)


@in_turn("written, expected", lambda: CASES)
def test_a_script_keeps_its_code(written: str, expected: str) -> None:
    assert compact_script(written) == expected


def test_a_style_sheet_has_a_rule_a_line() -> None:
    rule = "a,\nb {\n  color: red;\n  top: 0;\n}\n"
    written = f"/* why */\n{rule}@media print {{\n  a {{ top: 1px; }}\n}}\n"
    short = "a,b {color: red;top: 0;}\n@media print {a { top: 1px; }\n}\n"
    assert compact_style(written) == short


@in_turn("file", lambda: [*SCRIPTS, *STYLES])
def test_each_file_has_the_same_tokens(file: Path) -> None:
    compact, lexer = compact_script, JavascriptLexer()
    if file in STYLES:
        compact, lexer = compact_style, CssLexer()
    text = file.read_text(encoding="utf-8")
    assert _tokens(lexer, compact(text)) == _tokens(lexer, text)


def test_code_becomes_shorter() -> None:
    texts = [file.read_text(encoding="utf-8") for file in SCRIPTS]
    assert sum(map(len, map(compact_script, texts))) < 0.85 * sum(map(len, texts))


def _tokens(lexer: Any, text: str) -> list[str]:
    """Return the tokens of a text, but for blanks and for comments."""
    found = lexer.get_tokens(text)
    kept = [value for kind, value in found if kind not in Comment and kind not in Whitespace]
    return [value.strip() for value in kept if value.strip()]
