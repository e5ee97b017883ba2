"""The packages as others get them: built, and installed where nothing else of ours is.

Each Python is tried that `.ci/bare` has found (PYTHON_3_10 and so on), or else the one that runs.
What others wrote is downloaded first; then all is installed without an index, so a package of ours
that is not handed over in the same command is not found.
"""

import email
import os
import shutil
import subprocess
import sys
import tarfile
import zipfile
from collections.abc import Callable
from pathlib import Path

import pytest

from tests.documents import ROOT
from tests.programs import ran

PYTHONS = {
    name.removeprefix("PYTHON_").replace("_", "."): path
    for name, path in os.environ.items()
    if name.startswith("PYTHON_3_")
} or {f"3.{sys.version_info.minor}": sys.executable}
# The oldest and the newest.
TRIED = sorted(PYTHONS, key=lambda name: int(name.split(".")[1]))
TRIED = [TRIED[0], *TRIED[1:][-1:]]
LXSERVO = {"lxservo": "generated/lxservo"}
FOLDERS = {"busservo": ".", "framegen": "codegen", **LXSERVO}
# Whose project file is generated: no licence lies in that folder, only its name. It is built from a
# tree in which it carries the runtime, since its wheel has to stand alone.
GENERATED = {*LXSERVO}

LIBRARY = """
import importlib.util, sys
import busservo

assert "site-packages" in busservo.__file__, busservo.__file__
assert "serial" not in sys.modules, "import busservo imported pyserial"
for name in ("framegen", "lxservo_simulator", "yaml", "jinja2", "pydantic", "hypothesis"):
    assert importlib.util.find_spec(name) is None, name
move = busservo.ServoMove(time_ms=1000, targets=[(1, 800)])
assert busservo.decode(move.encode(), busservo.Direction.HOST_TO_CONTROLLER) == move
"""
TABLES = """
import importlib.util
from NAME import tables

for name in ("pandas", "matplotlib"):
    assert importlib.util.find_spec(name) is None, name
found = tables.read(bytes.fromhex("00 FRAME"))
assert found.filled.keys() == {"MESSAGE", "noise"}, found
assert found["MESSAGE"]["FIELD"].to_pylist() == [VALUE], found["MESSAGE"]
assert found["noise"]["size"].to_pylist() == [1], found["noise"]
"""
# One message of each library: its frame, its name, and a field with its value.
CAPTURED = {
    "busservo": ("55 55 04 0F C9 1E", "BatteryVoltage", "voltage_mv", "7881"),
    "lxservo": ("55 55 01 05 1C F4 01 E8", "Position", "position", "500"),
}
BOARD = """
from busservo import Controller
from busservo_simulator import VirtualClock, VirtualController

with VirtualController(clock=VirtualClock(follow_reads=True)) as board:
    with Controller(board.transport, background=False, clock=board.clock.now) as controller:
        controller.move_servos([(1, 800)], time_ms=1000).wait()
        (servo,) = controller.read_servo_positions([1])
assert servo.position == 800, servo
"""
SERVOS = """
import lxservo
from lxservo_simulator import VirtualBus, VirtualClock

with VirtualBus(clock=VirtualClock(follow_reads=True)) as bus:
    with lxservo.Controller(bus.transport, background=False, clock=bus.clock.now) as servos:
        assert servos.read_position(3) == bus.servos[3].position
    bus.unplug()
    try:
        bus.transport.open()
    except lxservo.PortNotFoundError:
        pass
    else:
        raise AssertionError("an unplugged bus was opened")
"""
DEVICES = {"busservo": BOARD, "lxservo": SERVOS}
# What the command says of a folder of a clone that was installed without the rest.
LEFT_ALONE = {
    "generated/lxservo": (
        "lxservo needs the package framewire, which comes with its project: "
        "in a clone, pip install . ./generated/lxservo\n"
    ),
    "codegen": (
        "framegen: error: the generator needs `framewire`, which is not installed\n"
        "  hint: in a clone of its repository: pip install . ./codegen\n"
    ),
}


def run(*command: object, cwd: Path) -> str:
    """Return the output of a command, in a folder where no source of ours is imported."""
    words = [str(word) for word in command]
    return ran(*words, cwd=cwd, timeout=None).stdout


def pip(*arguments: object, cwd: Path) -> str:
    return run(sys.executable, "-m", "pip", "--disable-pip-version-check", *arguments, cwd=cwd)


@pytest.fixture(scope="module")
def built(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return a wheel of each package, built from its source distribution alone."""
    folder, alone = tmp_path_factory.mktemp("dist"), tmp_path_factory.mktemp("alone")
    for name in GENERATED:
        spec = ROOT / "spec" / f"{name}.yaml"
        words = ["generate", spec, "--target", "python", "--runtime", "carried", "--out", alone]
        run(sys.executable, "-m", "framegen", *words, cwd=folder)
        shutil.copytree(ROOT / "simulator", alone / "simulator", dirs_exist_ok=True)
    for name, project in FOLDERS.items():
        source = (alone if name in GENERATED else ROOT) / project
        words = ["--no-isolation", "--outdir", folder, source]
        run(sys.executable, "-m", "build", *words, cwd=folder)
    return folder


def files_of(built: Path, name: str, ending: str) -> list[Path]:
    return sorted(built.glob(f"{name.replace('-', '_')}-*{ending}"))


@pytest.mark.parametrize("name", FOLDERS)
def test_a_package_has_its_metadata_and_files(built: Path, name: str) -> None:
    (wheel,) = files_of(built, name, ".whl")
    (source,) = files_of(built, name, ".tar.gz")
    with zipfile.ZipFile(wheel) as archive:
        inside = archive.namelist()
        (about,) = (each for each in inside if each.endswith(".dist-info/METADATA"))
        metadata = email.message_from_bytes(archive.read(about))
    assert metadata["Name"] == name
    assert metadata["Author"] == "The busservo authors"
    assert metadata["License-Expression"] == "MIT"
    assert metadata["Requires-Python"] == ">=3.10"
    assert f"# {name}\n" in str(metadata.get_payload())
    licensed = [each for each in inside if each.endswith("licenses/LICENSE")]
    assert bool(licensed) == (name not in GENERATED)
    if name in CAPTURED:
        assert {"tables", "plots"} <= {*metadata.get_all("Provides-Extra", [])}
        needed = metadata.get_all("Requires-Dist", [])
        for package in ("numpy", "pyarrow", "matplotlib"):
            given = [line for line in needed if line.startswith(package)]
            assert given, package
            assert all("; extra ==" in line for line in given), given
    assert f"{name.replace('-', '_')}/py.typed" in inside or name == "framegen"
    with tarfile.open(source) as archive:
        inside = [each.partition("/")[2] for each in archive.getnames()]
    assert {"README.md", "pyproject.toml", "PKG-INFO"} <= set(inside)
    assert ("LICENSE" in inside) == (name not in GENERATED)


def test_the_library_holds_nothing_of_its_generator(built: Path) -> None:
    (wheel,) = files_of(built, "busservo", ".whl")
    with zipfile.ZipFile(wheel) as archive:
        kinds = {Path(each).suffix for each in archive.namelist() if ".dist-info/" not in each}
    assert kinds - {Path("LICENSE").suffix} <= {".py", ".pyi", ".typed", ".json"}


@pytest.fixture(scope="module", params=TRIED)
def python(request: pytest.FixtureRequest) -> str:
    return PYTHONS[request.param]


@pytest.fixture(scope="module")
def shelf(built: Path, python: str, tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return packages of others for that Python: those that ours need, and a build system."""
    folder = tmp_path_factory.mktemp("shelf")
    pip("--python", python, "download", "-qq", "-d", folder, *built.glob("*.whl"), cwd=folder)
    pip("--python", python, "download", "-qq", "-d", folder, "hatchling<2", cwd=folder)
    extra = [f"{wheel}[tables]" for wheel in files_of(built, "busservo", ".whl")]
    pip("--python", python, "download", "-qq", "-d", folder, *extra, cwd=folder)
    for name in FOLDERS:
        for ours in files_of(folder, name, ".whl"):
            ours.unlink()
    return folder


@pytest.fixture
def install(python: str, shelf: Path, tmp_path: Path) -> Callable[..., Path]:
    def installed(*packages: Path | str) -> Path:
        run(python, "-m", "venv", "--without-pip", "env", cwd=tmp_path)
        folder = tmp_path / "env" / ("Scripts" if os.name == "nt" else "bin")
        where = ["--no-index", "--find-links", shelf]
        pip("--python", folder / "python", "install", "-qq", *where, *packages, cwd=tmp_path)
        return folder

    return installed


@pytest.mark.parametrize("name", GENERATED)
def test_a_library_that_is_built_alone_carries_the_whole_runtime(built: Path, name: str) -> None:
    (wheel,) = files_of(built, name, ".whl")
    shared = ROOT / "runtime" / "framewire"
    wanted = {
        f"{name}/_runtime/{file.relative_to(shared).as_posix()}": file.read_bytes()
        for file in shared.rglob("*")
        if file.suffix in {".py", ".typed"} or file.name == "LICENSE"
    }
    with zipfile.ZipFile(wheel) as archive:
        inside = [each for each in archive.namelist() if each.startswith(f"{name}/_runtime/")]
        record = inside.pop(inside.index(f"{name}/_runtime/VENDORED.txt"))
        assert archive.read(record).count(b"\n") > len(inside)
        assert {each: archive.read(each) for each in inside} == wanted
        assert b"framewire" not in archive.read(f"{name}/__init__.py")


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
@pytest.mark.parametrize("name", GENERATED)
def test_a_library_that_carries_the_runtime_runs_alone(
    built: Path, install: Callable[..., Path], name: str, ending: str, tmp_path: Path
) -> None:
    programs = install(*files_of(built, name, ending))
    absent = "import importlib.util; print(importlib.util.find_spec('framewire'))"
    assert run(programs / "python", "-c", absent, cwd=tmp_path) == "None\n"
    frame, message, *_ = CAPTURED[name]
    assert f"{message} " in run(programs / name, "decode", *frame.split(), cwd=tmp_path)
    run(programs / name, "docs", message, cwd=tmp_path)
    for words in (["--version"], ["simulate", "--version"], ["simulate", "--help"]):
        assert "framewire" not in run(programs / name, *words, cwd=tmp_path)


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
@pytest.mark.parametrize("name", DEVICES)
def test_a_library_brings_its_virtual_device(
    built: Path, install: Callable[..., Path], name: str, ending: str, tmp_path: Path
) -> None:
    programs = install(*files_of(built, name, ending))
    run(programs / "python", "-W", "error", "-c", DEVICES[name], cwd=tmp_path)
    command = [str(programs / name), "simulate", "--tcp", "--quiet"]
    with subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=tmp_path) as device:
        assert device.stdout is not None
        assert device.stdout.readline().startswith("socket://127.0.0.1:")
        device.terminate()


@pytest.mark.parametrize("project", LEFT_ALONE)
def test_a_folder_of_a_clone_says_what_is_to_be_named_beside_it(
    install: Callable[..., Path], project: str, tmp_path: Path
) -> None:
    programs = install(ROOT / project)
    command = programs / {"codegen": "framegen"}.get(project, Path(project).name)
    for words in (["--version"], ["check"]):
        assert ran(command, *words, status=None, cwd=tmp_path).stderr == LEFT_ALONE[project]


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
def test_the_library_runs_alone(
    built: Path, install: Callable[..., Path], ending: str, tmp_path: Path
) -> None:
    programs = install(*files_of(built, "busservo", ending))
    freeze = pip("--python", programs / "python", "list", "--format=freeze", cwd=tmp_path)
    names = [line.partition("=")[0] for line in freeze.split()]
    version = "import sys; print(sys.version_info < (3, 11))"
    older = run(programs / "python", "-c", version, cwd=tmp_path) == "True\n"
    assert names == ["busservo", "pyserial", *(["tomli"] if older else [])]
    run(programs / "python", "-W", "error", "-c", LIBRARY, cwd=tmp_path)
    shown = run(programs / "busservo", "decode", "55 55 08 03 01 E8 03 01 20 03", cwd=tmp_path)
    assert "ServoMove time_ms=1000 ms targets=1:800" in shown
    module = [programs / "python", "-m", "busservo"]
    shown = run(*module, "encode", "ServoMove", "time_ms=1000", "targets=1:800", cwd=tmp_path)
    assert shown == "55 55 08 03 01 E8 03 01 20 03\n"
    shown = run(programs / "busservo", "explain", "55 55 04 0F 4C 1D", cwd=tmp_path)
    assert shown.startswith("BatteryVoltage, controller -> host\n")
    shown = run(programs / "busservo", "docs", "BatteryVoltage", cwd=tmp_path)
    assert shown.startswith("BatteryVoltage\nThe voltage of the battery.\n")


@pytest.mark.parametrize("name", CAPTURED)
def test_tables_come_with_their_extra(
    built: Path, install: Callable[..., Path], name: str, tmp_path: Path
) -> None:
    (wheel,) = files_of(built, name, ".whl")
    python = install(f"{wheel}[tables]") / "python"
    program = TABLES.replace("NAME", name)
    # As a capture with a stray byte before it.
    for word, text in zip(("FRAME", "MESSAGE", "FIELD", "VALUE"), CAPTURED[name], strict=True):
        program = program.replace(word, text)
    run(python, "-W", "error", "-c", program, cwd=tmp_path)


@pytest.mark.parametrize("name", CAPTURED)
def test_without_the_extra_tables_say_how_to_get_it(
    built: Path, install: Callable[..., Path], name: str, tmp_path: Path
) -> None:
    python = install(*files_of(built, name, ".whl")) / "python"
    run(python, "-W", "error", "-c", f"import {name}.recordings", cwd=tmp_path)
    done = ran(python, "-c", f"import {name}.tables", status=1, cwd=tmp_path)
    message = done.stderr.splitlines()[-1]
    assert message.startswith("ImportError: numpy is needed here, and cannot be imported (")
    assert message.endswith(f"): pip install '{name}[tables]'")


GUIDES = {
    "README.md": "# Boards\n\nAll of them.\n\n## Learn\n\n- [First steps](first.md): to begin.\n",
    "first.md": "# First steps\n\n```python\nprint(1)\n```\n",
}


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
def test_the_generator_builds_a_site_where_nothing_else_of_ours_is(
    built: Path, install: Callable[..., Path], ending: str, tmp_path: Path
) -> None:
    programs = install(*files_of(built, "framegen", ending))
    for folder, files in {"docs": GUIDES, "spec": {}}.items():
        (tmp_path / folder).mkdir()
        for name, text in files.items():
            (tmp_path / folder / name).write_text(text, encoding="utf-8")
    shutil.copy(ROOT / "spec" / "busservo.yaml", tmp_path / "spec")
    (tmp_path / "pyproject.toml").touch()
    run(programs / "framegen", "docs", "--out", "site", cwd=tmp_path)
    reference = tmp_path / "site" / "reference" / "busservo"
    assert (tmp_path / "site" / "first.html").is_file()
    workbench = (reference / "decoder.html").read_text(encoding="utf-8")
    for name in ("strip", "workbench"):
        script = ROOT / "codegen" / "framegen" / "site" / "static" / "js" / f"{name}.js"
        assert script.read_text(encoding="utf-8").splitlines()[-1] in workbench
    assert "@media print" in workbench
    assert "data:image/svg+xml," in workbench
    run(programs / "framegen", "docs", "spec/busservo.yaml", "--out", "alone", cwd=tmp_path)
    assert (tmp_path / "alone" / "index.html").is_file()


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
def test_the_generator_alone_begins_a_project(
    built: Path, install: Callable[..., Path], ending: str, tmp_path: Path
) -> None:
    """What is installed of it is held by test_installed_project.py."""
    programs = install(*files_of(built, "framegen", ending))
    run(programs / "framegen", "new", "kiln", cwd=tmp_path)
    run(programs / "framegen", "generate", "kiln/spec/kiln.yaml", cwd=tmp_path)
    run(programs / "framegen", "generate", "--check", cwd=tmp_path / "kiln")
    carried = tmp_path / "kiln" / "generated" / "kiln" / "_runtime"
    assert "# licence: MIT License\n" in (carried / "VENDORED.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("ending", [".whl", ".tar.gz"])
def test_all_packages_run_together(
    built: Path, install: Callable[..., Path], ending: str, tmp_path: Path
) -> None:
    programs = install(*(path for name in FOLDERS for path in files_of(built, name, ending)))
    pip("--python", programs / "python", "check", cwd=tmp_path)
    ours = FOLDERS.keys() - GENERATED  # the version of those is that of their spec
    versions = {run(programs / name, "--version", cwd=tmp_path).split()[1] for name in ours}
    assert {version.rstrip(",") for version in versions} == {
        files_of(built, "framegen", ".whl")[0].name.split("-")[1]
    }
    for device in DEVICES.values():
        run(programs / "python", "-W", "error", "-c", device, cwd=tmp_path)
    # The generator works with the runtime that it was made with, whatever libraries bring theirs.
    whose = "import framegen, framewire; print(framewire.__file__)"
    found = run(programs / "python", "-c", whose, cwd=tmp_path)
    assert Path(found).parts[-4:-1] == ("framegen", "_runtime", "framewire")
    (tmp_path / "spec").mkdir()
    shutil.copy(ROOT / "spec" / "busservo.yaml", tmp_path / "spec")
    (tmp_path / "pyproject.toml").touch()
    shared = ["generate", "--runtime", "shared"]
    run(programs / "framegen", *shared, cwd=tmp_path)
    run(programs / "framegen", *shared, "--check", cwd=tmp_path)
    made = tmp_path / "generated" / "busservo"
    for file in (ROOT / "generated" / "busservo").rglob("*.py"):
        same = made / file.relative_to(ROOT / "generated" / "busservo")
        assert same.read_bytes() == file.read_bytes(), file
