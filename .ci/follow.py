"""Follow pages as a reader does, in order and to the letter, with Python's own library alone.

    python3 .ci/follow.py README.md docs/getting-started.md

`sh` blocks are run line by line in a shell, whose environment and folder last from block to block;
`console` blocks are too, and `python` and `pycon` blocks in the Python that is then on the path,
each of them from nothing. A program that begins with `# NAME.py` is saved by that name as well.
The block behind it is what it must print; `...` stands for anything. `bat` and `powershell` are
not for this machine, and `text` and `toml` are nothing to do. A page that installs nothing is
followed in an environment that is made as getting-started says. A virtual board, which the
installed `busservo simulate` offers, is behind every COM5 and COM7, and virtual servos behind
`lxservo`.
"""

from __future__ import annotations

import doctest
import json
import os
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

if TYPE_CHECKING:
    from collections.abc import Sequence

ROOT = Path(__file__).resolve().parent.parent
PORT = re.compile(r"\bCOM[57]\b")
BEGUN = time.monotonic()
SIMULATE = "busservo simulate"
BUS = "lxservo simulate --servos 1,2"
# What runs until Ctrl-C.
WAITS = (SIMULATE, "busservo monitor")
INTERRUPTED = 130
# So many seconds after that it has ended, however busy the machine is.
PATIENCE = 60
IGNORED = {"bat", "powershell", "text", "toml"}
# Where it is said how to install, and what a page says that does it by itself.
INSTALLATION = ROOT / "docs" / "getting-started.md"
INSTALLS = re.compile(r"^(make|python3 -m venv)\b", re.MULTILINE)
# What a command leaves behind, written down by the shell that ends.
KEEP = """
import json, os
own = {name: os.environ.pop(name) for name in ("KEEPER", "KEEP", "LEFT")}
with open(own["LEFT"], "w") as left:
    json.dump([dict(os.environ), os.getcwd()], left)
"""
# Programs and sessions of a page share one Python, and no name: a line of JSON each.
INTERPRETER = r"""
import contextlib, doctest, io, json, sys, traceback
for line in sys.stdin:
    kind, text = json.loads(line)
    names = {"__name__": "__main__"}
    shown = io.StringIO()
    failed = 0
    with contextlib.redirect_stdout(shown):
        if kind == "pycon":
            test = doctest.DocTestParser().get_doctest(text, {}, "page", None, None)
            test.globs = names
            failed = doctest.DocTestRunner(verbose=False, optionflags=doctest.ELLIPSIS).run(
                test, clear_globs=False).failed
        else:
            try:
                exec(compile(text, "page", "exec"), names)
            except BaseException:
                traceback.print_exc(file=shown)
                failed = 1
    print(json.dumps([failed, shown.getvalue()]), flush=True)
"""


class Block(NamedTuple):
    """A fenced block: what kind it is, its text, and the line at which it begins."""

    kind: str
    text: str
    line: int


class WrongError(Exception):
    """A page that does not do what it says."""


class Reader:
    """Somebody who has this clone, a shell, an empty home, and nothing of ours on the path."""

    def __init__(self, home: Path) -> None:
        # What was downloaded once is not downloaded again.
        cache = str(home.parent / "cache")
        self.environment = {**os.environ, "HOME": str(home), "XDG_CACHE_HOME": cache}
        self.folder = str(ROOT)
        self._python: subprocess.Popen[str] | None = None
        # By the command that offers it.
        self._boards: dict[str, tuple[subprocess.Popen[str], str]] = {}

    def shell(self, command: str) -> tuple[int, str]:
        """Run a command; what it leaves behind in the environment lasts."""
        with tempfile.TemporaryDirectory() as scratch:
            left = Path(scratch, "left")
            keep = """trap '"$KEEPER" -c "$KEEP"' EXIT"""
            own = {"KEEPER": sys.executable, "KEEP": KEEP, "LEFT": str(left)}
            done = subprocess.run(
                ["bash", "-c", f"{keep}\n{self._with_port(command)}"],
                env={**self.environment, **own},
                cwd=self.folder,
                stdout=subprocess.PIPE,
                stderr=subprocess.STDOUT,
                encoding="utf-8",
                check=False,
            )
            self.environment, self.folder = json.loads(left.read_text(encoding="utf-8"))
        printed = done.stdout
        # What is printed has the port where the page has the name that stands for it.
        if named := PORT.search(command):
            for _, port in self._boards.values():
                printed = printed.replace(port, named[0])
        return done.returncode, printed

    def python(self, block: Block) -> str:
        """Return the output of a program or a session."""
        if self._python is None:
            self._python = self._start("python", "-c", INTERPRETER)
        assert self._python.stdin is not None
        assert self._python.stdout is not None
        text = self._with_port(block.text)
        if saved := re.match(r"# (\w+\.py)\n", text):
            Path(self.folder, saved[1]).write_text(text, encoding="utf-8")
        self._python.stdin.write(json.dumps([block.kind, text]) + "\n")
        self._python.stdin.flush()
        failed, shown = json.loads(self._python.stdout.readline())
        if failed:
            raise WrongError(shown)
        return str(shown)

    def _with_port(self, text: str) -> str:
        if not PORT.search(text):
            return text
        command = BUS if "lxservo" in text else SIMULATE
        if command not in self._boards:
            board = self._start(*shlex.split(command), "--quiet")
            assert board.stdout is not None
            self._boards[command] = board, board.stdout.readline().strip()
        return PORT.sub(self._boards[command][1], text)

    def _start(self, *command: str) -> subprocess.Popen[str]:
        # subprocess looks for programs on its own path, not on the reader's.
        program = shutil.which(command[0], path=self.environment["PATH"])
        if program is None:
            raise WrongError(f"{command[0]} is not on the path")
        return subprocess.Popen(
            [program, *command[1:]],
            env=self.environment,
            cwd=self.folder,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            encoding="utf-8",
        )

    def waits(self, command: str) -> None:
        """Run a command that waits until Ctrl-C, and press Ctrl-C once it is at work."""
        waiting = self._start(*shlex.split(self._with_port(command)))
        assert waiting.stdout is not None
        port = "none"
        if command == SIMULATE:
            port = waiting.stdout.readline().strip()
        else:
            time.sleep(2)
        waiting.send_signal(signal.SIGINT)
        try:
            waiting.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            waiting.kill()
            raise WrongError(f"Ctrl-C did not end `{command}`") from None
        if waiting.returncode not in (0, INTERRUPTED) or not port:
            raise WrongError(f"it named the port {port!r}, and ended with {waiting.returncode}")

    def deactivate(self) -> None:
        """Leave the virtual environment: a function of the shell that has activated it."""
        programs = str(Path(self.environment.pop("VIRTUAL_ENV"), "bin"))
        path = self.environment["PATH"].split(os.pathsep)
        self.environment["PATH"] = os.pathsep.join(each for each in path if each != programs)

    def leave(self) -> None:
        """End what still runs."""
        for process in (self._python, *(board for board, _ in self._boards.values())):
            if process is not None:
                process.terminate()
                process.communicate()


def blocks_of(page: Path) -> list[Block]:
    """Return the fenced blocks of a page."""
    text = page.read_text(encoding="utf-8")
    found = re.finditer(r"^```(\w+)\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    return [Block(each[1], each[2], text.count("\n", 0, each.start()) + 1) for each in found]


def follow(page: Path, home: Path, first: Sequence[Block] = ()) -> None:
    """Follow a page, after some other blocks. Raises WrongError if it does not work."""
    home.mkdir()
    reader = Reader(home)
    shown = ""
    try:
        for block in first:
            _do(reader, block, "")
        reader.folder = str(ROOT)
        for block in blocks_of(page):
            place = f"{page.name}:{block.line}"
            print(
                f"{time.monotonic() - BEGUN:4.0f} s  {place}: {block.text.splitlines()[0]}",
                flush=True,
            )
            try:
                shown = _do(reader, block, shown)
            except WrongError as error:
                raise WrongError(f"{page.name}:{block.line}: {error}") from None
    finally:
        reader.leave()


def _run(reader: Reader, line: str) -> None:
    command = line.partition("  #")[0]
    if command == "deactivate":
        reader.deactivate()
    elif command.startswith(WAITS):
        reader.waits(command)
    else:
        status, printed = reader.shell(command)
        if status != 0:
            raise WrongError(f"`{command}` ends with {status}:\n{printed}")


def _do(reader: Reader, block: Block, shown: str) -> str:
    if block.kind == "sh":
        for line in block.text.splitlines():
            _run(reader, line)
    elif block.kind == "console":
        for part in re.split(r"^\$ ", block.text, flags=re.MULTILINE)[1:]:
            command, _, expected = part.partition("\n")
            _compare(expected, reader.shell(command)[1])
    elif block.kind in {"python", "pycon"}:
        return reader.python(block)
    elif block.kind == "output":
        _compare(block.text, shown)
    elif block.kind not in IGNORED:
        raise WrongError(f"nobody knows what to do with `{block.kind}`")
    return ""


def _compare(expected: str, printed: str) -> None:
    if not doctest.OutputChecker().check_output(expected, printed, doctest.ELLIPSIS):
        raise WrongError(f"it says\n{expected}\nand prints\n{printed}")


def main() -> int:
    """Follow the named pages; return 1 if one of them does not work."""
    # Whoever runs this in the background may have it ignore Ctrl-C, and all that it starts.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        for name in sys.argv[1:]:
            installing = INSTALLS.search((ROOT / name).read_text(encoding="utf-8"))
            blocks = [each for each in blocks_of(INSTALLATION) if each.kind == "sh"]
            follow(ROOT / name, Path.home() / Path(name).stem, [] if installing else blocks[:1])
    except WrongError as error:
        print(error, file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main())
