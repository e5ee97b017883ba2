"""Our pages are true: their commands work, their output is right, their links lead somewhere."""

import doctest
import os
import re
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
        other = page.parent / link if link else page
        headings = re.findall(r"^#+ (.+)$", other.read_text(encoding="utf-8"), re.MULTILINE)
        if anchor not in {*slugs(headings)}:
            lost.append(f"{link}#{anchor}")
    assert lost == []


@in_turn("page", lambda: PAGES)
def test_links_lead_somewhere(page: Path) -> None:
    # The links of Markdown that a page shows are those of another project.
    text = re.sub(
        r"^```markdown\n.*?^```$",
        "",
        page.read_text(encoding="utf-8"),
        flags=re.MULTILINE | re.DOTALL,
    )
    links = re.findall(r"\]\(([^)#]+)", text)
    missing = [link for link in links if "://" not in link and not (page.parent / link).exists()]
    assert missing == []


@in_turn("page", lambda: PAGES)
def test_commands_of_make_exist(page: Path) -> None:
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"(?:^ *|`)make ([a-z]+)", text, flags=re.MULTILINE)
    assert set(named) <= TARGETS


@in_turn("page", lambda: PAGES)
def test_code_has_a_place(page: Path) -> None:
    """File that a page names in code, without linking to them."""
    text = page.read_text(encoding="utf-8")
    named = re.findall(r"`((?:spec|codegen|generated|docs|tests|benchmarks)/[\w./-]*)`", text)
    assert [name for name in named if not (ROOT / name).exists()] == []


def test_a_page_that_lies_is_found_out(tmp_path: Path) -> None:
    page = "```console\n$ busservo encode ActionGroupStop\n55 55 02 08\n```\n"
    truth = page.replace("08", "07")
    assert played(page, tmp_path) == truth
    assert played(truth, tmp_path) == truth


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


@pytest.mark.parametrize("kind", ["python", "pycon"])
def test_a_program_that_needs_what_stands_above_it_is_found_out(tmp_path: Path, kind: str) -> None:
    first, then = ("one = 1\n", "one\n") if kind == "python" else (">>> one = 1\n", ">>> one\n1\n")
    page = f"```{kind}\n{first}```\n\n```{kind}\n{then}```\n"
    if kind == "python":
        with pytest.raises(NameError, match="'one'"):
            played(page, tmp_path)
    else:
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
    line = next(line for line in shown.splitlines() if line.startswith("reply"))
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
