"""A hostile spec: whatever its texts and names hold, it ends in a finding or in inert text."""

import ast
import doctest
import io
import re
import sys
import tokenize
from collections.abc import Mapping
from functools import cache
from hashlib import sha256
from itertools import count, cycle
from pathlib import Path
from shutil import which
from typing import TypeAlias

import pytest
from framegen.compile import Compiled
from framegen.language.package_names import words
from framegen.output import banner
from framegen.reading.text import is_invisible
from framegen.targets.python.characters import columns
from framegen.targets.python.docstring import TYPOGRAPHY, docstring, prose
from framegen.targets.python.escape import Text, assigned, literal
from hypothesis import example, given
from hypothesis import strategies as st

from tests.crowd import Crowd
from tests.factories import (
    BUSSERVO,
    DEMO,
    ROOT,
    Data,
    Steps,
    compiled_of,
    compiled_values,
    data_of,
    files_of,
    is_misfit,
    library_files,
    rules_broken,
    vectors_of,
    write_files,
)
from tests.in_turn import in_turn
from tests.mutations.places import changed, renamed, texts
from tests.mutations.prose import HARMLESS, PROSE, is_prose, with_prose
from tests.programs import ran
from tests.rows import some

SPECS = {"busservo": data_of(BUSSERVO), "greenhouse": data_of(DEMO)}

# Text that a reader of the output may take for something else, were it not made safe.
INERT = [
    *('"', "'", '""', "''", '"""', "'''", '""""""', '"quoted"', 'ends with """'),
    *('""" begins with it', 'half an escape \\"""', '\\" and \\""" and \\\\"""', "trailing \\"),
    *("trailing \\\\", "\\", "\\N{BULLET} \\x41 \\u0041 \\101 \\n", "two\nlines"),
    *("a paragraph\n\nand another", '"""\nimport os\nos.system("x")\n"""', "\nimport os\n"),
    *("{{ 7*7 }}", "{% raise %}{# comment #}{%- endfor %}", "{% raw %}{{ messages }}{% endraw %}"),
    *("{0} {self} {x!r:>10} %s %(name)s %", "</script><script>alert(1)</script>"),
    *("<!-- --> & &lt; ]]>", '>>> import os; os.system("x")'),
    *(">>>> print(1)\n... print(2)\n>>> 1/0", "> >> >>> 1/0", ">>>\n>>> 1/0\n1", "# type: ignore"),
    *("# noqa # fmt: off", "# -*- coding: utf-7 -*-", "coding: latin-1", "+ACIAIgAi- import os"),
    *("r'''", 'f"{1/0}"', 'b"x"', "$(touch x) `touch x` ; rm -rf / | cat && true"),
    *("../../../etc/passwd", "C:\\new\\table\\x", "\uff50rint \ufb01 ① \uff21"),
    *("\u0440\u0430ypal is Cyrillic", "e\u0301 a\u0308\u0323", "\U0001f600 \U00010000 \U0001d4d0"),
    *("漢字仮名交じり文", "\u00a0\u2003\u3000", "-", "- item\n- item", ":", "x" * 300),
    *("=====\n:param x: y\n.. code::", "word " * 60, '" ' * 60, "\\ " * 60, ">>> " * 60, " "),
]
# What nobody can see, or what turns that which is seen around: no spec may hold it.
UNSEEN = [
    *"\x00\x07\t\r\x1b\x7f\x85\xad\u061c\u200b\u200f\u2028\u2029\u202e\u2066\ufe0f\ufeff",
    "\U000e0041",
    "\ud800",
]


UNUSABLE = {"invisible-character", "unusable"}


def python_of(files: dict[str, str]) -> dict[str, str]:
    return {path: text for path, text in files.items() if path.endswith(".py")}


def skeleton(tree: ast.Module) -> str:
    """Return the digest of a module without its strings: the same where text alone differs."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            node.value = ""
    return sha256(ast.dump(tree).encode()).hexdigest()


def comments(text: str) -> list[str]:
    if text.startswith("#") and text.count("#") == 1:
        return [text.partition("\n")[0]]
    tokens = tokenize.generate_tokens(io.StringIO(text).readline)
    return [token.string for token in tokens if token.type == tokenize.COMMENT]


def doctests(tree: ast.Module) -> list[str]:
    """Return the code that doctest would run."""
    parser = doctest.DocTestParser()
    return [
        example.source
        for node in ast.walk(tree)
        if isinstance(node, ast.Expr) and isinstance(node.value, ast.Constant)
        if ">>>" in str(node.value.value)
        for example in parser.get_examples(str(node.value.value))
    ]


@cache
def imports(text: str) -> list[str]:
    nodes = ast.walk(ast.parse(text.encode()))
    return [ast.dump(node) for node in nodes if isinstance(node, ast.Import | ast.ImportFrom)]


Traits: TypeAlias = tuple[str, list[str], list[str]]


@cache
def _traits(text: str) -> Traits:
    tree = ast.parse(text.encode())
    run = doctests(tree)  # before the strings are gone
    return skeleton(tree), comments(text), run


def traits(files: dict[str, str]) -> dict[str, Traits]:
    """Return all of the modules that texts must not change; of their heads, all but the digest."""
    return {path: _traits(text) for path, text in python_of(files).items()}


@cache
def harmless(name: str) -> dict[str, Traits]:
    return traits(files_of(with_prose(SPECS[name], HARMLESS)))


@cache
def hostile(name: str, turn: int) -> dict[str, str]:
    """Return a library with hostile text in each place of prose: in one after another, all kinds.

    In each turn a place has another kind, and all of them together in the last.
    """
    numbers = count(turn)

    def change(_path: Steps, old: str) -> str:
        text = ALL_AT_ONCE if turn == len(INERT) else INERT[next(numbers) % len(INERT)]
        return old.replace(HARMLESS, text) if HARMLESS in old else old

    files = files_of(changed(with_prose(SPECS[name], HARMLESS), change))
    # Most modules are the same in all of them, and kept once.
    return {path: sys.intern(module) for path, module in files.items()}


def titles_of_vectors(titles: list[str]) -> list[str]:
    """Return the titles in the vectors of a spec whose examples have these."""
    crowd = Crowd("small", "host", "device")
    for number, title in enumerate(titles):
        crowd.command(f"Only{number}", [])
        crowd.data["messages"][f"Only{number}"]["examples"][0]["title"] = title
    valid = vectors_of(compiled_of(crowd.data))["valid"]
    return [each["title"] for each in valid if not each["title"].startswith("every value")]


# ------------------------------------------------------------------ text


ALL_AT_ONCE = "\n\n".join(INERT)
# In so many turns each text stands in many places; tests/world has all turns.
TURNS = [*range(0, len(INERT), 7), len(INERT)]


@pytest.mark.parametrize("turn", some(range(len(INERT) + 1), lambda turn: turn in TURNS))
def test_text_of_every_kind_is_inert_wherever_it_stands(turn: int) -> None:
    assert traits(hostile("greenhouse", turn)) == harmless("greenhouse")


def test_text_of_every_kind_is_inert_in_the_real_spec() -> None:
    assert traits(hostile("busservo", len(INERT))) == harmless("busservo")


def test_prose_stands_in_places_of_every_kind() -> None:
    places = {
        tuple(step for step in path if step in PROSE or step in _STRUCTURE)
        for path, text in texts(with_prose(SPECS["greenhouse"], HARMLESS))
        if HARMLESS in text
    }
    assert len(places) > 25


def test_the_vectors_have_the_titles_of_the_author() -> None:
    assert titles_of_vectors(INERT) == INERT


_STRUCTURE = words(
    "protocol sources endpoints link frame messages fields values notes examples reserved errata "
    "unknowns lookalikes history cite commands"
)


def _with(data: Data, texts: Mapping[Steps, str]) -> Data:
    """Return the spec with other texts in some places; a citation keeps its source."""

    def change(path: Steps, old: str) -> str:
        text = texts.get(path, old)
        kept = path[-1] == "cite" and path in texts
        return f"{old.partition(',')[0]}, {text}" if kept else text

    found: Data = changed(data, change)
    return found


@in_turn("unseen", lambda: UNSEEN, ids=ascii)
def test_text_that_nobody_can_see_is_a_finding_everywhere(unseen: str) -> None:
    data = SPECS["greenhouse"]
    some = [path for path, _ in texts(data) if is_prose(path)][::10]
    assert len(some) > 3
    for place in some:
        assert {*rules_broken(_with(data, {place: f"a{unseen}b"}))} <= UNUSABLE


# What no table above has thought of. A backslash and a quote are where it would go wrong.
TEXT = st.text(
    st.one_of(
        st.sampled_from("\"'\\>{}%# \n"),
        st.characters(exclude_categories=["Cs"]).filter(lambda c: not is_invisible(c)),
    ),
    min_size=1,
)


@given(TEXT)
def test_any_text_is_inert(text: str) -> None:
    assert traits(files_of(with_prose(SPECS["greenhouse"], text))) == harmless("greenhouse")
    assert titles_of_vectors([text]) == [text]


@given(st.text(st.characters(max_codepoint=0x10FFFF), min_size=1))
def test_any_text_at_all_is_inert_or_a_finding(text: str) -> None:
    data = _with(SPECS["greenhouse"], {("messages", "VentsOpen", "summary"): text})
    if any(map(is_invisible, text)):
        broken = {*rules_broken(data)}
        assert broken <= UNUSABLE
        assert broken
    else:
        assert traits(files_of(data)).keys() == harmless("greenhouse").keys()


def test_hostile_modules_stay_as_the_formatter_has_them(tmp_path: Path) -> None:
    ruff = Path(sys.executable).with_name("ruff")
    command = str(ruff) if ruff.exists() else which("ruff")
    if command is None:
        pytest.skip("ruff is not installed: `pip install --group lint`")
    # What is copied as it is, is the same in all of them.
    made = {
        (path, module): turn
        for turn in TURNS
        for path, module in python_of(hostile("greenhouse", turn)).items()
    }
    for (path, module), turn in made.items():
        write_files({path: module}, tmp_path / str(turn))
    options = ("--check", "--no-cache", "--config", ROOT / "pyproject.toml")
    ran(command, "format", *options, tmp_path)


# ------------------------------------------------------------------ what is not prose


def usable(data: Data) -> Compiled | None:
    """Compile a spec; None if anything is wrong with it."""
    if is_misfit(data):
        return None
    compiled = compiled_values(data)
    return None if compiled.findings else compiled


def test_what_is_no_prose_is_a_finding_or_inert() -> None:
    """Type, ids, formulas, citations, versions: each with text that belongs in none of them."""
    data = SPECS["greenhouse"]
    places = [path for path, _ in texts(data) if not is_prose(path)]
    assert len(places) > 90
    plain = python_of(files_of(data))
    for odd in (INERT, ['"""\nimport os\n']):
        inert = {
            place: text
            for place, text in zip(places, cycle(odd), strict=False)
            if usable(_with(data, {place: text})) is not None
        }
        assert len(places) > 2 * len(inert) > 0
        together = usable(_with(data, inert))
        assert together is not None
        for path, module in python_of(library_files(together)).items():
            assert imports(module) == imports(plain[path])


CODINGS = ["coding", "coding=utf-7", "coding: utf-7", "x coding"]


@in_turn("version", lambda: [*INERT[::7], *CODINGS, '1.0\nimport os; os.system("x")\n#'])
def test_a_hostile_version_is_a_finding(version: str) -> None:
    data: Data = {**SPECS["greenhouse"]}
    data["protocol"] = {**data["protocol"], "version": version}
    data["history"] = [{"version": version, "changes": ["It."]}]
    assert {*rules_broken(data)} & {"version", "unusable"}


FILE_NAMES = [
    *("a\nimport os\n.yaml", "coding: utf-7.yaml", "coding:utf-7", "# vim: fileencoding=latin-1"),
    *('"""', "ünïcode.yaml", "folder/../x\\y.yaml", f"spec/{'long' * 60}.yaml"),
]


@in_turn("name", lambda: FILE_NAMES)
def test_a_hostile_file_name_stays_in_its_comment(name: str) -> None:
    expected = python_of(files_of(SPECS["greenhouse"]))
    for path, module in python_of(files_of(SPECS["greenhouse"], name)).items():
        assert module.partition("\n")[2] == expected[path].partition("\n")[2]
        assert tokenize.detect_encoding(io.BytesIO(module.encode()).readline)[0] == "utf-8"
        first = module.partition("\n")[0]
        assert re.fullmatch(r"# Code generated by framegen from [ -~]+\. DO NOT EDIT\.", first)
        assert len(first) <= 100


def test_a_path_is_cut_where_a_line_of_code_would_not_hold_it() -> None:
    whole = banner("s" * 52)
    assert whole == f"Code generated by framegen from {'s' * 52}. DO NOT EDIT."
    assert len(f"# {whole}") == 100
    cut = banner(f"{'a' * 30}{'b' * 30}")
    assert cut == f"Code generated by framegen from {'a' * 23}...{'b' * 26}. DO NOT EDIT."
    assert len(cut) == len(whole)


# ------------------------------------------------------------------ names

NO_NAMES = [
    *("", " ", "a b", "a-b", "a.b", "a;b", 'a"b', "a'b", "a\nb", "a\\b", "1st", "_", "_private"),
    *("__init__", "__class__", "__import__('os')", "x = 1\nimport os", "{{ 7*7 }}", "{% endfor %}"),
    *("../evil", "/etc/passwd", "naïve", "\uff50rint", "ﬁeld", "vent_\u0456d", "\u210cost", "x²"),
    *("名", "a\u200bb"),
]
# A name of each kind in the demo spec.
NAMED = {
    "protocol": "greenhouse",
    "source": "manual",
    "endpoint": "station",
    "part of the frame": "preamble",
    "message": "StationRead",
    "element": "Vent",
    "field": "uptime_s",
    "count": "reading_count",
    "list": "readings",
    "field of an element": "vent_id",
    "named value": "at_once",
    "look-alike": "orchard",
}


@in_turn("kind", lambda: NAMED)
def test_what_is_no_plain_name_is_a_finding(kind: str) -> None:
    for name in NO_NAMES:
        data = renamed(SPECS["greenhouse"], NAMED[kind], name)
        assert usable(data) is None, name


# ------------------------------------------------------------------ the filters alone


@given(TEXT | st.text())
def test_a_literal_says_its_text_in_visible_characters(text: str) -> None:
    shown = literal(text)
    assert ast.literal_eval(shown) == text
    assert not any(map(is_invisible, shown))
    assert "\n" not in shown


@example("\"\n'\n\U00010000\\")
@given(TEXT)
def test_a_literal_in_several_lines_says_its_text(text: str) -> None:
    for said in (assigned(text * 9, "x", 4), f"x = f({Text(text * 9, 'y=').fitted(8, last=')')})"):
        [statement] = ast.parse(said).body
        assert isinstance(statement, ast.Assign)
        literal = next(node for node in ast.walk(statement.value) if isinstance(node, ast.Constant))
        assert literal.value == text * 9 or literal.value == text[:1]
        assert max(map(columns, said.split("\n"))) <= 100


@given(st.text(), st.sampled_from([0, 4, 8]))
def test_a_docstring_says_its_text_but_for_typography_and_prompts(text: str, indent: int) -> None:
    said = ast.literal_eval(docstring(["Plain.", text], indent, "No summary."))
    # Plain letters and digits are all that nothing is done to.
    assert re.findall("[a-zA-Z0-9]+", said)[1:] == re.findall(
        "[a-zA-Z0-9]+", text.translate(TYPOGRAPHY)
    )
    assert ">>>" not in said


@given(st.lists(st.text(), max_size=4), st.sampled_from([0, 4, 8]))
def test_a_docstring_is_one_string_behind_its_margin(blocks: list[str], indent: int) -> None:
    shown = docstring(blocks, indent, "No summary.", [">>> 1 + 1", "2"])
    said = ast.literal_eval(shown)
    assert [example.source for example in doctest.DocTestParser().get_examples(said)] == ["1 + 1\n"]
    first, *rest = shown.split("\n")
    assert first.startswith('"""')
    assert first.endswith(".")
    assert all(line == "" or line.startswith(" " * indent) for line in rest)
    assert shown.endswith('"""')


@in_turn(
    "text, said",
    lambda: [
        ('a "quoted" word', 'a "quoted" word'),
        ('"quoted"', '"quoted"'),
        ('"""', '""\\u0022'),
        ('x ""', 'x ""'),
        ("back\\slash", "back\\u005cslash"),
        ('\\"', '\\u005c"'),
        ("  folded \n  lines ", "folded lines"),
        (">>> x", "> > > x"),
        ("", ""),
        ("0\u20135 °C, 2\u00d73, \u2018so\u2019", "0-5 °C, 2x3, 'so'"),
        ("打开阀门\uff0c然后\uff08等\uff09。", "打开阀门,然后(等)。"),
        # One letter of a word is Cyrillic; all of a word; and a word that has nothing else.
        ("p\u0430y", "p\\u0430y"),
        ("открыть", "открыть"),
        ("\u0441", "\\u0441"),
        ("\U0001f600", "\\U0001f600"),
    ],
)
def test_prose_escapes_no_more_than_it_must(text: str, said: str) -> None:
    assert prose(text) == said


NO_SUMMARIES = [
    *("Is it open?", "Stop!", "Modes:", "Wait...", '"Quoted"', "This opens it.", "- Opens it"),
    *("Calls f(x)", "word " * 30, "x" * 95, ""),
]


@in_turn(
    "text, summary",
    lambda: [
        ("Opens it.", "Opens it."),
        ("Opens it", "Opens it."),
        ("opens it", "Opens it."),
        ("Opens it (fast)", "Opens it (fast)."),
        ('Opens "it"', 'Opens "it".'),
        ("vent_id of it", "vent_id of it."),
        ("50 %", "50 %."),
        ("°C", "°C."),
        ("Opens it. " + "Waits. " * 20, "Opens it. " + "Waits. " * 11 + "Waits."),
        ("Back\\", "Back\\."),
        # These can be no summary, and follow one that the generator has.
        *((text, "No summary.") for text in NO_SUMMARIES),
    ],
)
def test_a_summary_is_a_sentence_of_one_line(text: str, summary: str) -> None:
    said = ast.literal_eval(docstring([text], 0, "No summary.", function="f"))
    assert said.split("\n")[0] == summary
    assert re.sub(r"\W", "", text).lower() in re.sub(r"\W", "", said).lower()


def test_a_line_of_a_docstring_is_no_heading_of_a_section() -> None:
    text = docstring(
        ["Opens it.", "Returns:", "notes", "See also\n\n" + "x" * 99 + " args"], 4, "-"
    )
    headings = [line.strip() for line in text.split("\n")]
    assert {"Returns.", "notes.", "See also.", "args."} <= set(headings)


def test_a_docstring_breaks_its_lines_at_the_width() -> None:
    for word in ("word ", "漢字", "открыть "):
        text = docstring([word * 60, word * 30], 4, "No summary.")
        assert 85 < max(map(columns, (" " * 4 + text).split("\n"))) <= 100
        assert text.count("\n\n") == 2
    assert docstring([], 4, "So.") == docstring(["", " \n\n "], 4, "So.") == '"""So."""'


@given(st.text())
def test_a_banner_holds_nothing_that_a_language_reads(text: str) -> None:
    said = banner(text)
    assert not set(said) & set("<>*&\"'\\`:{}[]()!?#%$")
    assert said.isascii()
    assert said.isprintable()
    source = f"# {said}\n# {said}\nx = 1\n".encode()
    assert tokenize.detect_encoding(io.BytesIO(source).readline)[0] == "utf-8"


@pytest.mark.parametrize(
    "path", ["spec/busservo.yaml", "my spec-2.yaml", "spec/a.b/2024.1+rc_1.yaml"]
)
def test_an_ordinary_path_is_kept_in_a_banner(path: str) -> None:
    assert banner(path) == f"Code generated by framegen from {path}. DO NOT EDIT."
