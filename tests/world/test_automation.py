"""Steps of workflows and actions, and hooks, as another machine runs them: with bash and git."""

import os
import re
import shutil
import sys
from collections.abc import Mapping
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


@needs_bash
def test_what_breaks_fails_only_where_it_is_asked_to(runner: Runner) -> None:
    change(runner.checkout)
    code, printed = runner.compare(
        BASE="HEAD", SPEC="spec/greenhouse.yaml", FAIL_ON="never", GITHUB_BASE_REF=""
    )
    assert code == 0, printed
    assert "VentsOpen" in runner.summary.read_text(encoding="utf-8")


@needs_bash
def test_what_cannot_be_compared_is_an_error_without_a_report(runner: Runner) -> None:
    code, printed = runner.compare(BASE="no-such-tag")
    assert code == 2
    assert "no-such-tag" in printed
    assert not runner.summary.exists()


@needs_bash
@pytest.mark.parametrize("base", ["", "main"], ids=["push", "pull request"])
def test_a_spec_that_is_not_in_the_checkout_is_an_error(runner: Runner, base: str) -> None:
    for spec in ("spec/nope.yaml", "nope", "spec"):
        code, printed = runner.compare(SPEC=spec, GITHUB_BASE_REF=base)
        assert code == 2
        assert f"::error title=framegen diff::The checkout has no spec '{spec}'" in printed
    assert not runner.report.exists()


@needs_bash
def test_a_spec_is_named_as_on_the_command_line(runner: Runner) -> None:
    change(runner.checkout)
    code, printed = runner.compare(SPEC="greenhouse", GITHUB_BASE_REF="main")
    assert code == 1, printed
    assert "VentsOpen" in runner.report.read_text(encoding="utf-8")


@needs_bash
@pytest.mark.parametrize("spec", ["", "kiln"])
def test_a_renamed_spec_is_compared_with_what_it_was(runner: Runner, spec: str) -> None:
    change(runner.checkout)
    git(runner.checkout, "mv", "spec/greenhouse.yaml", "spec/kiln.yaml")
    code, printed = runner.compare(SPEC=spec, GITHUB_BASE_REF="main")
    assert code == 1, printed
    assert "::error file=spec/kiln.yaml,line=" in printed


@needs_bash
def test_a_spec_that_is_gone_is_told(runner: Runner) -> None:
    git(runner.checkout, "rm", "-q", "spec/greenhouse.yaml")
    code, printed = runner.compare(GITHUB_BASE_REF="main")
    assert code == 1, printed
    assert "::error file=spec/greenhouse.yaml,title=greenhouse::spec/greenhouse.yaml is" in printed
    assert "everything of greenhouse breaks" in runner.summary.read_text(encoding="utf-8")


@needs_bash
def test_a_new_spec_among_others_has_nothing_to_be_compared_with(runner: Runner) -> None:
    lamp = ROOT / "tests" / "specs" / "lamp.yaml"
    shutil.copy(lamp, runner.checkout / "spec" / "lamp.yaml")
    code, printed = runner.compare(SPEC="lamp", GITHUB_BASE_REF="main")
    assert (code, printed.count("\n")) == (0, 1), printed
    assert "::notice title=framegen diff::There is nothing to compare" in printed


@needs_bash
def test_a_push_without_a_release_says_that_nothing_was_compared(runner: Runner) -> None:
    code, printed = runner.compare(GITHUB_BASE_REF="")
    assert code == 0, printed
    assert "::notice title=framegen diff::Nothing was compared" in printed
    assert not runner.report.exists()
    assert not runner.summary.exists()


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


@needs_bash
def test_the_first_spec_is_compared_with_nothing(runner: Runner) -> None:
    (runner.checkout / "spec").rename(runner.checkout / "specs")
    git(runner.checkout, "rm", "-rq", "--cached", "spec")
    git(runner.checkout, "commit", "-qm", "Begin anew")
    git(runner.checkout, "push", "-q", "origin", "HEAD:refs/heads/empty")
    (runner.checkout / "specs").rename(runner.checkout / "spec")
    code, printed = runner.compare(GITHUB_BASE_REF="empty")
    assert code == 0
    assert "::notice title=framegen diff::There is nothing to compare" in printed
    assert not runner.report.exists()


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
def test_a_long_report_is_cut_and_says_so(runner: Runner) -> None:
    runner.report.write_text("x" * 70_000, encoding="utf-8")
    runner.has_gh(comment="")
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
def test_without_a_report_there_is_no_comment(runner: Runner) -> None:
    runner.has_gh(comment="")
    assert runner.comment() == (0, "")
    assert not runner.asked.exists()


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
