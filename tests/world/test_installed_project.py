"""Projects of `framegen new`, installed by pip in environments that hold nothing else."""

import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest
from framegen import __version__
from framegen.cli import main

from tests.programs import ran

# Nothing that is written depends on how long the name is.
NAMES = ["k", "k" * 30]
SCRIPTS, EXE = ("Scripts", ".exe") if sys.platform == "win32" else ("bin", "")
OWN = f"its own runtime {__version__}"


def run(*words: object, cwd: Path) -> subprocess.CompletedProcess[str]:
    inherited = {key: value for key, value in os.environ.items() if key != "PYTHONPATH"}
    return ran(*words, cwd=cwd, env=inherited)


def begun(name: str, folder: Path) -> Path:
    assert main(["new", name, "--into", str(folder)]) == 0
    assert main(["generate", str(folder / "spec" / f"{name}.yaml")]) == 0
    return folder


def environment(folder: Path) -> Path:
    """Return the folder with the commands of a new virtual environment."""
    run(sys.executable, "-m", "venv", folder, cwd=folder.parent)
    return folder / SCRIPTS


def installed(python: Path) -> set[str]:
    """Return the names of the distributions in an environment."""
    listed = run(python, "-m", "pip", "list", "--format", "json", cwd=python.parent)
    return {each["name"] for each in json.loads(listed.stdout)}


@pytest.mark.parametrize("name", NAMES)
def test_linters_accept_a_new_project(name: str, tmp_path: Path) -> None:
    project = begun(name, tmp_path)
    # What its library carries is checked where it is written, with settings of that project.
    with (project / "generated" / name / "_runtime" / "frame" / "message.py").open("a") as carried:
        carried.write("import os,sys\nlost: int = ''\n")
    run(sys.executable, "-m", "ruff", "check", "--no-cache", cwd=project)
    run(sys.executable, "-m", "ruff", "format", "--check", "--no-cache", cwd=project)
    done = run(sys.executable, "-m", "mypy", "--cache-dir", tmp_path / "cache", cwd=project)
    assert done.stdout.startswith("Success: no issues found in ")


def test_the_tests_of_a_project_fail_on_a_library_of_another_spec(tmp_path: Path) -> None:
    project = begun("kiln", tmp_path)
    vectors = project / "generated" / "kiln" / "vectors.json"
    text = vectors.read_text(encoding="utf-8")
    vectors.write_text(text.replace('"level": 500', '"level": 501'), encoding="utf-8")
    words = ("-m", "pytest", "-q", "-p", "no:cacheprovider")
    done = ran(sys.executable, *words, status=1, cwd=project)
    assert "test_a_valid_frame_is_made_and_understood[Half full]" in done.stdout
    assert "\n1 failed, " in done.stdout


def test_a_project_installs_by_its_readme_and_its_commands_work(tmp_path: Path) -> None:
    project = begun("kiln", tmp_path / "kiln")
    here = environment(tmp_path / "venv")
    python = here / f"python{EXE}"
    run(python, "-m", "pip", "install", "--quiet", "--editable", "./kiln", cwd=tmp_path)
    kiln = here / f"kiln{EXE}"
    done = run(kiln, "decode", "A5", "5A", "03", "01", "01", "F4", cwd=tmp_path)
    assert done.stdout.endswith("Level level=500 ‰ | A5 5A 03 01 01 F4\n")
    assert run(kiln, "--version", cwd=tmp_path).stdout == f"kiln 0.1.0, spec 0.1.0, {OWN}\n"

    # The version follows the spec.
    spec = project / "spec" / "kiln.yaml"
    text = spec.read_text(encoding="utf-8")
    text = text.replace('  version: "0.1.0"', '  version: "0.2.0"', 1)
    text = text.replace('  - version: "0.1.0"', '  - version: "0.2.0"', 1)
    spec.write_text(text, encoding="utf-8")
    assert main(["generate", str(spec)]) == 0
    run(python, "-m", "pip", "install", "--quiet", "--editable", "./kiln", cwd=tmp_path)
    assert run(kiln, "--version", cwd=tmp_path).stdout == f"kiln 0.2.0, spec 0.2.0, {OWN}\n"


def test_the_wheel_and_the_sdist_of_a_project_need_pyserial_alone(tmp_path: Path) -> None:
    project = begun("kiln", tmp_path / "kiln")
    here = environment(tmp_path / "venv")
    python = here / f"python{EXE}"
    before = installed(python)
    run(sys.executable, "-m", "build", "--outdir", tmp_path / "dist", project, cwd=tmp_path)
    wheel, sdist = sorted((tmp_path / "dist").iterdir(), reverse=True)
    shutil.rmtree(project)
    for made in (sdist, wheel):
        install = [python, "-m", "pip", "install", "--quiet", "--force-reinstall", made]
        run(*install, cwd=tmp_path)
        needed = {"pyserial"} | ({"tomli"} if sys.version_info < (3, 11) else set())
        assert installed(python) - before == {"kiln"} | needed
        listed = run(here / f"kiln{EXE}", "--help", cwd=tmp_path).stdout
        assert "\n  simulate " in listed

        simulator = subprocess.Popen(
            [here / f"kiln{EXE}", "simulate"], stdout=subprocess.PIPE, encoding="utf-8"
        )
        try:
            assert simulator.stdout is not None
            port = simulator.stdout.readline().strip()
            sent = run(here / f"kiln{EXE}", "send", "--port", port, "LevelRead", cwd=tmp_path)
            assert "Level level=500" in sent.stdout
        finally:
            simulator.terminate()
            simulator.communicate()
