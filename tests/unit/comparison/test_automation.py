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
    for script in (each["run"] for each in read(ACTION)["runs"]["steps"] if "run" in each):
        ran(BASH, "-n", "-c", script)


def test_each_hook_is_a_verb_that_takes_specs_and_leaves_released_editions_alone() -> None:
    released = set()
    for hook in read(HOOKS):
        command, *words = hook["entry"].split()
        assert command == "framegen"
        assert hook["id"] == f"framegen-{words[0]}"
        assert words[0] in VERBS
        always = hook.get("always_run")
        assert always or re.search(hook["files"], "spec/greenhouse.yaml")
        if always or re.search(hook["files"], "spec/released/greenhouse-1.0.0.yaml"):
            released.add(hook["id"])
        # A spec that was deleted is no file that a hook could be called with.
        if words[0] == "diff":
            assert (always, hook["verbose"]) == (True, True)
    assert released == {"framegen-diff", "framegen-generate"}


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


def test_the_guide_names_inputs_and_hooks_that_there_are() -> None:
    _, _, section = GUIDE.read_text(encoding="utf-8").partition("\n## Check every pull request\n")
    blocks = re.compile(r"^```yaml\n(.*?)^```$", re.MULTILINE | re.DOTALL)
    job, hooks = map(yaml.safe_load, blocks.findall(section.partition("\n## ")[0]))
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
