"""The library of one protocol mentions no other: no word, no verb, no version."""

import ast
import importlib
import io
import re
import shutil
import sys
import tokenize
from collections.abc import Iterator, Mapping, Sequence
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from framegen import __version__
from framegen.language.command_verbs import OF_POSES
from framegen.render import render_target
from framegen.targets.vectors import TARGET as VECTORS

from tests.commands import called
from tests.factories import BUSSERVO, DEMO, ROOT, Data, compiled_file, data_of, imported, library_of
from tests.mutations.places import texts
from tests.programs import ran

# One that asks and answers, one with poses, a sensor that only reports, a lamp that only obeys.
FILES = [DEMO, *(DEMO.with_name(f"{name}.yaml") for name in ("blinds", "weather", "lamp"))]
OTHERS = {data_of(file)["protocol"]["name"]: file for file in FILES}

# Names in busservo's spec that are plain English, words of the language that specs are written in,
# or (`time_ms`) a key in files of poses, and may stand in any library.
PLAIN = {"absent", "all", "group", "host", "percent", "position", "positions", "targets", "times"}
PLAIN |= {"time_ms"}
# What is said of servos, of the boards that drive them, and of those who make them.
SAID = (
    *(r"\w*servos?\w*", "arms?", "boards?", "grippers?", "robots?", "handsets?", "LED2"),
    *("batter(?:y|ies)", "voltages?", "buzzers?", "beeps?", "torque", "action groups?"),
    *("hiwonder", "lewansoul", "xarm", "le-?arm", r"lx-?\w+", r"lsc-?\w*", "(?:the|a) host"),
    *("9600", "55 55", "5555", "0x55"),
)


def names_in(value: Any) -> Iterator[str]:
    """Yield the names that a spec gives: of messages, fields, elements, values, methods."""
    for name, message in value["messages"].items():
        yield from (name, message.get("vendor_name", name))
        yield from re.findall(r"\w+", message.get("method", ""))
        yield from _fields_in(message.get("fields", {}))
    yield from value["endpoints"]
    yield value["protocol"]["name"]
    yield from (name for name in value.get("pose", {}).values() if name.isidentifier())


def _fields_in(fields: Data) -> Iterator[str]:
    for name, field in fields.items():
        yield from (name, field.get("element", name), *field.get("values", {}))
        yield from _fields_in(field.get("fields", {}))


def forbidden(spec: Data) -> re.Pattern[str]:
    """Return the words of busservo that another spec does not say itself."""
    own = " ".join(text for _, text in texts(spec)) + " ".join(names_in(spec))
    names = {*names_in(data_of(BUSSERVO))} - PLAIN - {"controller"}
    words = [word for word in [*names, *SAID] if not re.search(rf"(?i)\b(?:{word})\b", own)]
    # `Controller` is a class of each library, whose instances examples call `controller`.
    prose_alone = r"(?-i:controller)(?![.]\w)"
    return re.compile(rf"(?i)(?<!\w)(?:{'|'.join([*words, prose_alone])})(?!\w)")


@cache
def prose(text: str) -> tuple[str, ...]:
    """Return every line of the docstrings, other text and comments of a module."""
    lines = []
    for node in ast.walk(ast.parse(text)):
        # What is a name is code, such as that of a module in a table of modules.
        if isinstance(node, ast.Constant) and isinstance(node.value, str):
            lines += [] if node.value == "._controller" else node.value.split("\n")
    for token in tokenize.generate_tokens(io.StringIO(text).readline):
        if token.type == tokenize.COMMENT:
            lines.append(token.string)
    return tuple(lines)


# Names of the client in the programs that a library's reference shows.
CODE = re.compile(
    r"\bopen_controller\b|\bas controller:|\bcontroller\.\w+\(|socket://host:port|rfc2217://host:port"
)


def mentions(files: Mapping[str, str], words: re.Pattern[str]) -> list[str]:
    """Return where one of the words stands."""
    return [
        f"{path}: {line.strip()}"
        for path, text in files.items()
        for line in lines_of(path, text)
        if words.search(CODE.sub("", line))
    ]


def lines_of(path: str, text: str) -> Sequence[str]:
    """Return the lines in which a file can mention something."""
    if not path.endswith((".py", ".pyi")):
        return text.split("\n")
    # Below the banner, most modules are the same in all libraries, and looked through once.
    banner, _, module = text.partition("\n")
    return (banner, *prose(module))


@pytest.mark.parametrize("name", OTHERS)
def test_no_library_mentions_another_protocol(name: str) -> None:
    compiled = compiled_file(OTHERS[name])
    files = {**library_of(OTHERS[name]), **render_target(VECTORS, compiled)}
    assert mentions(files, forbidden(data_of(OTHERS[name]))) == []


def test_the_words_of_a_protocol_are_found_in_its_own_library() -> None:
    """Else the test above would hold for want of words, or of eyes."""
    found = mentions(library_of(BUSSERVO), forbidden(data_of(DEMO)))
    for word in ("ServoMove", "servo_ids", "servo", "battery", "CMD_SERVO_MOVE", "controller"):
        assert any(word in line for line in found), word


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Path]:
    """Return where the libraries of the others stand side by side; they are imported as well."""
    made = tmp_path_factory.mktemp("others")
    with imported(*map(library_of, OTHERS.values()), folder=made):
        yield made / "generated"


def call(name: str, *words: str) -> tuple[int, str]:
    """Call the command of a library in this process, for its status and output."""
    return called(importlib.import_module(f"{name}.__main__").main, *words)[:2]


def command(folder: Path, *words: str) -> tuple[int, str, str]:
    """Call a command in a process of its own."""
    done = ran(sys.executable, "-m", *words, status=None, cwd=folder)
    return done.returncode, done.stdout, done.stderr


def verbs_in(shown: str) -> list[str]:
    """Return the verbs that are listed in the help of a command."""
    table = shown.partition("\nverbs:\n")[2].partition("\n\n")[0]
    return [line.split()[0] for line in table.split("\n")]


HEARING = [
    *("answer", "decode", "docs", "doctor", "encode", "explain", "monitor", "ports", "simulate"),
    "stats",
]
OF_BLINDS = ["blinds-release", "read-heights", "roll"]


LOOKING = ["port", "hid", "permission", "busy", "opening", "silence"]
REQUESTING = ["rate", "echo", "reply", "round-trip"]
SENDING = [*HEARING, "replay", "send"]
# The verbs of a library, and the checks of its doctor.
OFFERED = {
    "greenhouse": (["bench-line", *SENDING, "station-read", "vents-open"], REQUESTING),
    "blinds": (["bench-line", *SENDING, *OF_POSES, *OF_BLINDS], ["present"]),
    "weather": (HEARING, []),
    "stage_lamp": ([*SENDING, "colour-show", "darken"], []),
}


@pytest.mark.parametrize("name", OFFERED)
@pytest.mark.usefixtures("folder")
def test_only_what_can_work_is_offered(name: str) -> None:
    verbs, _ = OFFERED[name]
    status, shown = call(name, "--help")
    assert (status, sorted(verbs_in(shown))) == (0, sorted(verbs))
    for verb in verbs:
        status, shown = call(name, verb, "--help")
        assert (status, shown.startswith(f"usage: {name} {verb} ")) == (0, True)
        assert f"\nexamples:\n  {name} {verb}" in shown


@pytest.mark.parametrize("name", OFFERED)
@pytest.mark.usefixtures("folder")
def test_the_doctor_makes_only_checks_that_can_find_something(name: str) -> None:
    checks = [*LOOKING, *OFFERED[name][1], "look-alike"]
    _, shown = call(name, "doctor", "--help")
    listed = shown.partition("Makes these checks, one after the other:\n")[2].partition(".\n")[0]
    assert listed.split(", ") == checks
    _, shown = call(name, "doctor", "--port", "no-such-port")
    assert [line.split()[1] for line in shown.splitlines() if line[0] != " "] == checks


@pytest.mark.usefixtures("folder")
def test_help_speaks_of_no_verb_and_no_reply_that_there_is_not() -> None:
    assert "replay" not in call("weather", "monitor", "--help")[1]
    assert "reply" not in call("stage_lamp", "--help")[1]
    assert "print the reply" in call("greenhouse", "--help")[1]


def test_a_simulator_that_is_installed_takes_the_place_of_the_derived_one(folder: Path) -> None:
    status, shown, _ = command(folder, "greenhouse", "simulate", "--help")
    assert (status, "--every" in shown) == (0, True)
    package = folder / "greenhouse_simulator"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "cli.py").write_text("def main(words, program): print(program, words)\n")
    try:
        said = command(folder, "greenhouse", "simulate", "--fast")
        assert said == (0, "greenhouse simulate ['--fast']\n", "")
    finally:
        shutil.rmtree(package)


def install(folder: Path, version: str, origin: str = "") -> None:
    """Write the metadata of an installed distribution of the greenhouse to a folder."""
    info = folder / f"greenhouse-{version}.dist-info"
    info.mkdir(parents=True)
    text = f"Metadata-Version: 2.1\nName: greenhouse\nVersion: {version}\n"
    (info / "METADATA").write_text(text)
    if origin:
        (info / "direct_url.json").write_text(origin)


def version_of(folder: Path, *installed: Path) -> str:
    program = (
        f"import sys; sys.path[:0] = {[*map(str, (folder, *installed, ROOT / 'runtime'))]!r}; "
        "import greenhouse; assert 'importlib.metadata' not in sys.modules; "
        "print(greenhouse.__version__)"
    )
    return ran(sys.executable, "-S", "-c", program).stdout.strip()


ELSEWHERE = '{"url": "file:///elsewhere", "dir_info": {"editable": true}}'


def test_the_version_is_that_of_what_is_installed(folder: Path, tmp_path: Path) -> None:
    assert version_of(folder) == "1.1.0"
    install(folder, "7.8.9")
    try:
        assert version_of(folder) == "7.8.9"
    finally:
        shutil.rmtree(folder / "greenhouse-7.8.9.dist-info")
    here = ELSEWHERE.replace("file:///elsewhere", folder.parent.as_uri())
    install(tmp_path / "edited", "7.8.10", here)
    assert version_of(folder, tmp_path / "edited") == "7.8.10"


@pytest.mark.parametrize(
    "origin", ["", ELSEWHERE, '{"url": "https://example.org", "archive_info": {}}']
)
def test_a_copy_beside_what_is_installed_has_the_version_of_its_spec(
    folder: Path, tmp_path: Path, origin: str
) -> None:
    install(tmp_path, "7.8.9", origin)
    assert version_of(folder, tmp_path) == "1.1.0"
    said = f"greenhouse 1.1.0, spec 1.1.0, shared runtime {__version__}\n"
    assert command(folder, "greenhouse", "--version") == (0, said, "")


def test_no_module_is_the_same_in_another_library() -> None:
    """What does not depend on the protocol is in the runtime: nobody generates it."""
    first, second = (
        {
            file.name: file.read_text(encoding="utf-8").replace(name, "NAME")
            for file in (ROOT / "generated" / name).glob("*.py")
        }
        for name in ("busservo", "lxservo")
    )
    alike = {name for name, text in first.items() if second.get(name) == text}
    assert [name for name in sorted(alike) if first[name].count("\n") > 10] == []
