"""Specs as data that tests can change, and the files and libraries made from them."""

import importlib
import json
import linecache
import re
import sys
from collections.abc import Iterator, Mapping
from contextlib import ExitStack, contextmanager
from functools import cache, cached_property, lru_cache
from importlib.abc import Loader, MetaPathFinder
from importlib.machinery import ModuleSpec
from importlib.util import spec_from_file_location
from pathlib import Path
from types import CodeType, ModuleType
from typing import Any, TypeAlias

from framegen.compile import Compiled, compile_loaded, compile_spec
from framegen.language.load import Loaded, read_source
from framegen.language.spec import Spec
from framegen.language.values import Scale
from framegen.model.model import Model
from framegen.reading.source import Source
from framegen.reading.yamltree import Tree, Unusable, read_tree
from framegen.render import render_target
from framegen.targets import python, vectors
from framewire.explain import words
from framewire.protocol.words import Scale as Unit
from pydantic import ValidationError

from tests.guide_specs import SPECS

ROOT = Path(__file__).parents[1]
BUSSERVO = ROOT / "spec" / "busservo.yaml"
# The specs as they were when guides, and what libraries do, were last written down: a change of the
# protocol changes neither. A released edition is one, where there is one of that day.
FROZEN = {
    "busservo": ROOT / "tests" / "specs" / "frozen" / "spec" / "busservo.yaml",
    "lxservo": ROOT / "spec" / "released" / "lxservo-1.0.1.yaml",
}
DEMO = ROOT / "tests" / "specs" / "demo.yaml"

FIRST = frozenset(
    [
        *("ServoMove", "ServoUnload", "ServoPositionsRead", "ServoPositions"),
        *("ActionGroupRun", "ActionGroupStop", "ActionGroupSpeed"),
        *("ActionGroupStarted", "ActionGroupStopped", "ActionGroupCompleted"),
        *("BatteryVoltageRead", "BatteryVoltage"),
    ]
)

# A command that busservo does not have, as its spec would declare it.
NEW_MESSAGE = """\
  HornBlow:
    id: 201
    direction: host -> controller
    summary: Blow the horn on the board.
    cite: vendor, section 1.8
    length: 5
    fields:
      times: {type: u8, about: How many times.}
      pause_ms: {type: u16, unit: ms, about: How long the pause between two of them is.}
    examples:
      - title: Blow twice, 300 ms apart
        hex: 55 55 05 C9 02 2C 01
        values: {times: 2, pause_ms: 300}
        cite: vendor, section 1.8, example 1

"""

Data: TypeAlias = dict[str, Any]
Steps: TypeAlias = tuple[str | int, ...]


def data_of(file: Path) -> Data:
    return _values(read_source(file))


def data_in(text: str) -> Data:
    """Return the values of the text of a spec, or of a part of one."""
    return _values(Source("made_up.yaml", text))


def _values(source: Source) -> Data:
    return read_tree(source)[0].data


def first_edition() -> Data:
    """What the spec says of the messages with which it began.

    Codecs and boards that were written by hand know these, and no message that came later.
    """
    data = data_of(BUSSERVO)
    messages = data["messages"]
    return {**data, "messages": {name: messages[name] for name in messages if name in FIRST}}


@cache
def first_model() -> Model:
    return layout_of(first_edition())


def kiln() -> Data:
    """Return the values of the first spec that the language guide puts together."""
    return _values(SPECS["kiln"])


def small_spec(
    name: str, frame: Data, messages: Data, *, ends: str = "host device", byte_order: str = "little"
) -> Data:
    """Return a spec that cites `manual`; `frame` has the parts of one kind of frame, or kinds."""
    one = all("is" in part for part in frame.values())
    about = {"title": "A protocol", "authority": "manual", "summary": "It is small."}
    return {
        "framegen": 2,
        "protocol": {"name": name, "version": "1.0.0", **about},
        "sources": {"manual": {"title": "A manual", "kind": "document"}},
        "endpoints": dict.fromkeys(ends.split(), "An end."),
        "link": {"baud": 9600},
        "byte_order": byte_order,
        "frame" if one else "frames": frame,
        "messages": messages,
    }


def yaml_of(value: object) -> str:
    """Return `value` as YAML, every text in double quotes and in ASCII, whatever it holds."""
    # JSON is YAML, but for two surrogates in the place of one character, a control as it is, and
    # numbers without a point in front of their exponent.
    text = _WORD.sub(_pointed, json.dumps(value, ensure_ascii=False))
    return _NOT_PLAIN.sub(_escaped, text)


_NOT_PLAIN = re.compile(r"[^ -~]")
_WORD = re.compile(r'"(?:[^"\\]|\\.)*"|(?<![.0-9])(?P<whole>-?[0-9]+)(?P<exponent>e[-+]?[0-9]+)')


def _pointed(found: re.Match[str]) -> str:
    return f"{found['whole']}.0{found['exponent']}" if found["whole"] else found[0]


def _escaped(found: re.Match[str]) -> str:
    code = ord(found[0])
    return f"\\u{code:04x}" if code < 0x10000 else f"\\U{code:08x}"


def compiled_of(data: Data, name: str = "made_up.yaml") -> Compiled:
    """Compile `data`, by way of its text. Raises Unusable."""
    return compile_spec(Source(name, yaml_of(data)))


def in_larger_unit(text: str, value: float) -> str:
    """Return a value as an explanation has it, in the unit of a scale."""
    scale = Scale.parse(text)
    unit = Unit(f"{scale.step:f}", scale.unit, f"{scale.offset:f}")
    return f"{words.scaled(unit, value):f} {scale.unit}".rstrip()


@cache
def compiled_file(file: Path) -> Compiled:
    """Compile a spec file, once in a process: what is compiled never changes."""
    return compile_spec(read_source(file))


def is_misfit(data: Data) -> bool:
    """Tell whether a spec does not fit the language, which is a finding whatever else it says."""
    try:
        Spec.model_validate(data)
    except ValidationError:
        return True
    return False


def compiled_values(data: Data) -> Compiled:
    """Compile `data` without its text: no finding has a place. Raises ValidationError."""
    values = json.loads(json.dumps(data))
    source = Source("made_up.yaml", "")
    return compile_loaded(Loaded(source, Tree(values), Spec.model_validate(values), []))


def rules_broken(data: Data) -> list[str]:
    """Return the rules that a spec breaks, or `unusable` for one that cannot be read at all."""
    try:
        return [finding.rule for finding in compiled_of(data).findings]
    except Unusable:
        return ["unusable"]


def layout_of(data: Data) -> Model:
    compiled = compiled_of(data)
    assert [finding.message for finding in compiled.findings] == []
    return compiled.model


def files_of(data: Data, name: str = "made_up.yaml") -> dict[str, str]:
    """Return the library of a spec without findings."""
    return library_files(compiled_of(data, name))


def library_files(compiled: Compiled) -> dict[str, str]:
    assert [finding.message for finding in compiled.findings] == []
    return render_target(python.TARGET, compiled)


@cache
def library_of(file: Path) -> Mapping[str, str]:
    """Return the library of a spec file, rendered once in a process; nobody changes it."""
    return library_files(compiled_file(file))


def vectors_of(compiled: Compiled) -> dict[str, Any]:
    """Return the test vectors of a protocol, as they are published."""
    (text,) = render_target(vectors.TARGET, compiled).values()
    assert text.isascii()
    document: dict[str, Any] = json.loads(text)
    return document


def write_files(files: Mapping[str, str], folder: Path) -> None:
    """Write texts below `folder`, as they are, with the folders that they need."""
    for above in {path.rpartition("/")[0] for path in files}:
        (folder / above).mkdir(parents=True, exist_ok=True)
    for path, text in files.items():
        # The shortest way: a library has two hundred files, and tests make hundreds of libraries.
        with open(f"{folder}/{path}", "wb") as file:  # noqa: PTH123
            file.write(text.encode())


class _Library(MetaPathFinder, Loader):
    """A finder and loader of one library, from memory."""

    def __init__(self, files: Mapping[str, str], folder: Path) -> None:
        self._folder = folder / "generated"
        self._texts = {str(folder / path): text for path, text in files.items()}

    def find_spec(self, fullname: str, _path: object, _target: object = None) -> ModuleSpec | None:
        file = self._file(fullname)
        return spec_from_file_location(fullname, file, loader=self) if file in self._texts else None

    def exec_module(self, module: ModuleType) -> None:
        file = self._file(module.__name__)
        text = self._texts[file]
        exec(_code_at(file, _compiled(text)), vars(module))  # noqa: S102 - it is our own

    def is_package(self, fullname: str) -> bool:
        return Path(self._file(fullname)).name == "__init__.py"

    def get_source(self, fullname: str) -> str:
        return self._texts[self._file(fullname)]

    def get_data(self, path: str) -> bytes:
        return self._texts[path].encode()

    def forget_lines(self) -> None:
        """Let nobody take lines of another library of that name for lines of this one."""
        for file in self._texts:
            linecache.cache.pop(file, None)

    def _file(self, fullname: str) -> str:
        place = self._folder.joinpath(*fullname.split("."))
        package = str(place / "__init__.py")
        return package if package in self._texts else f"{place}.py"


# Most modules are the same in every library; those of its own are not asked for again.
@lru_cache(maxsize=512)
def _compiled(text: str) -> CodeType:
    return compile(text, "made", "exec", dont_inherit=True)


def _code_at(path: str, code: CodeType) -> CodeType:
    """Return code as if it had been compiled from the file at `path`."""
    inner = (_code_at(path, it) if isinstance(it, CodeType) else it for it in code.co_consts)
    return code.replace(co_filename=path, co_consts=tuple(inner))


@contextmanager
def imported(*libraries: Mapping[str, str], folder: Path | None = None) -> Iterator[None]:
    """Import libraries under their own names, until the end."""
    with ExitStack() as until:
        for files in libraries:
            until.enter_context(library(files, folder))
        yield


def look_up_all(handed: ModuleType) -> None:
    """Have a library look up by name, while that is its own, what it looks up once."""
    for each in (handed.CODEC, handed.LIBRARY):
        for name, declared in vars(type(each)).items():
            if isinstance(declared, cached_property):
                getattr(each, name)


@contextmanager
def library(files: Mapping[str, str], folder: Path | None = None) -> Iterator[ModuleType]:
    """Return the library among `files`, imported, and forgotten again.

    They are also written below `folder`, if one is given.
    """
    if folder is not None:
        write_files(files, folder)
    name = next(path for path in files if path.endswith("/py.typed")).split("/")[1]
    # Another test may have imported a library of the same name, whose parts are its own.
    if f"{name}._library" in sys.modules:
        look_up_all(sys.modules[f"{name}._library"])
    before = {key: sys.modules.pop(key) for key in [*sys.modules] if key.split(".")[0] == name}
    # Data is asked for by its whole path.
    finder = _Library(files, (folder or Path("made")).absolute())
    sys.meta_path.insert(0, finder)
    finder.forget_lines()
    try:
        yield importlib.import_module(name)
    finally:
        sys.meta_path.remove(finder)
        for module in [module for module in sys.modules if module.split(".")[0] == name]:
            del sys.modules[module]
        sys.modules.update(before)
        finder.forget_lines()
