"""The repository is in order: repeated facts agree, and no file is there that nobody wrote."""

import os
import re
import shutil
from contextlib import suppress
from functools import cache
from pathlib import Path

import busservo
import framegen
import pytest
import yaml
from framegen.render import render, render_shared
from framegen.writing import changes

from tests.documents import ROOT
from tests.factories import compiled_file
from tests.in_turn import in_turn
from tests.programs import ran

SPECS = sorted((ROOT / "spec").glob("*.yaml"))
# Folders that tools make, and nobody writes.
IGNORED = (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines()
LITTER = {".git", "node_modules", *(line.strip("/") for line in IGNORED)}

FOLDERS = ("home", "root", "Users", "work", "workspace", "tmp", "opt", "mnt", "srv")
# No page and no program may depend on the machine on which it was written. A text without one of
# these words, in small letters, holds none of it.
MACHINE = {
    "a path of somebody's machine": (
        [f"/{each.lower()}/" for each in FOLDERS],
        re.compile(rf"(?<![\w.$}}~])/(?:{'|'.join(FOLDERS)})/\w", re.ASCII),
    ),
    "a folder of Windows": (
        [":\\"],
        re.compile(r"\b[A-Za-z]:\\(?:Users|Windows|Program)", re.ASCII),
    ),
    "the address of a package registry": (
        ["pypi.", "pythonhosted.", "registry.npmjs", "index-url", "/simple/"],
        re.compile(r"(?i)pypi\.(?:org|python)|pythonhosted\.|registry\.npmjs|index-url|/simple/"),
    ),
    "an address inside a network": (
        ["10.", "172.", "192.168."],
        re.compile(r"\b(?:10\.\d+|172\.(?:1[6-9]|2\d|3[01])|192\.168)\.\d+\.\d+\b"),
    ),
}
UNFINISHED = re.compile(r"\b(?:TODO|FIXME|XXX)\b|^(?:<{7}|>{7}|={7}$)", re.MULTILINE)


def our_files() -> list[Path]:
    """Return the project's files: what git would keep, or else everything but litter."""
    git = shutil.which("git")
    if git is not None and (ROOT / ".git").exists():
        words = ("ls-files", "-z", "--cached", "--others", "--exclude-standard")
        names = ran(git, *words, status=None, cwd=ROOT).stdout.split("\0")
        if found := sorted(ROOT / name for name in names if name and (ROOT / name).is_file()):
            return found
    found = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in LITTER]
        found += [Path(folder) / name for name in files]
    return sorted(found)


NAME = "tests/unit/project/test_house.py"


@cache
def texts() -> dict[str, str]:
    """Return the texts of all files by path: read when asked for, by one worker."""
    found = {}
    for each in our_files():
        with suppress(UnicodeDecodeError):  # bytes that are no text
            found[each.relative_to(ROOT).as_posix()] = each.read_text(encoding="utf-8")
    return found


@cache
def small_texts() -> dict[str, str]:
    return {name: text.lower() for name, text in texts().items() if name != NAME}


def places(words: list[str], pattern: re.Pattern[str]) -> list[str]:
    """Return where a pattern is found, in the texts that hold one of these words."""
    return [
        f"{name}:{texts()[name].count(chr(10), 0, match.start()) + 1}: {match[0]}"
        for name, small in small_texts().items()
        if any(word in small for word in words)
        for match in pattern.finditer(texts()[name])
    ]


# Where the code is that the tests of a folder are for; all others are for the generator.
ROOMS = {"simulator": "simulator/busservo_simulator", "runtime": "runtime/framewire"}


def test_the_folders_of_the_tests_are_those_of_the_code() -> None:
    folders = {Path(name).parent for name in texts() if name.startswith("tests/unit/")}
    parts = {each.parts[2:] for each in folders} - {("project",)}
    rooms = {Path(ROOMS.get(top, f"codegen/framegen/{top}"), *rest) for top, *rest in parts}
    assert [room for room in sorted(rooms) if not (ROOT / room).is_dir()] == []


@in_turn("what", lambda: MACHINE)
def test_no_file_names_a_machine(what: str) -> None:
    assert places(*MACHINE[what]) == []


def test_nothing_is_left_unfinished() -> None:
    words = ["todo", "fixme", "xxx", "<<<<<<<", ">>>>>>>", "======="]
    assert places(words, UNFINISHED) == []


def test_text_files_end_with_one_line_break() -> None:
    assert [
        name for name, text in texts().items() if text and not re.search(r"[^\n]\n\Z", text)
    ] == []


def test_there_is_one_version() -> None:
    said = [texts()[project] for project in PROJECTS]
    versions = re.findall(r'^version = "(.*)"$', "\n".join(said), flags=re.MULTILINE)
    changes = re.findall(r"^## \[(.*?)\]", texts()["CHANGELOG.md"], flags=re.MULTILINE)
    assert changes[0] == "Unreleased"
    # framegen's project file reads its version from the package.
    assert len(versions) == 1
    assert {*versions, *changes[1:2], busservo.__version__} == {framegen.__version__}


def test_the_form_of_a_report_begins_with_the_title_that_is_asked_for() -> None:
    form = yaml.safe_load(texts()[".github/ISSUE_TEMPLATE/report.yml"])
    assert f'titled "{form["title"]}"' in texts()["CONTRIBUTING.md"]


def test_everything_under_generated_is_what_the_generator_makes() -> None:
    compiled = [compiled_file(spec) for spec in SPECS]
    rendered = [render(each) for each in compiled]
    found = changes(ROOT, [*rendered, render_shared(compiled[0])])
    assert [(change.path, change.why) for change in found] == []
    on_disk = {name for name in texts() if name.startswith("generated/")}
    made = {name for each in rendered for name in (*each.files, each.manifest)}
    assert on_disk <= made


def test_there_is_nothing_in_generated_but_the_libraries() -> None:
    names = {path.name for path in (ROOT / "generated").iterdir() if path.name not in LITTER}
    assert names == {name for spec in SPECS for name in (spec.stem, f"{spec.stem}.manifest")}


def test_generated_code_silences_no_checker() -> None:
    silenced = re.compile(r"#\s*(?:noqa|type: ignore|pyright:)")
    generated = [name for name in texts() if name.startswith("generated/")]
    assert [name for name in generated if silenced.search(texts()[name])] == []


PROJECTS = ("pyproject.toml", "codegen/pyproject.toml")
BASH = shutil.which("bash")


def below(folder: str) -> list[str]:
    return [name for name in texts() if name.startswith(f".github/{folder}/")]


def test_what_packages_have_in_common_is_the_same() -> None:
    python = '"Programming Language :: Python ::'
    common = ("requires", "build-backend", "license", "authors", python, '"Operating System ::')
    lines = [[line.lstrip() for line in texts()[project].splitlines()] for project in PROJECTS]
    first, *others = ([line for line in each if line.startswith(common)] for each in lines)
    assert len(first) == 12
    assert others == [first]
    assert (
        len({texts()[f"{folder}LICENSE"] for folder in ("", "codegen/", "runtime/framewire/")}) == 1
    )


def test_a_declared_python_is_a_tested_one() -> None:
    declared = re.findall(r"Python :: (3\.\d+)", texts()["pyproject.toml"])
    job = yaml.safe_load(texts()[".github/workflows/ci.yml"])["jobs"]["linux"]
    assert job["strategy"]["matrix"]["python"] == declared
    assert f'requires-python = ">={declared[0]}"' in texts()["pyproject.toml"]


@pytest.mark.skipif(os.name == "nt" or BASH is None, reason="there is no bash here")
def test_a_whole_run_depends_on_no_variable_and_no_folder_of_a_machine(tmp_path: Path) -> None:
    elsewhere = tmp_path / "bin"
    path = f"{elsewhere}{os.pathsep}{os.environ['PATH']}"
    variables = {"BARE_HOME": str(tmp_path / "home"), "PATH": path, "PIP_CERT": "kept"}
    variables["PYTHONPATH"] = str(elsewhere)
    done = ran(BASH, ROOT / ".ci/bare", "env", environment=variables)
    kept = dict(line.partition("=")[::2] for line in done.stdout.splitlines())
    ways = r"(?i)PIP_|SSL_|REQUESTS_|NODE_EXTRA_|HTTPS?_PROXY|NO_PROXY|npm_config_|PYTHON_3_\d+$"
    names = {name for name in kept if not re.match(ways, name)} - {"_", "PWD", "SHLVL"}
    assert names == {"HOME", "PATH", "LANG", "CI", "VERSIONS"}
    assert kept["PIP_CERT"] == "kept"
    assert kept["HOME"] == str(tmp_path / "home")
    assert str(elsewhere) not in kept["PATH"].split(os.pathsep)


@in_turn("name", lambda: [*below("workflows"), *below("actions")])
def test_actions_are_our_own_or_pinned_to_a_commit(name: str) -> None:
    read = yaml.safe_load(texts()[name])
    jobs = [read["runs"]] if name in below("actions") else read["jobs"].values()
    used = [step["uses"] for job in jobs for step in job["steps"] if "uses" in step]
    own = {f"./{action.rpartition('/')[0]}" for action in below("actions")}
    assert used
    assert [each for each in {*used} - own if not re.fullmatch(r"[\w/-]+@[0-9a-f]{40}", each)] == []


def test_hooks_are_local() -> None:
    hooks = yaml.safe_load(texts()[".pre-commit-config.yaml"])
    assert [repository["repo"] for repository in hooks["repos"]] == ["local"]


def test_every_command_of_make_is_explained() -> None:
    phony = re.search(r"^\.PHONY: (.*)$", texts()["Makefile"], flags=re.MULTILINE)
    assert phony is not None
    explained = re.findall(r"^([a-z-]+):.*  ## \S", texts()["Makefile"], flags=re.MULTILINE)
    assert sorted(explained) == sorted(phony[1].split())


def test_the_mutants_stand_in_the_code_and_their_killers_among_the_tests() -> None:
    names = ("tests/mutant_sample.yaml", "tests/derive_mutants.yaml")
    sample, derived = (yaml.safe_load(texts()[name]) for name in names)
    gone = [each["id"] for each in sample + derived if each["was"] not in texts()[each["file"]]]
    for each in derived:
        file, _, test = each["killer"].partition("::")
        gone += [each["id"]] * (f"def {test.partition('[')[0]}(" not in texts()[file])
    assert gone == []
