"""What other machines run of `framegen diff`: the steps of workflows and actions, and hooks.

tests/world/test_automation.py runs them.
"""

import re
import shutil
from pathlib import Path
from typing import Any

import pytest
import yaml
from framegen.cli import VERBS

from tests.factories import ROOT
from tests.programs import ran

ACTION = ROOT / ".github" / "actions" / "framegen-diff" / "action.yml"
WORKFLOW = ROOT / ".github" / "workflows" / "ci.yml"
HOOKS = ROOT / ".pre-commit-hooks.yaml"
GUIDE = ROOT / "docs" / "changing-the-protocol.md"
BASH = shutil.which("bash")


def read(file: Path) -> Any:
    """Return what a file of YAML says, its comments aside."""
    return yaml.safe_load(file.read_text(encoding="utf-8"))


def test_no_step_has_words_of_others_in_its_script() -> None:
    """A title or a branch that anybody may choose is a variable, and never part of a script."""
    jobs = read(WORKFLOW)["jobs"].values()
    steps = [*read(ACTION)["runs"]["steps"], *(each for job in jobs for each in job["steps"])]
    scripts = [each["run"] for each in steps if "run" in each]
    assert len(scripts) > 5
    assert [script for script in scripts if "${{" in script] == []


@pytest.mark.skipif(BASH is None, reason="there is no bash here")
def test_bash_can_read_each_script_of_the_action() -> None:
    scripts = [each["run"] for each in read(ACTION)["runs"]["steps"] if "run" in each]
    for script in scripts:
        ran(BASH, "-n", "-c", script)


def test_each_hook_is_a_verb_that_takes_specs() -> None:
    for hook in read(HOOKS):
        command, *words = hook["entry"].split()
        assert command == "framegen"
        assert hook["id"] == f"framegen-{words[0]}"
        assert words[0] in VERBS
        assert hook.get("always_run") or re.search(hook["files"], "spec/greenhouse.yaml")


def test_only_the_job_that_comments_may_write() -> None:
    workflow = read(WORKFLOW)
    assert workflow["permissions"] == {"contents": "read"}
    allowed = {name: job.get("permissions") for name, job in workflow["jobs"].items()}
    assert {name: each for name, each in allowed.items() if each is not None} == {
        "diff": {"contents": "read", "pull-requests": "write"}
    }


def test_each_input_of_the_action_is_used_and_explained() -> None:
    text = ACTION.read_text(encoding="utf-8")
    inputs = read(ACTION)["inputs"]
    used = set(re.findall(r"inputs\.([\w-]+)", text))
    assert used == set(inputs)
    assert all(each["description"] for each in inputs.values())


def snippets() -> list[Any]:
    """Return what the guide gives to copy."""
    _, _, section = GUIDE.read_text(encoding="utf-8").partition("\n## Check every pull request\n")
    texts = re.findall(
        r"^```yaml\n(.*?)^```$", section.partition("\n## ")[0], re.MULTILINE | re.DOTALL
    )
    return [yaml.safe_load(text) for text in texts]


def test_the_guide_names_inputs_and_hooks_that_there_are() -> None:
    job, hooks = snippets()
    checkout, action = job["jobs"]["diff"]["steps"]
    assert checkout["uses"].startswith("actions/checkout@")
    place = action["uses"].partition("@")[0].partition("/.github/")[2]
    assert ROOT / ".github" / place == ACTION.parent
    assert action["with"].keys() <= read(ACTION)["inputs"].keys()
    assert action["with"]["comment"] == "true"
    ours = read(WORKFLOW)["jobs"]["diff"]
    assert job["jobs"]["diff"]["permissions"] == ours["permissions"]
    (repository,) = hooks["repos"]
    assert repository.keys() == {"repo", "rev", "hooks"}
    assert [each["id"] for each in repository["hooks"]] == [each["id"] for each in read(HOOKS)]


def test_the_hook_that_compares_runs_where_a_spec_was_deleted() -> None:
    (hook,) = (each for each in read(HOOKS) if each["id"] == "framegen-diff")
    assert (hook["always_run"], hook["verbose"]) == (True, True)


def test_hooks_leave_released_editions_alone() -> None:
    released = "spec/released/greenhouse-1.0.0.yaml"
    checked = {
        hook["id"]
        for hook in read(HOOKS)
        if hook.get("always_run") or re.search(hook["files"], released)
    }
    assert checked == {"framegen-diff", "framegen-generate"}
