"""Steps of workflows and actions, and hooks, as another machine runs them: with bash and git."""

import os
import re
import shutil
import sys
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest
from framegen.cli import main

from tests.factories import DEMO, ROOT
from tests.mutations.spec_edits import change as change_file
from tests.programs import ran
from tests.repository import commit, git, start
from tests.unit.comparison.test_automation import ACTION, HOOKS, read

GIT = shutil.which("git")
BASH = shutil.which("bash")
MILLISECONDS = {"under": "ramp_s", "replace": "unit: s", "with": "unit: ms"}

needs_bash = pytest.mark.skipif(
    os.name == "nt" or BASH is None or GIT is None, reason="there is no bash here, or no git"
)


def step(name: str) -> str:
    """Return what a step of the action runs."""
    steps = read(ACTION)["runs"]["steps"]
    return next(str(each["run"]) for each in steps if each.get("name") == name)


@pytest.fixture
def checkout(tmp_path: Path) -> Path:
    """Return a shallow clone of a project, as actions/checkout makes it: without its base."""
    project = tmp_path / "project"
    start(project)
    commit(project, {"spec/greenhouse.yaml": DEMO.read_text(encoding="utf-8")})
    git(project, "branch", "pull")
    origin = project.as_uri()
    git(tmp_path, "clone", "-q", "--depth=1", "--single-branch", "-b", "pull", origin, "clone")
    return tmp_path / "clone"


def change(checkout: Path) -> None:
    """Give a field of a checkout's spec another unit."""
    change_file(checkout / "spec" / "greenhouse.yaml", MILLISECONDS)


class Runner:
    """A machine on which steps of the action run, with a `gh` that has no network."""

    def __init__(self, folder: Path, checkout: Path) -> None:
        self.checkout = checkout
        self.temporary = folder / "runner"
        self.bin = self.temporary / "framegen-diff" / "bin"
        self.bin.mkdir(parents=True)
        self.summary = self.temporary / "summary.md"
        self.report = self.temporary / "framegen-diff.md"
        self.asked = self.temporary / "asked"
        self._program("framegen", f'exec "{sys.executable}" -m framegen "$@"')

    def _program(self, name: str, text: str) -> None:
        file = self.bin / name
        file.write_text(f"#!/usr/bin/env bash\n{text}\n", encoding="utf-8")
        file.chmod(0o755)

    def has_gh(self, *, comment: str, allowed: bool = True) -> None:
        """Have a `gh` that lists this comment as ours, and writes down what it is asked for."""
        listing = f'case "$*" in *--paginate*) echo "{comment}"; exit 0;; esac'
        self._program("gh", f'{listing}\necho "$*" >> "{self.asked}"\nexit {int(not allowed)}')

    def run(self, name: str, variables: Mapping[str, str]) -> tuple[int, str]:
        """Run a step as a runner does, and return its exit code and what it prints."""
        done = ran(
            *(BASH, "--noprofile", "--norc", "-eo", "pipefail", "-c", step(name)),
            cwd=self.checkout,
            status=None,
            environment={
                "PATH": f"{self.bin}{os.pathsep}{os.environ['PATH']}",
                "GITHUB_OUTPUT": str(self.temporary / "output"),
                "GITHUB_STEP_SUMMARY": str(self.summary),
                "GITHUB_REPOSITORY": "owner/name",
                "RUNNER_TEMP": str(self.temporary),
                **variables,
            },
        )
        return done.returncode, done.stdout + done.stderr

    def compare(self, **variables: str) -> tuple[int, str]:
        """Run the step that compares, with its inputs left out unless they are given."""
        return self.run("Compare", {"SPEC": "", "BASE": "", "FAIL_ON": "", **variables})

    def comment(self) -> tuple[int, str]:
        """Run the step that writes the comment, on pull request 7."""
        return self.run("Comment", {"PULL": "7", "REPORT": str(self.report), "GH_TOKEN": "none"})


@pytest.fixture
def runner(tmp_path: Path, checkout: Path) -> Runner:
    """Return a machine with a checkout."""
    return Runner(tmp_path, checkout)


@needs_bash
def test_a_pull_request_is_compared_with_its_base_branch(runner: Runner) -> None:
    change(runner.checkout)
    code, printed = runner.compare(GITHUB_BASE_REF="main")
    assert code == 1, printed
    assert re.search(r"^::error file=spec/greenhouse\.yaml,line=\d+", printed, re.MULTILINE)
    assert "VentsOpen" in runner.summary.read_text(encoding="utf-8")
    assert runner.report.read_text(encoding="utf-8") == runner.summary.read_text(encoding="utf-8")
    output = (runner.temporary / "output").read_text(encoding="utf-8")
    assert output == f"report={runner.report}\n"


def renamed(checkout: Path) -> None:
    change(checkout)
    git(checkout, "mv", "spec/greenhouse.yaml", "spec/kiln.yaml")


def gone(checkout: Path) -> None:
    git(checkout, "rm", "-q", "spec/greenhouse.yaml")


def joined_by_another(checkout: Path) -> None:
    shutil.copy(ROOT / "tests" / "specs" / "lamp.yaml", checkout / "spec" / "lamp.yaml")


def begun_anew(checkout: Path) -> None:
    """Have a base branch without a spec."""
    (checkout / "spec").rename(checkout / "specs")
    git(checkout, "rm", "-rq", "--cached", "spec")
    git(checkout, "commit", "-qm", "Begin anew")
    git(checkout, "push", "-q", "origin", "HEAD:refs/heads/empty")
    (checkout / "specs").rename(checkout / "spec")


def unchanged(_checkout: Path) -> None:
    """Do nothing."""


MAIN, PUSH = {"GITHUB_BASE_REF": "main"}, {"GITHUB_BASE_REF": ""}
HEAD = {"BASE": "HEAD", "SPEC": "spec/greenhouse.yaml", **PUSH}
NO_SPEC = "::error title=framegen diff::The checkout has no spec '{}'"
NOTHING = "::notice title=framegen diff::There is nothing to compare"
IN_KILN = "::error file=spec/kiln.yaml,line="
IS_GONE = "::error file=spec/greenhouse.yaml,title=greenhouse::spec/greenhouse.yaml is"
UNREAD = "::notice title=framegen diff::Nothing was compared"
# What becomes of a checkout, what is asked, the exit code, what is printed, what the report says.
COMPARED: dict[str, tuple[Callable[[Path], None], dict[str, str], int, str, str]] = {
    "it fails only where it is to": (change, {**HEAD, "FAIL_ON": "never"}, 0, "", "VentsOpen"),
    "what cannot be compared": (unchanged, {"BASE": "no-such-tag"}, 2, "no-such-tag", ""),
    **{
        f"no {spec} for {base}": (unchanged, {"SPEC": spec, **base}, 2, NO_SPEC.format(spec), "")
        for spec in ("spec/nope.yaml", "nope", "spec")
        for base in (MAIN, PUSH)
    },
    "named as for the command": (change, {"SPEC": "greenhouse", **MAIN}, 1, "", "VentsOpen"),
    "renamed": (renamed, MAIN, 1, IN_KILN, "VentsOpen"),
    "renamed and named": (renamed, {"SPEC": "kiln", **MAIN}, 1, IN_KILN, "VentsOpen"),
    "gone": (gone, MAIN, 1, IS_GONE, "everything of greenhouse breaks"),
    "a new one among others": (joined_by_another, {"SPEC": "lamp", **MAIN}, 0, NOTHING, ""),
    "the first": (begun_anew, {"GITHUB_BASE_REF": "empty"}, 0, NOTHING, ""),
    "a push without a release": (unchanged, PUSH, 0, UNREAD, ""),
}


@needs_bash
@pytest.mark.parametrize("name", COMPARED)
def test_a_checkout_is_compared(runner: Runner, name: str) -> None:
    done, asked, status, words, told = COMPARED[name]
    done(runner.checkout)
    code, printed = runner.compare(**asked)
    assert code == status, printed
    assert words in printed
    if told:
        assert told in runner.report.read_text(encoding="utf-8")
    else:
        assert not runner.report.exists()
        assert not runner.summary.exists()
    assert words != NOTHING or printed.count("\n") == 1


@needs_bash
@pytest.mark.parametrize("spec", ["", "greenhouse", "spec/greenhouse.yaml"])
def test_a_push_is_compared_with_what_was_released(runner: Runner, spec: str) -> None:
    released = runner.checkout / "spec" / "released" / "greenhouse-1.0.0.yaml"
    released.parent.mkdir()
    shutil.copy(runner.checkout / "spec" / "greenhouse.yaml", released)
    code, printed = runner.compare(SPEC=spec, GITHUB_BASE_REF="")
    assert (code, "::notice" in printed) == (0, False), printed
    assert runner.report.exists()
    released.unlink()
    # A spec that differs from the last commit is compared with that.
    change(runner.checkout)
    code, printed = runner.compare(SPEC=spec, GITHUB_BASE_REF="")
    assert (code, "::notice" in printed) == (1, False), printed


COMMENTS = [
    ("", "api --silent --method POST repos/owner/name/issues/7/comments -F body=@"),
    ("41", "api --silent --method PATCH repos/owner/name/issues/comments/41 -F body=@"),
]


@needs_bash
@pytest.mark.parametrize(("ours", "asked"), COMMENTS, ids=["the first", "written anew"])
def test_the_report_is_one_comment(runner: Runner, ours: str, asked: str) -> None:
    runner.report.write_text("What breaks.\n", encoding="utf-8")
    runner.has_gh(comment=ours)
    assert runner.comment() == (0, "")
    body = runner.temporary / "framegen-comment.md"
    assert runner.asked.read_text(encoding="utf-8") == f"{asked}{body}\n"
    assert body.read_text(encoding="utf-8") == "<!-- framegen diff -->\nWhat breaks.\n"


@needs_bash
def test_where_nothing_changed_there_is_no_comment(
    runner: Runner, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(runner.checkout)
    assert main(["diff", "HEAD", "--format", "markdown"]) == 0
    runner.report.write_text(capsys.readouterr().out, encoding="utf-8")
    runner.has_gh(comment="")
    assert runner.comment() == (0, "")
    assert not runner.asked.exists()
    runner.has_gh(comment="41")
    assert runner.comment() == (0, "")
    assert "comments/41" in runner.asked.read_text(encoding="utf-8")


@needs_bash
def test_a_long_report_is_cut_and_without_one_there_is_no_comment(runner: Runner) -> None:
    runner.has_gh(comment="")
    assert runner.comment() == (0, "")
    assert not runner.asked.exists()
    runner.report.write_text("x" * 70_000, encoding="utf-8")
    assert runner.comment() == (0, "")
    body = (runner.temporary / "framegen-comment.md").read_text(encoding="utf-8")
    assert 60_000 < len(body) < 65_536
    assert body.endswith("The rest is in the summary of the run.\n")


@needs_bash
def test_a_run_that_may_not_comment_says_where_the_report_is(runner: Runner) -> None:
    runner.report.write_text("What breaks.\n", encoding="utf-8")
    runner.has_gh(comment="", allowed=False)
    code, printed = runner.comment()
    assert code == 0
    assert printed.startswith("::notice title=framegen diff::The report is in the summary")


@needs_bash
def test_each_hook_does_its_work(
    checkout: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.chdir(checkout)
    spec = "spec/greenhouse.yaml"
    for hook in read(HOOKS):
        _, *words = hook["entry"].split()
        files = [spec] if hook.get("pass_filenames", True) else []
        assert main([*words, *files]) == 0, capsys.readouterr().err
    change(checkout)
    assert main(["diff"]) == 1
    assert "VentsOpen" in capsys.readouterr().out
