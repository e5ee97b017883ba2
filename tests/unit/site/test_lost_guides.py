"""What a guide shows and links to is on its page, or is told with its place."""

import posixpath
import re
import shutil
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import NamedTuple
from urllib.parse import unquote

import pytest
from framegen.cli import main
from framegen.site.guides.guide import page_of as site_path
from framegen.site.guides.links import is_elsewhere

from tests.commands import called
from tests.factories import write_files
from tests.in_turn import in_turn
from tests.unit.site.reference import LAMP, Page

PLAN = """# Lamps

All of them.

## Learn

How to begin.

- [First](first.md): from nothing.
- [Deep](sub/deep.md)

## Look up

- [The lamp](reference/stage_lamp/README.md): each of its frames.
- [Rules](../RULES.md)
"""
# The files of a project, beside the guides.
FILES = (
    *("docs/images/a.svg", "docs/images/more/b.svg", "docs/figures/c d.svg", "docs/data/e.csv"),
    *("assets/f.png", "captures/g.hex", "LICENSE", "unlisted.md", "docs/.h/i.png", ".j/k.csv"),
    *("docs/reference/stage_lamp/README.md", "docs/sub/README.md"),
)
# What is linked to, by its path in the project, and whether that leads somewhere.
THERE = """
docs/first.md docs/first.md#a-part docs/sub docs/sub/deep.md docs/sub/deep.md#gr%C3%B6%C3%9Fe
docs/reference/stage_lamp/README.md docs/reference/stage_lamp/README.md#frames RULES.md#one
docs/reference/stage_lamp/README.md#workbench captures/g.hex spec/lamp.yaml RULES.md LICENSE
docs/reference/stage_lamp/messages/ColourShow.md docs/data/e.csv
"""
GONE = """
docs/first.md#a-prat docs/FIRST.md docs/none.md docs/reference/stage_lamp/README.md#nowhere
docs/reference/stage_lamp/messages/ColourHide.md docs/reference/other/README.md spec/other.yaml
RULES.md#two unlisted.md .j/k.csv ../beyond.txt captures .
"""
LINKS = dict.fromkeys(THERE.split(), True) | dict.fromkeys(GONE.split(), False)
SHOWN = "docs/images/a.svg docs/images/more/b.svg docs/figures/c%20d.svg assets/f.png"
LOST = "docs/images/none.svg assets/none.png docs/.h/i.png docs/first.md"
PICTURES = dict.fromkeys(SHOWN.split(), True) | dict.fromkeys(LOST.split(), False)
# The same in any guide: what is written, and whether it is kept.
ANYWHERE = {
    "[{}](#here)": True,
    "[{}](#there)": False,
    "[{}](https://example.org/none.html#x)": True,
    "[{}](//example.org/)": True,
    "[{}](HTTPS://example.org/)": True,
    "[{}](mailto:a@example.org)": True,
    "![{}](https://example.org/a.png)": False,
    "![{}](data:image/png;base64,iVBORw0KGgo=)": True,
    '<img src="images/a.svg" alt="{}">': False,
    '<a href="first.md">{}</a>': False,
    '<A HREF="first.md">{}</A>': False,
    "`<img src=no.png>`, `[no](none.md)` and [{}](#here)": True,
    "a < b, [{}](#here) and c > d": True,
    "[![{}](https://example.org/a.png)](#here)": False,
}
# How a link is written: on one line, at the end of a paragraph, in a table, a list or a quotation,
# and with its target elsewhere.
FORMS = {
    "[{words}]({target})": (0, 0),
    "[{words}](<{target}>)": (0, 0),
    "Words\nand *more*\nof them [{words}]({target} 'a title').": (2, 8),
    "| a | b |\n|---|---|\n| c | [{words}]({target}) |": (2, 6),
    "- one\n\n  1. [two](#here)\n     [{words}]({target})": (3, 5),
    "> words\n> [{words}][{words}]\n\n[{words}]: {target}": (1, 2),
}


class Case(NamedTuple):
    """Something in a guide: the words by which it is found, its place, and whether it is kept."""

    words: str
    line: int
    column: int
    kept: bool


def cases(guide: str, lines: list[str]) -> Iterator[Case]:
    """Write all there is into a guide, and yield what is due for each."""
    folder = posixpath.dirname(posixpath.join("docs", guide))
    for mark, table in (("", LINKS), ("!", PICTURES)):
        for target, kept in table.items():
            path, _, anchor = target.partition("#")
            relative = posixpath.relpath(f"/root/{path}", f"/root/{folder}")
            for form, (down, right) in FORMS.items():
                words = f"w{len(lines)}x"
                yield Case(words, len(lines) + 1 + down, right + 1, kept)
                text = form.replace("[{words}](", f"{mark}[{{words}}](", 1)
                text = text.replace("[{words}][", f"{mark}[{{words}}][", 1)
                whole = f"{relative}#{anchor}" if anchor else relative
                lines += [*text.format(words=words, target=whole).split("\n"), ""]
    for form, kept in ANYWHERE.items():
        words = f"w{len(lines)}x"
        yield Case(words, len(lines) + 1, 1 + max(form.find("[{}](#"), form.find("![{}]"), 0), kept)
        lines += [form.format(words), ""]


# Guides of each place that has some, and what they begin with.
GUIDES = {
    "first.md": "# First\n\n## A part\n\n## Here\n",
    "sub/deep.md": "# Deep\n\n## Größe\n\n## Here\n",
    "../RULES.md": "# Rules\n\n## One\n\n## Here\n",
}


def written(root: Path, readme: str, guides: dict[str, str] = GUIDES) -> Path:
    """Write a project anew, with a guide from each of the places where guides are."""
    shutil.rmtree(root, ignore_errors=True)
    write_files(dict.fromkeys([*FILES, "../beyond.txt"], "x\n"), root)
    write_files({"spec/lamp.yaml": LAMP.read_text("utf-8"), "docs/README.md": readme}, root)
    write_files({f"docs/{name}": text for name, text in guides.items()}, root)
    return root


def build(root: Path, *words: str) -> tuple[int, str]:
    """Build the site of a project beside it; return the status, and what is said."""
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(root)
        status, out, err = called(main, "docs", "--out", "../site", *words)
    return status, err + out


class Built(NamedTuple):
    """The cases of each guide, the site that was built, and the places that were told."""

    due: dict[str, list[Case]]
    site: Path
    told: dict[str, set[tuple[int, int]]]


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Built:
    root = tmp_path_factory.mktemp("lost") / "root"
    lines = {guide: text.split("\n") for guide, text in GUIDES.items()}
    due = {guide: [*cases(guide, lines[guide])] for guide in GUIDES}
    written(root, PLAN, {guide: "\n".join(lines[guide]) for guide in GUIDES})
    status, said = build(root)
    assert status == 0, said
    places = re.findall(r"^(\S+):(\d+):(\d+): guide-\w+: \S", said, re.MULTILINE)
    told: dict[str, set[tuple[int, int]]] = {}
    for file, line, column in places:
        guide = posixpath.relpath(f"/{file}", "/docs")
        told.setdefault(guide, set()).add((int(line), int(column)))
    assert said.count("\n   = hint: ") + said.count("\n    = hint: ") >= len(places)
    return Built(due, root.parent / "site", told)


@in_turn("guide", lambda: GUIDES)
def test_what_is_not_on_the_page_is_told_and_nothing_else(built: Built, guide: str) -> None:
    expected = {(case.line, case.column) for case in built.due[guide] if not case.kept}
    assert built.told[guide] == expected
    assert built.told.keys() == GUIDES.keys()


def page_of(site: Path, path: str) -> Page:
    return Page(path, (site / path).read_text("utf-8"))


page_in = cache(page_of)


@in_turn("guide", lambda: GUIDES)
def test_what_is_not_told_is_on_the_page(built: Built, guide: str) -> None:
    page = page_in(built.site, site_path(guide))
    for case in built.due[guide]:
        if (case.line, case.column) in built.told[guide]:
            continue
        element = rf'<(?:a href|img src)="([^"]*)"[^>]*?(?:>| alt="){case.words}\b'
        found = re.search(element, page.text)
        assert found is not None, case
        if is_elsewhere(found[1]):
            continue
        where, anchor = page.leads_to(found[1])
        file = built.site / unquote(where)
        assert file.is_file(), case
        if anchor:
            assert unquote(anchor) in page_in(built.site, where).ids, case


# What stands in the README below a list of guides, and how the finding about it goes on after the
# column; nothing where nothing gets lost.
PLANS = {
    "- [Elsewhere](https://example.org/): no guide": "3: guide-plan: `https://example.org/` is not",
    "- [Message](reference/stage_lamp/messages/ColourShow.md)": "3: guide-plan: `reference/stage_",
    "- [Gone](gone.md): a guide": "3: guide-link: `gone.md` is no page",
    "- [First](first.md#here)": "3: guide-plan: `first.md#here` is not",
    "- [First again](first.md)": "3: guide-plan: `first.md` is not",
    "- [More](./sub/README.md), and [that](sub/deep.md)": "32: guide-plan: `sub/deep.md` is not",
    "- [More](sub/README.md), ![a](images/a.svg)": "26: guide-plan: `images/a.svg` is not",
    "- Words without a link": "1: guide-plan: this is on no page",
    "\nAnd then.": "1: guide-plan: this is on no page",
    "\n```sh\nls\n```": "1: guide-plan: this is on no page",
    "\n### Below": "1: guide-plan: this is on no page",
    "\n## More\n\n- [Elsewhere](https://example.org/)\n- words\n\n```sh\nls\n```\n": "",
    "\n## Learn\n\nAs [above](first.md): ![a](images/a.svg)\n": "",
}


@in_turn("text", lambda: PLANS)
def test_what_of_the_plan_is_on_no_page_is_told(tmp_path: Path, text: str) -> None:
    status, said = build(written(tmp_path / "root", f"{PLAN}{text}\n"))
    assert status == 0
    line = PLAN.count("\n") + 1 + (len(text) - len(text.lstrip("\n")))
    places = re.findall(r"^docs/README\.md:.*", said, re.MULTILINE)
    assert len(places) == bool(PLANS[text]), said
    assert all(each.startswith(f"docs/README.md:{line}:{PLANS[text]}") for each in places), said
    home = page_of(tmp_path / "site", "index.html")
    if not places:
        assert {*re.findall(r"\]\(([^)]*)\)", text)} - {"first.md"} <= {*home.links, *home.loads}


@in_turn(
    "readme, title",
    lambda: [
        ("Only words.\n", "Guides"),
        ("## Learn\n\n- [First](first.md)\n", "Guides"),
        ("Lamps\n=====\n\nAll of them.\n", "Lamps"),
        ("Above.\n\n# Lamps\n\nAll of them.\n", "Lamps"),
    ],
)
def test_a_readme_has_its_title_anywhere(tmp_path: Path, readme: str, title: str) -> None:
    assert build(written(tmp_path / "root", readme))[0] == 0
    home = page_of(tmp_path / "site", "index.html")
    assert f"<title>{title}</title>" in home.text
    assert home.lacks(re.findall(r"^\w.*\.$", readme, re.MULTILINE)) == []
    assert "====" not in home.words


def test_what_is_lost_is_an_error_if_that_is_wanted(tmp_path: Path) -> None:
    root = written(tmp_path / "root", PLAN)
    status, said = build(root, "--strict")
    assert status == 0
    assert said.endswith(f"{Path('../site/index.html')}\n")
    assert "finding" not in said
    shutil.rmtree(tmp_path / "site")
    (root / "docs" / "first.md").write_text("# First\n\n![A lamp](lamp.png)\n", encoding="utf-8")
    expected = """docs/first.md:3:1: guide-picture: `lamp.png` is no picture of the project
3 | ![A lamp](lamp.png)
  | ^
  = hint: correct the path, or write it as code

1 finding in the guides: """
    assert build(root, "--strict") == (1, f"{expected}nothing was written\n")
    assert not (tmp_path / "site").exists()
    status, said = build(root)
    assert status == 0
    assert said.startswith(f"{expected}`--strict` makes it an error\n")
    assert (tmp_path / "site" / "first.html").is_file()


def test_nothing_is_left_behind_where_nothing_was_written(tmp_path: Path) -> None:
    root = written(tmp_path / "root", PLAN, GUIDES | {"first.md": "[a](b)\n"})
    before = {*tmp_path.iterdir()}
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(root)
        patch.setattr("tempfile.tempdir", str(tmp_path))
        assert main(["docs", "--strict"]) == 1
    assert {*tmp_path.iterdir()} == before
