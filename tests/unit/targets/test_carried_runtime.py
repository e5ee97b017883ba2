"""A library that carries the runtime, and a copy of the runtime, where nothing else of ours is.

Each runs in a Python of its own, which has no `framewire`: started with `-S`, it looks up nothing
that is installed.
"""

import sys
import sysconfig
from dataclasses import replace
from pathlib import Path

import pytest
from framegen import __version__
from framegen.render import render, render_target
from framegen.targets import python

from tests.factories import BUSSERVO, DEMO, ROOT, compiled_file, vectors_of, write_files
from tests.programs import ran
from tests.protocols.specs import FILES
from tests.unit.conformance.harness import cases_of, differences, run

SHARED = ROOT / "runtime" / "framewire"
LXSERVO = ROOT / "spec" / "lxservo.yaml"
# One that asks and answers, one bus, one with floating-point numbers, text and lists, and one that
# has all kinds of frames.
SPECS = {"busservo": BUSSERVO, "lxservo": LXSERVO, "greenhouse": DEMO}
SPECS["everything"] = FILES["everything"]

# What a package is called by here: as it is, or as one that others have put into theirs.
NAMES = ["lxservo", "vendored.of_others.lxservo"]

ALONE = """
import sys
from importlib.util import find_spec

sys.path.insert(0, sys.argv.pop(1))
assert find_spec("framewire") is None
"""

ANSWER = """
from importlib import import_module

main = import_module(f"{sys.argv[1]}.__main__").main
sys.exit(main(["answer"]))
"""

CONVERSATION = """
import NAME as library

class Servo(library.Device):
    def on_position_read(self, message):
        return library.Position(servo_id=message.servo_id, position=640)

class Wire:
    name = "wire"
    servo = Servo()
    arrived = b""

    def read(self, timeout):
        data, self.arrived = self.arrived, b""
        return data

    def write(self, data):
        self.arrived += self.servo.receive(data)

    def drain(self, timeout):
        pass

    def close(self):
        pass

with library.Controller(Wire(), background=False, reply_timeout=0.02) as client:
    assert client.read_position(7) == 640
    try:
        client.read_voltage(7)
    except library.NoReplyError as error:
        assert error.request == library.VoltageRead(servo_id=7)
    else:
        raise AssertionError("nobody answers that")
"""

ERRORS = """
import pickle
import traceback
import NAME as library

kinds = [getattr(library, name) for name in dir(library) if name.endswith("Error")]
assert len(kinds) > 15, kinds
for kind in kinds:
    assert kind.__module__ == "NAME", kind
    assert pickle.loads(pickle.dumps(kind)) is kind
error = library.PortBusyError("COM7", "it is in use", "close the other program", 16)
assert "".join(traceback.format_exception_only(error)).startswith("NAME.PortBusyError: COM7: ")
twin = pickle.loads(pickle.dumps(error))
assert (type(twin), str(twin), twin.errno) == (type(error), str(error), 16)
try:
    library.decode(b"", library.Direction.SERVO_TO_HOST)
except library.DecodeError as error:
    assert pickle.loads(pickle.dumps(error)).reason is library.Reason.TOO_SHORT
"""

COPY = """
import pickle
from importlib import import_module
from pkgutil import walk_packages

import NAME as copy

modules = [each.name for each in walk_packages(copy.__path__, "NAME.")]
assert len(modules) > 200, modules
for name in modules:
    import_module(name)
assert not [name for name in sys.modules if name.partition(".")[0] == "framewire"]
assert copy.TransportError.__module__ == "NAME"
assert pickle.loads(pickle.dumps(copy.TransportError)) is copy.TransportError
"""


def carrying(spec: Path) -> dict[str, str]:
    """Return the library of a spec, with the runtime in it."""
    return render_target(python.TARGET, replace(compiled_file(spec), carries_runtime=True))


def put(files: dict[str, str], below: Path, name: str) -> None:
    """Write the files of a package so that it is imported by this name."""
    folder = below.joinpath(*name.split("."))
    write_files(files, folder)
    for above in folder.relative_to(below).parents[:-1]:
        (below / above / "__init__.py").touch()


def package_of(files: dict[str, str]) -> dict[str, str]:
    """Return the files of a library by path below its package."""
    return {path.split("/", 2)[2]: text for path, text in files.items()}


def alone(script: str, *words: object) -> list[str]:
    """Return the command that runs a script in a Python with nothing that is installed."""
    return [sys.executable, "-I", "-S", "-W", "error", "-c", ALONE + script, *map(str, words)]


def assert_runs(script: str, *words: object) -> None:
    assert ran(*alone(script, *words)).stderr == ""


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Return where libraries that carry the runtime stand side by side."""
    made = tmp_path_factory.mktemp("alone")
    for name, spec in SPECS.items():
        put(package_of(carrying(spec)), made, name)
    put(package_of(carrying(LXSERVO)), made, NAMES[1])
    return made


@pytest.mark.parametrize("name", [*SPECS, NAMES[1]])
def test_it_says_what_the_vectors_say(name: str, folder: Path) -> None:
    cases = [*cases_of(vectors_of(compiled_file(SPECS[name.rpartition(".")[2]])))]
    answers = run(alone(ANSWER, folder, name), [case.question for case in cases])
    assert differences(cases, answers) == []


@pytest.mark.parametrize("name", NAMES)
def test_its_client_converses_and_its_errors_are_named_as_they_are_imported(
    name: str, folder: Path
) -> None:
    assert_runs((CONVERSATION + ERRORS).replace("NAME", name), folder)


def test_a_library_that_shares_the_runtime_does_not_run_alone(tmp_path: Path) -> None:
    """Else the tests above would hold of any."""
    write_files(render_target(python.TARGET, compiled_file(LXSERVO)), tmp_path)
    done = ran(*alone(ERRORS.replace("NAME", "lxservo"), tmp_path / "generated"), status=1)
    error, place = done.stderr.splitlines()[-1], "in a clone, pip install . ./generated/lxservo"
    said = "lxservo needs the package framewire, which comes with its project"
    assert error == f"ModuleNotFoundError: {said}: {place}"


@pytest.mark.parametrize("name", ["wire", "vendored.of_others.wire"])
def test_a_copy_of_the_whole_runtime_works_below_any_name(name: str, tmp_path: Path) -> None:
    texts = {
        file.relative_to(SHARED).as_posix(): file.read_text(encoding="utf-8")
        for file in SHARED.rglob("*.py")
    }
    put(texts, tmp_path, name)
    # What others have installed is found there, and nothing of ours, which is only linked to.
    others = f"sys.path.append({sysconfig.get_path('purelib')!r})\n"
    assert_runs(others + COPY.replace("NAME", name), tmp_path)


def test_all_of_the_runtime_is_in_the_library_as_it_is() -> None:
    files = render(replace(compiled_file(DEMO), carries_runtime=True)).files
    below = "generated/greenhouse/_runtime/"
    carried = {path: text for path, text in files.items() if path.startswith(below)}
    record = carried.pop(f"{below}VENDORED.txt")
    assert {f"# framegen: {__version__}", "# licence: MIT License"} <= {*record.splitlines()}
    assert [line.partition("  ")[2] for line in record.splitlines() if line[0] != "#"] == sorted(
        path.removeprefix(below) for path in carried
    )
    assert carried == {
        f"{below}{file.relative_to(SHARED).as_posix()}": file.read_text(encoding="utf-8")
        for file in SHARED.rglob("*")
        if file.suffix in {".py", ".typed"} or file.name == "LICENSE"
    }


def test_what_carries_the_runtime_differs_from_what_shares_it_in_its_imports_alone() -> None:
    shared = render(compiled_file(DEMO)).files
    carried = render(replace(compiled_file(DEMO), carries_runtime=True)).files
    own = {path: text for path, text in carried.items() if "/_runtime/" not in path}
    assert own.keys() == shared.keys()
    assert not [path for path, text in own.items() if "framewire" in text]
    differing = [path for path in own if own[path] != shared[path]]
    assert "generated/greenhouse/_codec.py" in differing
    for path in differing:
        assert lines(own[path].replace("._runtime", "framewire")) == lines(shared[path]), path


def lines(text: str) -> list[str]:
    """Return the lines of a module in any order: linters want imports of each kind together."""
    return sorted(line for line in text.split("\n") if line)


@pytest.mark.parametrize(
    ("carries", "said"),
    [(True, "\npip install .\n"), (False, "\npip install . ./generated/lxservo\n")],
)
def test_its_readme_says_how_it_is_installed(carries: bool, said: str) -> None:
    files = render(replace(compiled_file(LXSERVO), carries_runtime=carries)).files
    assert said in files["generated/lxservo/README.md"]
