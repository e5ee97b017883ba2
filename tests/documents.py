"""Run the examples in our pages as a reader would, and compare what they print.

Fenced blocks are run from the top of a page to its end, in a copy of the project: `console`
(commands after `$`, with what they print), `pycon` (a Python session), `python` (a program),
`output` (what the last program printed) and `diff`, which is applied to the file that it names.
Where a page uses git, the copy is a repository in which all is committed.
Each program and each session begins with nothing, so that it runs wherever a reader pastes it. One
that begins with `# NAME.py` is saved by that name, and `$ python NAME.py` runs it.
A program with `if __name__ == "__main__":` starts processes, and is one of its own.
A block whose language is followed by `slow` is run only where that is asked for.
A command is a process of its own once a page has changed what it is made of, and runs in this one
until then, as its entry point does: for most pages, starting it would be most of the work.
Whatever port a command or a program opens, a virtual board is there: one for the whole page, which
finds every motion over when the next block begins, as reading takes longer than moving.
Output may leave lines out with `...`; all else must agree to the letter.
Pages are played with the specs of `FROZEN`, and with libraries of these, so that a new message
rewrites none. Where they are to show today's, copy spec/busservo.yaml to tests/specs/frozen/spec.

    python -m tests.documents

writes what is really printed into the pages.
"""

import contextlib
import doctest
import io
import os
import re
import shlex
import shutil
import sys
import tempfile
import traceback
from collections.abc import Callable, Collection, Iterator, Sequence
from functools import cached_property, partial
from importlib import import_module
from itertools import product
from pathlib import Path
from subprocess import PIPE, STDOUT
from types import ModuleType
from typing import Any
from unittest import mock

import framegen.cli
from framewire.simulator.clock import RealClock

from tests.factories import FROZEN, imported, library_of
from tests.programs import ran
from tests.timeouts import GENEROUS, undoubted

ROOT: Path = Path(__file__).parents[1]
# tests/unit/simulator/test_guide.py plays the guide to testing, which needs files of its own.
_GUIDE = ROOT / "docs" / "test-your-robot.md"
_GUIDES = sorted({*(ROOT / "docs").glob("*.md")} - {_GUIDE})
PAGES = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *_GUIDES]

# A page need not say that the machine on which it is tried may be busy.
TIMEOUTS = {"reply_timeout": GENEROUS, "settle": 0}
TIMEOUT_OPTIONS = {
    verb: ["--timeout", str(GENEROUS)] for verb in ("bench-line", "conform", "doctor", "send")
}

# The servos of a bus without a controller, the charge of the board's battery, and the seconds that
# no motion or group of a page outlasts.
SERVOS = (1, 2)
BATTERY_MV = 7500
LONGEST_MOTION = 5.0

# What examples read, and what follows from it, for those that change it.
_READ = ("spec", "docs", "tests/captures", ".gitignore")
_CHANGED = (
    *("generated", "runtime", "codegen", "simulator", "tests/witnesses.yaml", "tests/cases.py"),
    *("tests/oracle.py", "tests/contract/test_client_contract.py"),
)
_COMMANDS = ("framegen", *FROZEN)
# The released editions, which never change, of before the specs that pages are played with.
_EDITIONS = tuple(product(FROZEN, ("1.0.0", "1.0.1")))
_GIT_PROGRAM = shutil.which("git") or "git"
# Output and errors as a terminal shows them.
_SCREEN: dict[str, Any] = {"capture_output": False, "stdout": PIPE, "stderr": STDOUT}
# Whoever commits, and when, the same is printed.
_READER = {"NAME": "Reader", "EMAIL": "reader@example.org", "DATE": "2026-01-01T00:00:00Z"}
_GIT = {
    **{f"GIT_{who}_{what}": _READER[what] for who in ("AUTHOR", "COMMITTER") for what in _READER},
    **dict.fromkeys(["GIT_CONFIG_GLOBAL", "GIT_CONFIG_SYSTEM"], os.devnull),
    "GIT_PAGER": "cat",
    "COLUMNS": "80",
}
# What each of them is made of, by the folder at the top.
_GENERATED = {"spec", "codegen", "generated"}
_MADE_OF = {"busservo": _GENERATED, "framegen": {"codegen"}, "lxservo": _GENERATED}
_BLOCK = re.compile(
    r"^```(console|pycon|python|output|diff)( slow)?\n(.*?)^```$", re.MULTILINE | re.DOTALL
)
_ITS_OWN = 'if __name__ == "__main__":'
_SAVED = re.compile(r"# (\w+\.py)\n")
_TIMED = re.compile(r"(?:^.*\((?:\d+\.\d+ s(?:, )?)+\)\n)+", re.MULTILINE)
_COMMAND = re.compile(r"^\$ (.*)\n", re.MULTILINE)


def played(page: str, folder: Path, *, slow: bool = False) -> str:
    """Return the page with what its examples really print in `folder`, which they may change."""
    with _frozen_libraries(), _Bench() as bench:
        player = _Player(folder, bench)

        def really(block: re.Match[str]) -> str:
            kind, is_slow, text = block.groups(default="")
            truth = text if is_slow and not slow else player.play(kind, text)
            return f"```{kind}{is_slow}\n{truth}```"

        return _BLOCK.sub(really, page)


def copy_project(folder: Path, page: str) -> Path:
    """Copy all that the examples of a page work on, and return the copy."""
    litter = shutil.ignore_patterns("__pycache__")
    kinds = {kind for kind, _, _ in _BLOCK.findall(page)}
    for name in (*(_READ if kinds else ()), *(_CHANGED if "diff" in kinds else ())):
        if name == "spec":
            (folder / name).mkdir()
            for library, spec in FROZEN.items():
                shutil.copy(spec, folder / name / f"{library}.yaml")
            released = (f"released/{each}-{edition}.yaml" for each, edition in _EDITIONS)
            for file in ("framegen.schema.json", "framegen.manifest", *released):
                (folder / name / file).parent.mkdir(exist_ok=True)
                shutil.copy(ROOT / name / file, folder / name / file)
        elif (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, folder / name, ignore=litter)
        else:
            (folder / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / name, folder / name)
    if "diff" in kinds and _changed():
        with _at(folder), contextlib.redirect_stdout(None), contextlib.redirect_stderr(None):
            framegen.cli.main(["generate"])
    if "$ git " in page:
        committed(folder)
    return folder


def _changed() -> list[str]:
    """Return the libraries whose specs are no longer those that pages were written with."""
    today = {name: ROOT / "spec" / f"{name}.yaml" for name in FROZEN}
    return [name for name, file in FROZEN.items() if file.read_bytes() != today[name].read_bytes()]


@contextlib.contextmanager
def _frozen_libraries() -> Iterator[None]:
    """Have the libraries of these specs in the place of today's, with simulators on top of them."""
    changed = _changed()
    with imported(*(library_of(FROZEN[name]) for name in changed)):
        packages = {f"{name}_simulator" for name in changed}
        before = _forgotten(packages)
        try:
            yield
        finally:
            _forgotten(packages)
            sys.modules.update(before)


def _forgotten(packages: Collection[str]) -> dict[str, ModuleType]:
    """Have packages imported anew from now on, and return their modules."""
    names = [name for name in sys.modules if name.partition(".")[0] in packages]
    return {name: sys.modules.pop(name) for name in names}


def committed(folder: Path) -> None:
    """Make a repository of a folder, with all that is there in its first commit."""
    for words in (("init", "-q", "-b", "main"), ("add", "--all"), ("commit", "-q", "-m", "Begin")):
        _git(folder, words)


def _git(folder: Path, words: Sequence[str]) -> str:
    """Return what git prints."""
    return ran(_GIT_PROGRAM, *words, cwd=folder, environment=_GIT, **_SCREEN).stdout


class _FastClock(RealClock):
    """Faster than real time, and can be put forward: on a busy machine, no motion ends late."""

    def __init__(self) -> None:
        self._later = 0.0

    def now(self) -> float:
        """Return seconds."""
        return 1.5 * super().now() + self._later

    def put_forward(self, seconds: float) -> None:
        """Go on to a later time."""
        self._later += seconds


class _Bench(contextlib.ExitStack):
    """What a reader has: a board and, apart from it, a bus of servos, each from its first use."""

    def __init__(self) -> None:
        super().__init__()
        self._clock = _FastClock()

    @cached_property
    def board(self) -> Any:
        """A board with a stored group, which takes no longer than it must."""
        made = import_module("busservo_simulator")
        groups = {8: made.ActionGroup([made.Step(20, {2: 500})])}
        board = made.VirtualController(via="tcp", groups=groups, clock=self._clock)
        return self.enter_context(board)

    @cached_property
    def bus(self) -> Any:
        """A bus of servos."""
        made = import_module("lxservo_simulator")
        return self.enter_context(made.VirtualBus(via="tcp", servos=SERVOS, clock=self._clock))

    def settle(self) -> None:
        """End all motions, and charge the battery."""
        self._clock.put_forward(LONGEST_MOTION)
        if "board" in vars(self):
            battery = self.board.battery
            battery.full_mv += BATTERY_MV - battery.voltage_mv


class _Player:
    def __init__(self, folder: Path, bench: _Bench) -> None:
        self._folder = folder
        self._bench = bench
        self._names: dict[str, Any] = {}
        self._printed = ""
        self._of_servos = False
        # The folders that the page has changed so far.
        self._changed: set[str] = set()

    def play(self, kind: str, block: str) -> str:
        """Return the block as it really is."""
        self._bench.settle()
        self._of_servos = "lxservo" in block
        self._names = {"__name__": "__main__"}
        match kind:
            case "console":
                return self._console(block)
            case "pycon":
                return self._session(block)
            case "output":
                return _agreed(block, self._printed)
            case "python":
                if saved := _SAVED.match(block):
                    (self._folder / saved[1]).write_text(block, encoding="utf-8")
                self._printed = self._program(block)
            case _:
                self._changed.add(_apply(block, self._folder))
        return block

    def _program(self, source: str) -> str:
        """Return the output of a program that opens any port: a virtual board is there."""
        if _ITS_OWN in source:
            return self._process(source)
        output = io.StringIO()

        def at_board(opened: Callable[..., Any]) -> Callable[..., Any]:
            return lambda _port, **given: opened(self._bench.board.port, **TIMEOUTS | given)

        made = import_module("busservo")
        opening = mock.patch.multiple(
            made,
            open_controller=at_board(made.open_controller),
            open_async_controller=at_board(made.open_async_controller),
            Controller=partial(made.Controller, reply_timeout=GENEROUS),
        )
        with (
            opening,
            self._with_servos(),
            undoubted(),
            _at(self._folder),
            # What draws does so into files, wherever there is a screen.
            mock.patch.dict(os.environ, MPLBACKEND="Agg"),
            contextlib.redirect_stdout(output),
        ):
            exec(source, self._names)  # noqa: S102 - our own pages
        return output.getvalue()

    def _process(self, source: str) -> str:
        """Return the output of a program that is a process of its own."""
        (self._folder / "program.py").write_text(source, encoding="utf-8")
        return self._python("-W", "error", "program.py")

    def _with_servos(self) -> contextlib.AbstractContextManager[object]:
        """Have programs open the port of the servos, whatever they name."""
        if not self._of_servos:
            return contextlib.nullcontext()
        # At a slow rate: a servo of a busy machine begins to move later, but not as late as that.
        made = import_module("lxservo")
        settings = {"baud": 1200, "reply_timeout": GENEROUS, "settle": 0}
        opened = partial(made.open_controller, self._bench.bus.port, **settings)
        return mock.patch.object(made, "open_controller", lambda _port, **given: opened(**given))

    def _console(self, block: str) -> str:
        before, *parts = _COMMAND.split(block)
        assert not before, f"a console block begins with a command, not with {before!r}"
        shown = ""
        for command, expected in zip(parts[::2], parts[1::2], strict=True):
            shown += f"$ {command}\n" + _agreed(expected, self._run(command))
        return shown

    def _run(self, line: str) -> str:
        """Return what a terminal shows for a command line, which may hold pipes."""
        output = ""
        for command in line.split(" | "):
            name, *arguments = shlex.split(command)
            if name == "git":
                output = _git(self._folder, arguments)
            elif name == "python":
                (file,) = arguments
                output = self._program((self._folder / file).read_text(encoding="utf-8"))
            else:
                assert name in _COMMANDS, f"{name} is not run here: put it into a block of `sh`"
                output = self._command(name, arguments, output)
        return output

    def _command(self, name: str, words: list[str], given: str) -> str:
        """Return the output of a command, with servos or a virtual board at its port."""
        run = self._start if self._changed & _MADE_OF[name] else self._call
        if "--port" not in words:
            return run(name, words, given)
        before, (_, shown, *after) = words[: words.index("--port")], words[words.index("--port") :]
        port = self._bench.bus.port if self._of_servos else self._bench.board.port
        timeout = TIMEOUT_OPTIONS.get(words[0], [])
        output = run(name, [*before, "--port", port, *after, *timeout], given)
        return output.replace(port, shown)

    def _start(self, name: str, words: list[str], given: str) -> str:
        """Return the output of a command of the changed project."""
        folders = (str(self._folder / each) for each in ("generated", "runtime", "codegen"))
        variables = {"COLUMNS": "80", "PYTHONPATH": os.pathsep.join(folders)}
        return self._python("-m", name, *words, given=given, **variables)

    def _python(self, *words: str, given: str = "", **variables: str) -> str:
        """Return what a process of Python shows."""
        options: dict[str, Any] = {"status": None, "cwd": self._folder, "input": given, **_SCREEN}
        variables |= {"PYTHONUTF8": "1"}
        return ran(sys.executable, *words, environment=variables, **options).stdout

    def _call(self, name: str, words: list[str], given: str) -> str:
        """Return the output of a command of the project as it is."""
        screen = io.TextIOWrapper(io.BytesIO(), encoding="utf-8", newline="\n", write_through=True)
        keys = io.TextIOWrapper(io.BytesIO(given.encode()), encoding="utf-8")
        with (
            _at(self._folder),
            undoubted(),
            mock.patch.dict(os.environ, COLUMNS="80"),
            mock.patch.object(sys, "stdin", keys),
            contextlib.redirect_stdout(screen),
            contextlib.redirect_stderr(screen),
        ):
            main = import_module(f"{name}.__main__").main if name in FROZEN else framegen.cli.main
            main(words)
        screen.seek(0)
        return screen.read()

    def _session(self, block: str) -> str:
        shown = ""
        for part in doctest.DocTestParser().parse(block):
            if isinstance(part, str):
                shown += part
            else:
                first, *more = part.source.splitlines()
                shown += "".join([f">>> {first}\n", *(f"... {line}\n" for line in more)])
                shown += _agreed(part.want, self._evaluate(part.source))
        return shown

    def _evaluate(self, source: str) -> str:
        """Return the output of an interactive Python."""
        output = io.StringIO()
        with _at(self._folder), contextlib.redirect_stdout(output):
            try:
                exec(compile(source, "<page>", "single"), self._names)  # noqa: S102 - our own pages
            except Exception as error:  # noqa: BLE001 - it is shown
                print("Traceback (most recent call last):", "  ...", sep="\n")
                print("".join(traceback.format_exception_only(error)), end="")
        return output.getvalue()


@contextlib.contextmanager
def _at(folder: Path) -> Iterator[None]:
    """Change the working directory: contextlib.chdir, missing in Python 3.10."""
    before = Path.cwd()
    os.chdir(folder)
    try:
        yield
    finally:
        os.chdir(before)


def _agreed(expected: str, actual: str) -> str:
    """Return the expected text if it agrees with the real one, omissions aside; else the latter."""
    pieces = re.split(r"^\.\.\.\n", expected, flags=re.MULTILINE)
    pattern = r"(?:.*\n)*".join(map(re.escape, pieces))
    # What takes a time takes another the next time.
    return expected if re.fullmatch(pattern, actual) else _TIMED.sub("...\n", actual)


class StaleDiffError(Exception):
    """Lines that a page changes are not in the file, or more than once."""


def _apply(diff: str, folder: Path) -> str:
    """Change a file as a diff says, and return the folder at the top of its path.

    Lines are found by their text, so `@@` has no numbers.
    """
    _, target, *hunks = re.split(r"^(?:--- .*\n\+\+\+ (.*)\n|@@\n)", diff, flags=re.MULTILINE)
    file = folder / target
    text = file.read_text(encoding="utf-8")
    for hunk in filter(None, hunks):
        lines = hunk.splitlines(keepends=True)
        old = "".join(line[1:] for line in lines if line[0] in " -")
        new = "".join(line[1:] for line in lines if line[0] in " +")
        if text.count(old) != 1:
            raise StaleDiffError(f"{target} holds {text.count(old)} times:\n{old}")
        text = text.replace(old, new)
    file.write_text(text, encoding="utf-8", newline="\n")
    return target.partition("/")[0]


def refresh(pages: Sequence[Path]) -> int:
    """Write what is really printed into pages; return how many have to be mended by hand."""
    stale = 0
    for page in pages:
        text = page.read_text(encoding="utf-8")
        with tempfile.TemporaryDirectory() as folder:
            try:
                new = played(text, copy_project(Path(folder), text), slow=True)
            except StaleDiffError as error:
                stale += 1
                print(f"mend the diff in {page.name} by hand: {error}", file=sys.stderr)
                continue
        if new != text:
            page.write_text(new, encoding="utf-8", newline="\n")
            print(f"wrote {page.name}")
    return stale


if __name__ == "__main__":
    from tests.unit.comparison.rules_page import write

    write()
    sys.exit(refresh(PAGES))
