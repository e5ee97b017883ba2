"""`framegen new`: the project that it writes works, and it overwrites nothing."""

import os
import re
import shutil
import subprocess
import sys
import sysconfig
from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from pathlib import Path
from textwrap import dedent, indent

import pytest
import yaml
from framegen.cli import main
from framegen.language.site_settings import SiteSettings, load_settings
from framegen.reading.source import Source
from framegen.site.shades import BOUND, worst_contrast
from framegen.skeleton import skeleton, spec_path
from framegen.writing import disk

from tests.commands import Ended, called
from tests.factories import ROOT, compiled_file, write_files
from tests.in_turn import in_turn
from tests.programs import ran
from tests.repository import git, start

ACTION = re.compile(r"uses: (\S+@[0-9a-f]{40}) # v")
BOARD = "simulator/kiln_simulator/__init__.py"
GUIDE = ROOT / "docs" / "write-a-spec.md"


framegen = partial(called, main)


def next_commands(printed: str) -> list[list[str]]:
    """Return the words of each command that is named to come next."""
    lines = printed.partition("\nnext:\n")[2].splitlines()
    return [line.split() for line in lines if line[0] == " "]


@pytest.fixture(scope="module")
def workplace(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, str]:
    """Return the folder of a new, generated project, and the output of `framegen new`."""
    folder = tmp_path_factory.mktemp("workplace")
    with pytest.MonkeyPatch.context() as patch:
        patch.chdir(folder)
        text = framegen("new", "kiln").out
        generate, _, _ = next_commands(text)
        assert framegen(*generate[1:]).status == 0
    return folder, text


def assert_its_tests_pass_with(spec: Path, folder: Path) -> None:
    """Put the library of a spec in the place of that of a new project, and run the tests of it."""
    name = compiled_file(spec).model.spec.protocol.name
    test = f"tests/test_{name}.py"
    write_files(
        {path: skeleton(name)[path] for path in (test, BOARD.replace("kiln", name))}, folder
    )
    assert framegen("generate", str(spec), "--runtime", "carried", "--out", str(folder)).status == 0
    done = python(folder, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-c", os.devnull, test)
    assert done.returncode == 0, done.stdout
    [passed] = re.findall(r"(\d+) passed", done.stdout)
    assert int(passed) > 20


def python(project: Path, *words: str) -> subprocess.CompletedProcess[str]:
    """Run Python in a project that is not installed, with what others wrote and nothing of ours.

    What is ours is linked to where it lies, and `-S` follows no such link.
    """
    folders = [project / "generated", project / "simulator", sysconfig.get_path("purelib")]
    variables = {"PYTHONPATH": os.pathsep.join(map(str, folders))}
    words = (sys.executable, "-S", *words)
    return ran(*words, status=None, cwd=project, environment=variables)


# ------------------------------------------------------------------ what it leads to


def test_the_printed_commands_lead_to_a_library_that_decodes(workplace: tuple[Path, str]) -> None:
    folder, printed = workplace
    written = [line.removeprefix("wrote ") for line in printed.partition("\n\n")[0].splitlines()]
    assert sorted(written) == sorted(f"kiln/{path}" for path in skeleton("kiln"))
    assert all((folder / path).is_file() for path in written)
    generate, install, decode = next_commands(printed)
    assert generate == ["framegen", "generate", "kiln/spec/kiln.yaml"]
    assert install == ["pip", "install", "--editable", "./kiln"]
    done = python(folder / "kiln", "-m", *decode)
    level = "     0  device      Level level=500 ‰ | A5 5A 03 01 01 F4\n"
    assert (done.returncode, done.stdout) == (0, level)


def test_its_library_needs_no_other_package_of_ours(workplace: tuple[Path, str]) -> None:
    done = python(workplace[0] / "kiln", "-c", "import kiln._runtime.line; import framewire")
    assert done.stderr.endswith("ModuleNotFoundError: No module named 'framewire'\n")


@pytest.mark.skipif(shutil.which("git") is None, reason="git is not installed")
def test_to_forges_what_its_library_carries_is_written_elsewhere(tmp_path: Path) -> None:
    start(tmp_path)
    write_files({".gitattributes": skeleton("kiln")[".gitattributes"]}, tmp_path)
    for path, said in [("_runtime/frame/message.py", "true"), ("_codec.py", "unspecified")]:
        shown = git(tmp_path, "check-attr", "linguist-vendored", f"generated/kiln/{path}")
        assert shown.endswith(f": {said}")


def test_its_site_loses_nothing_and_needs_no_server(
    workplace: tuple[Path, str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(workplace[0] / "kiln")
    status, _, err = framegen("docs", "--strict", "--out", str(tmp_path / "site"))
    assert (status, err) == (0, "guides: README.md, first-steps.md, of docs/\n")
    home = (tmp_path / "site" / "index.html").read_text(encoding="utf-8")
    assert 'href="first-steps.html"' in home
    assert 'href="reference/kiln/index.html"' in home


def test_its_settings_of_the_site_can_all_be_taken_out_of_their_comments(tmp_path: Path) -> None:
    text = skeleton("kiln")["docs/site.yaml"]
    assert load_settings(Source("site.yaml", text))[0] == SiteSettings()
    keys = "|".join(SiteSettings.model_fields)
    used = re.sub(f"^# (?=(?:{keys}): )", "", text, flags=re.MULTILINE)
    values = load_settings(Source("site.yaml", used))[0].model_dump()
    assert all(values.values())
    assert worst_contrast(values["accent"], "light") >= BOUND
    assert worst_contrast(values["accent_dark"], "dark") >= BOUND


def test_its_first_guide_prints_what_it_says(workplace: tuple[Path, str]) -> None:
    guide = (workplace[0] / "kiln" / "docs" / "first-steps.md").read_text(encoding="utf-8")
    [(command, printed)] = re.findall(r"```console\n\$ (.*)\n(.*\n)```", guide)
    done = python(workplace[0] / "kiln", "-m", *command.split())
    assert (done.returncode, done.stdout) == (0, printed)


def test_its_workflows_use_the_actions_that_ours_are_pinned_to() -> None:
    ours = [file.read_text("utf-8") for file in (ROOT / ".github" / "workflows").glob("*.yml")]
    texts = [text for path, text in skeleton("kiln").items() if path.endswith(".yml")]
    used = {*ACTION.findall("\n".join(texts))}
    assert len(used) == 5
    assert used <= {*ACTION.findall("\n".join(ours))}
    assert all(yaml.safe_load(text)["permissions"] == {"contents": "read"} for text in texts)


def test_its_own_tests_find_all_that_they_import(workplace: tuple[Path, str]) -> None:
    """They pass, too: tests/world/test_new_project.py."""
    done = python(workplace[0] / "kiln", "-c", "import tests.test_kiln")
    assert (done.returncode, done.stderr) == (0, "")


@contextmanager
def board_of(project: Path, text: str) -> Iterator[None]:
    """Have another module for the virtual device of a project."""
    file = project / BOARD
    before = file.read_text(encoding="utf-8")
    file.write_text(text, encoding="utf-8")
    yield
    file.write_text(before, encoding="utf-8")


def test_a_device_of_other_messages_is_refused_in_words(workplace: tuple[Path, str]) -> None:
    project = workplace[0] / "kiln"
    with board_of(project, "from kiln import LevelAsked\n"):
        done = python(project, "-m", "kiln", "simulate")
    assert done.returncode == 2
    assert "the package kiln_simulator does not work with this kiln: " in done.stderr
    assert "Traceback" not in done.stderr


def test_what_its_device_shows_as_an_example_works(workplace: tuple[Path, str]) -> None:
    text = skeleton("kiln")[BOARD]
    example = text[text.index("        def ") :].removesuffix('    """\n')
    words = "from __future__ import annotations\n"
    shown = text.replace(words, f"{words}from kiln import *\n") + indent(dedent(example), "    ")
    sent = "kiln.LevelSet(1000), kiln.LevelRead()"
    program = (
        "import kiln, kiln_simulator; board = kiln_simulator.Board(); "
        f"print(*[board.receive(each.encode()).hex() for each in ({sent})])"
    )
    with board_of(workplace[0] / "kiln", shown):
        done = python(workplace[0] / "kiln", "-c", program)
    assert (done.stdout, done.stderr) == ("a55a020301 a55a030103e8\n", "")


CHOICES = {
    "python,vectors,docs": (True, False),
    "vectors,schema,python": (False, True),
}


@pytest.mark.parametrize("chosen", CHOICES)
def test_what_a_project_chooses_is_all_that_is_written_until_it_chooses_otherwise(
    chosen: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    has = {"docs/reference": CHOICES[chosen][0], "spec/framegen.schema.json": CHOICES[chosen][1]}
    assert framegen("new", "kiln", "--into", ".", "--targets", chosen).status == 0
    assert framegen("generate").status == 0
    assert {path: Path(path).exists() for path in has} == has
    assert ("](docs/reference" in Path("README.md").read_text("utf-8")) is CHOICES[chosen][0]
    # Another choice: what was written for the former one goes, and nothing else.
    settings = Path("pyproject.toml")
    text = re.sub(
        "(?m)^targets = .*", 'targets = ["python", "vectors"]', settings.read_text("utf-8")
    )
    settings.write_text(text, encoding="utf-8")
    own = [*contents(tmp_path)]
    assert framegen("generate", "--check").status == 1
    assert framegen("generate").status == 0
    gone = {path for path in own if path not in contents(tmp_path)}
    assert {path.rpartition("/")[0].partition("/kiln")[0] for path in gone} == {
        path.removesuffix("/framegen.schema.json") for path, there in has.items() if there
    }
    assert framegen("generate", "--check").status == 0


@in_turn(
    "targets, said",
    lambda: [
        ("python,pyhton", "--targets: there is no target 'pyhton'\n  hint: did you mean `python`?"),
        ("docs", "a new project needs python and vectors for its tests\n  hint: write --targets "),
    ],
)
def test_targets_that_no_project_can_have_are_refused(
    targets: str, said: str, tmp_path: Path
) -> None:
    status, _, errors = framegen("new", "kiln", "--into", str(tmp_path), "--targets", targets)
    assert (status, errors.startswith(f"framegen: error: {said}")) == (2, True)
    assert contents(tmp_path) == {}


@in_turn(
    "targets, said",
    lambda: [
        ('["pyton"]', "there is no target 'pyton'"),
        ("[]", "names no target"),
        ('"python"', "is no list of names"),
        ("[", "pyproject.toml is not TOML: "),
    ],
)
def test_a_choice_that_cannot_be_read_stops_generate(
    targets: str, said: str, tmp_path: Path
) -> None:
    write_files(
        {**skeleton("kiln"), "pyproject.toml": f"[tool.framegen]\ntargets = {targets}\n"}, tmp_path
    )
    status, _, errors = framegen("generate", str(tmp_path / "spec" / "kiln.yaml"))
    assert (status, said in errors, "pyproject.toml" in errors) == (2, True, True), errors


def test_a_new_project_has_few_files_besides_the_runtime(workplace: tuple[Path, str]) -> None:
    files = [path for path in contents(workplace[0] / "kiln") if "__pycache__" not in path]
    assert len([path for path in files if "/_runtime/" not in path]) <= 40


@in_turn(
    "protocol",
    lambda: [
        'protocol:\n  name: kiln\n  version: "1.2.3"\n',
        "protocol:\n  name: kiln\n  version: 1.2.3\n",
        'protocol: {name: kiln, title: Kiln, version: "1.2.3", authority: m}\n',
        "protocol: {version: 1.2.3}\n",
    ],
)
def test_the_version_of_a_project_is_read_from_its_spec_however_it_is_written(
    protocol: str,
) -> None:
    (line,) = re.findall('^pattern = "(.*)"$', skeleton("kiln")["pyproject.toml"], re.MULTILINE)
    pattern = line.encode().decode("unicode_escape")
    found = re.search(pattern, f"framegen: 2\n{protocol}byte_order: big\n", re.MULTILINE)
    assert found is not None
    assert found["version"] == "1.2.3"


@in_turn(
    "into, generate, install",
    lambda: [
        (".", "spec/kiln.yaml", "."),
        ("a b", '"a b/spec/kiln.yaml"', '"./a b"'),
        ("../kiln", "../kiln/spec/kiln.yaml", "./../kiln"),
    ],
)
def test_the_commands_name_the_folder_of_the_project(
    into: str, generate: str, install: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "here").mkdir(exist_ok=True)
    monkeypatch.chdir(tmp_path / "here")
    status, printed, _ = framegen("new", "kiln", "--into", into)
    assert (status, Path(into, "spec", "kiln.yaml").is_file()) == (0, True)
    assert f"\n  framegen generate {generate}\n  pip install --editable {install}\n" in printed
    # There is nothing to find in its spec.
    monkeypatch.chdir(into)
    found = "spec/kiln.yaml: 4 messages, 5 examples, 0 errata checked: nothing found\n"
    assert framegen("check") == (0, "", found)


def test_every_section_that_the_spec_names_is_in_the_guide() -> None:
    named = re.findall(r'\(guide: "([^"]+)"\)', skeleton("kiln")[spec_path("kiln")])
    headings = re.findall(r"^##+ (.+)$", GUIDE.read_text(encoding="utf-8"), re.MULTILINE)
    assert len(named) > 5
    assert set(named) - set(headings) == set()


# ------------------------------------------------------------------ names

REFUSED = {
    "class": "`class` is a word of Python itself",
    "json": "`json` is a module of Python's standard library",
    "serial": "`serial` is a package that is used",
    "con": "`con` is a device on Windows, and no folder there",
    "hypothesis": "`hypothesis` is a package that is used beside",
    "Kiln": "`Kiln` is no name in snake_case\n  hint: write `kiln`",
    **{name: f"`{name}` is no name in snake_case" for name in ("_pytest", "../kiln", '"', "")},
    "two words": "`two words` is no name in snake_case",
    "a: {b\n# ": "`a: {b",
    **dict.fromkeys(["\x1b[2J", "\udc80"], ""),
    "k" * 31: "`kkkkkkkkkkkkkkkkkkkkkkkk...` has 31 characters",
}


@in_turn("name", lambda: [*REFUSED, "busservo"])
def test_a_name_that_no_library_can_have_is_refused(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    why = "a package `busservo` is installed here, which it would hide"
    if name in REFUSED:
        why = f"no protocol can be called so: {REFUSED[name]}"
    status, output, errors = framegen("new", name)
    assert (status, output) == (2, "")
    assert errors.startswith(f"framegen: error: {why}")
    assert "\x1b" not in errors
    assert not [*tmp_path.iterdir()]


@in_turn("name", lambda: ["no", "on", "null", "y", "k", "k" * 30, "heat_pump_2"])
def test_any_other_name_is_taken(name: str, tmp_path: Path) -> None:
    folder = tmp_path / name
    assert framegen("new", name, "--into", str(folder)).status == 0
    assert framegen("check", str(folder / spec_path(name))).status == 0


# ------------------------------------------------------------------ what is there already


def contents(folder: Path) -> dict[str, bytes]:
    files = [path for path in folder.rglob("*") if path.is_file()]
    return {path.relative_to(folder).as_posix(): path.read_bytes() for path in files}


def new_in(folder: Path) -> Ended:
    return framegen("new", "kiln", "--into", str(folder))


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    write_files({"README.md": "mine\n", "tests/test_kiln.py/x": ""}, tmp_path)
    before = contents(tmp_path)
    said = f"{tmp_path} has files already that would be written: README.md, tests/test_kiln.py"
    hint = "name another folder: --into FOLDER; nothing was written"
    assert new_in(tmp_path) == (2, "", f"framegen: error: {said}\n  hint: {hint}\n")
    assert contents(tmp_path) == before


def test_what_others_have_there_is_left_and_a_second_run_has_nothing_to_write(
    tmp_path: Path,
) -> None:
    write_files({"LICENSE": "mine\n"}, tmp_path)
    assert new_in(tmp_path).status == 0
    before = contents(tmp_path)
    assert before.keys() == {"LICENSE", *skeleton("kiln")}
    assert before["LICENSE"] == b"mine\n"
    status, out, _ = new_in(tmp_path)
    nothing = f"{len(before) - 1} files are there already: nothing was written\n"
    assert (status, out.startswith(nothing)) == (0, True)
    assert contents(tmp_path) == before


@pytest.mark.parametrize("moved", range(0, len(skeleton("kiln")), 4))
def test_a_run_that_failed_left_whole_files_and_the_next_one_finishes(
    moved: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    wanted = {path: text.encode() for path, text in skeleton("kiln").items()}
    original = disk.move
    budget = iter([original] * moved)

    def move(old: Path, new: Path) -> None:
        step = next(budget, None)
        if step is None:
            raise OSError(28, "No space left on device", str(new))
        step(old, new)

    with monkeypatch.context() as patch:
        patch.setattr(disk, "move", move)
        status, _, err = new_in(tmp_path)
    assert status == 2
    assert "cannot be written: No space left on device" in err
    left = contents(tmp_path)
    assert len(left) == moved
    assert left.items() <= wanted.items()
    assert new_in(tmp_path).status == 0
    assert contents(tmp_path) == wanted


@pytest.mark.skipif(sys.platform == "win32", reason="links there need a right of their own")
def test_no_link_leads_out_of_the_project(tmp_path: Path) -> None:
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "project").mkdir()
    (tmp_path / "project" / "spec").symlink_to(tmp_path / "elsewhere")
    status, _, err = new_in(tmp_path / "project")
    assert status == 2
    assert "spec is a link that leads to " in err
    assert contents(tmp_path) == {}
