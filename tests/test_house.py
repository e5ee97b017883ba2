"""The house is in order: what is said twice agrees, and nothing lies about that nobody wrote."""

import os
import re
import shutil
import subprocess
from pathlib import Path

import busservo
import framegen
import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.render import render, render_shared
from framegen.writing import changes

from tests.documents import ROOT

SPEC = ROOT / "spec" / "busservo.yaml"
# Folders that tools make, and nobody writes.
IGNORED = (ROOT / ".gitignore").read_text(encoding="utf-8").splitlines()
LITTER = {".git", "node_modules", *(line.strip("/") for line in IGNORED)}

# No page and no program may depend on the machine on which it was written.
MACHINE = {
    "a path of somebody's machine": re.compile(
        r"(?<![\w.$}~])/(?:home|root|Users|work|workspace|tmp|opt|mnt|srv)/\w", re.ASCII
    ),
    "a folder of Windows": re.compile(r"\b[A-Za-z]:\\(?:Users|Windows|Program)", re.ASCII),
    "the address of a package registry": re.compile(
        r"pypi\.(?:org|python)|pythonhosted\.|registry\.npmjs|(?:extra-)?index-url|/simple/",
        re.IGNORECASE,
    ),
    "an address inside a network": re.compile(
        r"\b(?:10\.\d+|172\.(?:1[6-9]|2\d|3[01])|192\.168)\.\d+\.\d+\b"
    ),
}
UNFINISHED = re.compile(r"\b(?:TODO|FIXME|XXX)\b|^(?:<{7}|>{7}|={7}$)", re.MULTILINE)


def our_files() -> list[Path]:
    """Return the project's files: what git would keep, or else everything but litter."""
    git = shutil.which("git")
    if git is not None and (ROOT / ".git").exists():
        listed = subprocess.run(
            [git, "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
            cwd=ROOT,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )
        if listed.returncode == 0:
            names = listed.stdout.split("\0")
            return sorted(ROOT / name for name in names if (ROOT / name).is_file())
    found = []
    for folder, folders, files in os.walk(ROOT):
        folders[:] = [name for name in folders if name not in LITTER]
        found += [Path(folder) / name for name in files]
    return sorted(found)


def text_of(file: Path) -> str | None:
    """Return the text of a file; None for bytes that are no text."""
    try:
        return file.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        return None


TEXTS = {
    file.relative_to(ROOT).as_posix(): text
    for file in our_files()
    if (text := text_of(file)) is not None
}


def places(pattern: re.Pattern[str]) -> list[str]:
    return [
        f"{name}:{text.count(chr(10), 0, match.start()) + 1}: {match[0]}"
        for name, text in TEXTS.items()
        if name != "tests/test_house.py"
        for match in pattern.finditer(text)
    ]


@pytest.mark.parametrize("what", MACHINE)
def test_no_file_knows_a_machine(what: str) -> None:
    assert places(MACHINE[what]) == []


def test_nothing_is_left_unfinished() -> None:
    assert places(UNFINISHED) == []


def test_text_files_end_with_one_line_break() -> None:
    wrong = [
        name
        for name, text in TEXTS.items()
        if (text and not text.endswith("\n")) or text.endswith("\n\n")
    ]
    assert wrong == []


def test_there_is_one_version() -> None:
    in_project = re.search(r'^version = "(.*)"$', TEXTS["pyproject.toml"], flags=re.MULTILINE)
    newest = re.search(r"^## \[(.*)\]", TEXTS["CHANGELOG.md"], flags=re.MULTILINE)
    assert in_project is not None
    assert newest is not None
    assert in_project[1] == framegen.__version__ == busservo.__version__ == newest[1]


def test_everything_under_generated_is_what_the_generator_makes() -> None:
    compiled = compile_spec(read_source(SPEC))
    rendered = render(compiled)
    found = changes(ROOT, [rendered, render_shared(compiled)])
    assert [(change.path, change.why) for change in found] == []
    on_disk = {name for name in TEXTS if name.startswith("generated/")}
    assert on_disk <= {*rendered.files, rendered.manifest}


def test_there_is_nothing_in_generated_but_the_library() -> None:
    names = {path.name for path in (ROOT / "generated").iterdir() if path.name not in LITTER}
    assert names == {"busservo", "busservo.manifest"}


def test_generated_code_silences_no_checker() -> None:
    silenced = [
        name
        for name, text in TEXTS.items()
        if name.startswith("generated/") and re.search(r"#\s*(?:noqa|type: ignore|pyright:)", text)
    ]
    assert silenced == []


# -- The same commands everywhere ------------------------------------------------------------------

MAKEFILE = TEXTS["Makefile"]
WORKFLOW = TEXTS[".github/workflows/ci.yml"]
CI = TEXTS[".ci/run"]
README = TEXTS["README.md"]
HOOKS = TEXTS[".pre-commit-config.yaml"]


def recipe(target: str) -> list[str]:
    """Return the commands of a target, without the environment's folder."""
    found = re.search(rf"^{target}:.*\n((?:\t.*\n)+)", MAKEFILE, flags=re.MULTILINE)
    assert found is not None
    return found[1].replace("\t", "").replace("$(IN)/", "").splitlines()


@pytest.mark.parametrize("command", ["make", "make lint", "make test"])
def test_all_that_run_the_house_run_it_alike(command: str) -> None:
    assert re.search(rf"^ *- run: {command}$", WORKFLOW, flags=re.MULTILINE)
    assert re.search(rf"^{command}$", CI, flags=re.MULTILINE)


@pytest.mark.parametrize("command", ["make", "make test"])
def test_the_readme_has_the_two_commands(command: str) -> None:
    assert re.search(rf"^{command}  +# ", README, flags=re.MULTILINE)


def test_windows_runs_what_the_readme_says() -> None:
    by_hand = re.search(r"^```bat\n(.*?)^```", README, flags=re.MULTILINE | re.DOTALL)
    job = re.search(r"^  windows:\n(.*?)^  [a-z-]+:", WORKFLOW, flags=re.MULTILINE | re.DOTALL)
    assert by_hand is not None
    assert job is not None
    _venv, _activate, *said = by_hand[1].splitlines()
    # On a fresh machine nothing may differ from what was committed.
    said = [f"{line} --check" if line == "framegen generate" else line for line in said]
    assert re.findall(r"^ *- run: (.*)$", job[1], flags=re.MULTILINE) == said


def test_plain_commands_do_what_make_does() -> None:
    assert all(command in README for command in recipe("all"))


def test_hooks_are_lints() -> None:
    hooks = re.findall(r"^ *entry: \.venv/bin/(.*)$", HOOKS, flags=re.MULTILINE)
    assert {hook.removesuffix(" --force-exclude") for hook in hooks} <= set(recipe("lint"))


def test_hooks_are_local() -> None:
    assert re.findall(r"repo: (.*)", HOOKS) == ["local"]


def test_every_supported_python_is_tested() -> None:
    declared = re.findall(r"Python :: (3\.\d+)", TEXTS["pyproject.toml"])
    matrix = re.search(r"python: \[(.*)\]", WORKFLOW)
    versions = re.search(r'^VERSIONS="(.*)"$', CI, flags=re.MULTILINE)
    assert matrix is not None
    assert versions is not None
    assert re.findall(r'"(.*?)"', matrix[1]) == versions[1].split() == declared
    assert f'requires-python = ">={declared[0]}"' in TEXTS["pyproject.toml"]


def test_a_whole_run_depends_on_no_variable_and_no_file_of_a_machine() -> None:
    started = re.search(r"exec env -i ((?:.|\n)*?) bash \.ci/run$", CI, flags=re.MULTILINE)
    reaching = re.search(r'^REACHING="([^"]*)"$', CI, flags=re.MULTILINE)
    assert started is not None
    assert reaching is not None
    assert re.findall(r"(\w+)=", started[1]) == ["HOME", "PATH", "LANG", "CI", "BEGUN_ANEW"]
    ways = re.compile(
        "PIP_|SSL_|REQUESTS_|NODE_EXTRA_|HTTPS?_PROXY|NO_PROXY|npm_config_", re.IGNORECASE
    )
    assert all(ways.match(name) for name in reaching[1].split())


def test_actions_are_pinned_by_their_major_version() -> None:
    assert all(
        re.fullmatch(r"actions/[a-z-]+@v\d+", action)
        for action in re.findall(r"uses: (\S+)", WORKFLOW)
    )


def test_every_command_of_make_is_explained() -> None:
    phony = re.search(r"^\.PHONY: (.*)$", MAKEFILE, flags=re.MULTILINE)
    assert phony is not None
    explained = re.findall(r"^([a-z-]+):.*  ## \S", MAKEFILE, flags=re.MULTILINE)
    assert sorted(explained) == sorted(phony[1].split())
