"""Style, scripts and templates of the site: nothing is left over, and nothing is missing."""

import re
from functools import cache

from framegen.comparison.report.verdict import STANDINGS

from tests.in_turn import in_turn
from tests.unit.site.editions import three
from tests.unit.site.reference import ROOT

FRAMEGEN = ROOT / "codegen" / "framegen"
SITE = FRAMEGEN / "site"
STYLE = "\n".join(file.read_text("utf-8") for file in sorted(SITE.glob("static/css/*.css")))
SCRIPTS = {file.stem: file.read_text("utf-8") for file in sorted(SITE.glob("static/js/*.js"))}
TEMPLATES = {
    file.name: file.read_text("utf-8") for file in sorted(SITE.glob("templates/*.html.jinja"))
}
# What makes HTML in Python: the site, and the views of the reference.
VIEWS = {
    file.as_posix(): file.read_text("utf-8")
    for folder in (SITE, FRAMEGEN / "targets" / "docs")
    for file in folder.rglob("*.py")
}
# What else ends up as a class: words of a report, and alignment as Markdown has it.
ELSEWHERE = {*STANDINGS, "center", "right", "level-2", "level-3"}


def classes_of(style: str) -> set[str]:
    """Return the classes that selectors name."""
    plain = re.sub(r"/\*.*?\*/", "", style, flags=re.DOTALL)
    return set(re.findall(r"\.([a-zA-Z][\w-]*)", re.sub(r"\{[^{}]*\}", "{}", plain)))


def classes_in(html: str) -> set[str]:
    """Return the classes that elements of a template have, but for those that it works out."""
    given = re.findall(r'class="([^"]*)"', html)
    plain = [re.sub(r"\S*\{\{.*?\}\}\S*", " ", re.sub(r"\{%.*?%\}", " ", text)) for text in given]
    return {name for text in plain for name in text.split()}


@cache
def words() -> frozenset[str]:
    """Return every word in templates, scripts and views."""
    sources = [*SCRIPTS.values(), *TEMPLATES.values(), *VIEWS.values()]
    return frozenset(word for text in sources for word in re.findall(r"[a-zA-Z][\w-]*", text))


def test_every_class_of_the_style_is_one_that_pages_have() -> None:
    assert sorted(classes_of(STYLE) - words() - ELSEWHERE) == []


def test_every_class_of_a_template_is_one_that_the_style_or_a_script_knows() -> None:
    known = {*re.findall(r"\.([a-zA-Z][\w-]*)", "\n".join(SCRIPTS.values())), *classes_of(STYLE)}
    unknown = {name: classes_in(text) - known for name, text in TEMPLATES.items()}
    assert {name: found for name, found in unknown.items() if found} == {}


def test_classes_are_found_wherever_they_stand() -> None:
    style = ".a > b.c-d:not(.e) { x: 1.5em } @media (p) { .f { y: 2 } } /* .g */"
    assert classes_of(style) == {"a", "c-d", "e", "f"}
    html = '<p class="a {{ b }} c"><i class="{% if d %}e{% endif %} f">'
    assert classes_in(html) == {"a", "c", "e", "f"}
    assert classes_in('<p class="a-{{ b }} {{ c }} d">') == {"d"}


def test_every_template_is_part_of_a_page() -> None:
    named = re.findall(r'(?:extends|include|from|import) "([^"]*)"', "\n".join(TEMPLATES.values()))
    rendered = {page.template for page in three().site.pages} | {"404", "guide"}
    assert sorted(TEMPLATES.keys() - set(named) - {f"{each}.html.jinja" for each in rendered}) == []


def declared(script: str) -> list[str]:
    """Return the names that a script gives to all others of its page."""
    found = re.findall(r"^(?:async )?(?:function\*?|class) (\w+)", script, re.MULTILINE)
    for names in re.findall(r"^(?:const|let) (.*?);$", script, re.MULTILINE | re.DOTALL):
        plain = re.sub(r"\((?:[^()]|\([^()]*\))*\)|\{[^{}]*\}|\[[^\[\]]*\]", "", names)
        found += re.findall(r"(?:^|, )(\w+) =", plain.partition("\n")[0])
    return found


def test_no_two_scripts_give_the_same_name() -> None:
    owners: dict[str, list[str]] = {}
    for name, script in SCRIPTS.items():
        for given in declared(script):
            owners.setdefault(given, []).append(name)
    assert {given: names for given, names in owners.items() if len(names) > 1} == {}
    assert owners["makeCodec"] == ["codec"]
    assert owners["DETAIL_MORE"] == ["workbench_detail"]


@in_turn("name", lambda: SCRIPTS)
def test_a_script_says_what_it_is_and_is_strict(name: str) -> None:
    assert re.match(r'(?://.*\n)+"use strict";\n', SCRIPTS[name])


def test_every_script_is_part_of_a_page() -> None:
    shown = "\n".join(VIEWS.values())
    assert [name for name in SCRIPTS if f'"{name}"' not in shown] == []
