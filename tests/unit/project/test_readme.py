"""Our pages are true: their commands work, their output is right, their links lead somewhere."""

import doctest
import os
import re
from functools import cache
from pathlib import Path

import pytest
from busservo._command import PROGRAM as BUSSERVO
from framegen.cli import VERBS as FRAMEGEN
from framegen.site.guides.markdown import slugs
from lxservo._command import PROGRAM as LXSERVO

from tests.documents import PAGES, ROOT, copy_project, played, refresh
from tests.in_turn import in_turn

MAKEFILE = (ROOT / "Makefile").read_text(encoding="utf-8")
TARGETS = set(re.findall(r"^([a-z-]+):.*## ", MAKEFILE, flags=re.MULTILINE))


# Played in tests/world: with git, with processes, or with boards in real time.
TAKE_TIME = {
    *("README.md", "docs/README.md", "docs/captures.md", "docs/changing-the-protocol.md"),
    *("docs/command.md", "docs/getting-started.md", "docs/lx16a.md", "docs/talk-to-the-board.md"),
    "docs/troubleshooting.md",
}
QUICK = [page for page in PAGES if page.relative_to(ROOT).as_posix() not in TAKE_TIME]


@pytest.mark.parametrize("page", QUICK, ids=lambda page: page.stem)
def test_examples_print_what_the_page_says(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    truth = played(text, copy_project(tmp_path, text))
    assert truth == text, "if this was meant to change: python -m tests.documents"


@in_turn("page", lambda: PAGES)
def test_programs_can_be_read_and_commands_are_known(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    for program in re.findall(r"^```python\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        compile(program, page.name, "exec")
    for session in re.findall(r"^```pycon\n(.*?)^```$", text, re.MULTILINE | re.DOTALL):
        for example in doctest.DocTestParser().get_examples(session):
            compile(example.source, page.name, "single")
    verbs = {"busservo": BUSSERVO.verbs, "lxservo": LXSERVO.verbs, "framegen": FRAMEGEN}
    commands = r"^\$ (busservo|framegen|lxservo) ([a-z][a-z-]+)"
    for name, verb in re.findall(commands, text, re.MULTILINE):
        assert verb in verbs[name], f"{name} {verb}"


@in_turn("page", lambda: PAGES)
def test_links_to_a_heading_lead_to_one(page: Path) -> None:
    lost = []
    text = page.read_text(encoding="utf-8")
    for link, anchor in re.findall(r"\]\(([^)#:]*\.md)?#([^)]+)\)", text):
        if anchor not in anchors_of(page.parent / link if link else page):
            lost.append(f"{link}#{anchor}")
    assert lost == []


@cache
def anchors_of(page: Path) -> set[str]:
    return {*slugs(re.findall(r"^#+ (.+)$", page.read_text(encoding="utf-8"), re.MULTILINE))}


@in_turn("page", lambda: PAGES)
def test_links_files_and_commands_of_make_exist(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    # The links of Markdown that a page shows are those of another project.
    own = re.sub(r"^```markdown\n.*?^```$", "", text, flags=re.MULTILINE | re.DOTALL)
    links = [link for link in re.findall(r"\]\(([^)#]+)", own) if "://" not in link]
    assert [link for link in links if not (page.parent / link).exists()] == []
    # What a page names in code, without a link.
    named = re.findall(r"`((?:spec|codegen|generated|docs|tests|benchmarks)/[\w./-]*)`", text)
    assert [name for name in named if not (ROOT / name).exists()] == []
    made = re.findall(r"(?:^ *|`)make ([a-z]+)", text, flags=re.MULTILINE)
    assert set(made) <= TARGETS


def test_a_session_that_lies_is_found_out(tmp_path: Path) -> None:
    page = "```pycon\n>>> for i in range(2):\n...     print(i)\n0\n2\n>>> 1 / 0\n```\n"
    assert played(page, tmp_path) == (
        "```pycon\n>>> for i in range(2):\n...     print(i)\n0\n1\n>>> 1 / 0\n"
        "Traceback (most recent call last):\n  ...\nZeroDivisionError: division by zero\n```\n"
    )


def test_a_slow_program_is_run_only_where_that_is_asked_for(tmp_path: Path) -> None:
    page = "```python slow\nprint(1)\n```\n\n```output slow\n2\n```\n"
    assert played(page, tmp_path) == page
    assert played(page, tmp_path, slow=True) == page.replace("2", "1")


def test_a_program_that_starts_processes_is_one_of_its_own(tmp_path: Path) -> None:
    program = 'import os\nhere = os.getpid()\nif __name__ == "__main__":\n    print(here)\n'
    page = f"```python\n{program}```\n\n```output\nno number\n```\n"
    _, _, shown = played(page, tmp_path).partition("```output\n")
    assert int(shown.removesuffix("\n```\n")) != os.getpid()


def test_a_program_that_needs_what_stands_above_it_is_found_out(tmp_path: Path) -> None:
    with pytest.raises(NameError, match="'one'"):
        played("```python\none = 1\n```\n\n```python\none\n```\n", tmp_path)
    page = "```pycon\n>>> one = 1\n```\n\n```pycon\n>>> one\n1\n```\n"
    assert "NameError: name 'one' is not defined" in played(page, tmp_path)


def test_a_program_that_is_named_is_saved_and_run_by_its_name(tmp_path: Path) -> None:
    page = "```python\n# one.py\nprint(1)\n```\n\n```console\n$ python one.py\n2\n```\n"
    assert played(page, tmp_path) == page.replace("2", "1")


def test_a_page_has_one_board_whose_motions_are_over_when_a_block_begins(tmp_path: Path) -> None:
    send = "$ busservo send --port COM5"
    page = (
        f"```console\n{send} ServoMove time_ms=2000 targets=1:700\n```\n"
        f"```console\n{send} ServoPositionsRead servo_ids=1\n...\n```\n"
        f"```console\n{send} ServoPositionsRead servo_ids=1\nnothing\n```\n"
    )
    assert "positions=1:700 |" in played(page, tmp_path)


def test_left_out_lines_may_be_anything_but_the_rest_may_not(tmp_path: Path) -> None:
    page = "```console\n$ framegen rules\n...\nreply  {}\n...\n```\n"
    title = "Replies and reports are messages of the other direction"
    shown = played(page.format(title), tmp_path)
    (line,) = re.findall("^reply .*$", shown, re.MULTILINE)
    truth = page.replace("reply  {}", line)
    assert played(truth, tmp_path) == truth
    assert played(truth.replace("other", "same"), tmp_path) == shown


def test_a_page_that_changes_what_is_gone_is_named_and_the_others_are_written(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    stale, wrong = tmp_path / "stale.md", tmp_path / "wrong.md"
    file = "codegen/framegen/language/number_types.py"
    monkeypatch.setattr("tests.documents._CHANGED", (file,))
    stale.write_text(f"```diff\n--- {file}\n+++ {file}\n@@\n-no such line\n+another\n```\n")
    wrong.write_text("```console\n$ busservo encode ActionGroupStop\n55 55 02 08\n```\n")
    assert refresh([stale, wrong]) == 1
    assert "55 55 02 07" in wrong.read_text()
    assert capsys.readouterr() == (
        "wrote wrong.md\n",
        f"mend the diff in stale.md by hand: {file} holds 0 times:\nno such line\n\n",
    )
