"""Completion, for shells: made by shtab where it is installed, and a hint where it is not."""

import shutil
import sys
from collections.abc import Callable, Sequence
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TypeAlias

import busservo.__main__
import busservo_simulator.cli
import framegen.cli
import pytest
from busservo import MESSAGES, ServoMove
from busservo._command import PROGRAM
from busservo_simulator.faults import CHANCES
from framegen.checks import RULES
from framegen.comparison.changes import CHANGE_RULES
from framegen.targets.table import TARGETS

from tests.commands import Ended, called
from tests.in_turn import in_turn
from tests.programs import ran

Main: TypeAlias = Callable[[Sequence[str]], int]

ROOT = Path(__file__).parents[4]
PROGRAMS: dict[str, Main] = {
    "busservo": busservo.__main__.main,
    "busservo-simulator": busservo_simulator.cli.main,
    "framegen": framegen.cli.main,
}
SHELLS = ["bash", "zsh", "tcsh", "fish"]
NAMES = [kind.__name__ for kind in MESSAGES]
FIELDS = [f"{name}=" for name in ServoMove.__match_args__]


def completion(program: str, shell: str) -> Ended:
    return called(PROGRAMS[program], "--print-completion", shell)


@cache
def script(program: str, shell: str) -> str:
    """What a program prints for a shell."""
    status, output, _ = completion(program, shell)
    assert status == 0
    return output


def beginning(word: str, words: list[str]) -> list[str]:
    return sorted(each for each in words if each.startswith(word))


# What is typed, and what a shell offers for its last word.
OFFERED = [
    ("busservo mon", ["monitor"]),
    ("busservo send ServoP", ["ServoPositionsRead"]),
    ("busservo encode ServoP", beginning("ServoP", NAMES)),
    ("busservo encode ServoMove t", beginning("t", FIELDS)),
    ("busservo encode ServoMove time_ms=1000 tar", beginning("tar", FIELDS)),
    ("busservo send --port COM7 ServoMove ", sorted(FIELDS)),
    ("busservo send ServoMove --port COM7 ", sorted(FIELDS)),
    ("busservo encode ActionGroupStop ", []),
    ("busservo docs B", beginning("B", NAMES)),
    ("busservo docs er", ["errata"]),
    ("busservo explain --direction c", ["controller"]),
    ("busservo monitor --only n", ["noise"]),
    ("busservo monitor --di", ["--direction"]),
    ("busservo stats --pl", ["--plot"]),
    ("busservo decode --parquet gen", ["generated"]),
    ("busservo monitor --port ", ["/dev/ttyUSB7", "COM7"]),
    ("busservo monitor --port C", ["COM7"]),
    ("busservo simulate --bat", ["--battery"]),
    ("busservo-simulator --fault noise", beginning("noise", [f"{name}=" for name in CHANCES])),
    ("busservo-simulator --loc", ["--local-echo"]),
    ("framegen ne", ["new"]),
    ("framegen rules unknown-t", ["unknown-type"]),
    ("framegen rules ", sorted(rule.id for rule in (*RULES, *CHANGE_RULES))),
    ("framegen targets ", sorted(target.name for target in TARGETS)),
    ("framegen generate --target py", ["python"]),
    ("framegen check spec/bus", ["spec/busservo.yaml"]),
    ("framegen explain spec/bus", ["spec/busservo.yaml"]),
    ("framegen generate --out do", ["docs"]),
]
# Whether bash, which alone is given this rule, lets what it offers go on.
GO_ON = {
    "busservo encode ServoMove t": True,
    "busservo-simulator --fault noise": True,
    "busservo mon": False,
    "framegen check spec/bus": False,
}
# In place of the library's own command: two ports are plugged in.
PORTS = "/dev/ttyUSB7  1A86:7523  a\\nCOM7  -\\n"

needs_shtab = pytest.mark.skipif(find_spec("shtab") is None, reason="there is no shtab here")


def needs(shell: str) -> pytest.MarkDecorator:
    is_there = shutil.which(shell) is not None and sys.platform != "win32"
    return pytest.mark.skipif(not is_there, reason=f"there is no {shell} here")


def run(*words: str) -> list[str]:
    done = ran(*words, cwd=ROOT)
    assert done.stderr == ""
    return done.stdout.splitlines()


def in_bash(line: str) -> list[str]:
    """What bash offers for a line whose last word is begun, or empty, and the options it sets."""
    words = line.split(" ")
    quoted = " ".join(f"'{word}'" for word in words)
    function = f"_complete_{words[0].replace('-', '_')}"
    program = f"""{script(words[0], "bash")}
        busservo() {{ printf '{PORTS}'; }}
        compopt() {{ printf 'compopt %s\\n' "$*"; }}
        COMP_WORDS=({quoted}); COMP_CWORD={len(words) - 1}; COMP_LINE='{line}'
        COMP_POINT=${{#COMP_LINE}}
        {function} {words[0]} '{words[-1]}' '{words[-2]}'
        for each in "${{COMPREPLY[@]}}"; do echo "$each"; done
    """
    return run("bash", "--norc", "-c", program)


@needs_shtab
@needs("bash")
@in_turn("line, offered", lambda: OFFERED)
def test_bash_completes(line: str, offered: list[str]) -> None:
    found = in_bash(line)
    assert sorted(each for each in found if not each.startswith("compopt")) == offered
    # Behind what ends with an equals sign it puts no blank.
    if line in GO_ON:
        assert ("compopt -o nospace" in found) is GO_ON[line]


@needs_shtab
@needs("bash")
def test_a_port_without_a_name_is_a_file_once_a_path_is_begun() -> None:
    assert "./Makefile" in in_bash("busservo monitor --port ./Make")
    assert "Makefile" not in in_bash("busservo monitor --port Make")


@needs_shtab
@needs("fish")
@in_turn("line, offered", lambda: OFFERED)
def test_fish_completes(line: str, offered: list[str], tmp_path: Path) -> None:
    file = tmp_path / "script.fish"
    file.write_text(script(line.partition(" ")[0], "fish"), encoding="utf-8")
    ports = f"function busservo; printf '{PORTS}'; end"
    found = run("fish", "--no-config", "-c", f"source {file}; {ports}; complete -C '{line}'")
    assert {each.partition("\t")[0].rstrip("/") for each in found if each != "/"} >= {*offered}


@needs_shtab
@needs("zsh")
@pytest.mark.parametrize("program", PROGRAMS)
def test_zsh_can_read_the_script(program: str, tmp_path: Path) -> None:
    file = tmp_path / "script.zsh"
    file.write_text(script(program, "zsh"), encoding="utf-8")
    assert run("zsh", "-f", "-n", str(file)) == []


@needs_shtab
@needs("zsh")
@in_turn(
    "call, offered",
    lambda: [
        ("words=(encode ServoMove t); _busservo_fields", FIELDS),
        ("words=(encode ActionGroupStop t); _busservo_fields", []),
        ("PREFIX=C; _busservo_port_files", ["/dev/ttyUSB7", "COM7"]),
    ],
)
def test_zsh_finds_fields_and_ports(call: str, offered: list[str], tmp_path: Path) -> None:
    file = tmp_path / "script.zsh"
    file.write_text(script("busservo", "zsh"), encoding="utf-8")
    program = f"""
        compdef() {{ }}
        compadd() {{ while [[ $1 != -- ]]; do shift; done; shift; print -l -- "$@" }}
        eval "$(<{file})"
        busservo() {{ printf '{PORTS}' }}
        {call}
    """
    assert [line for line in run("zsh", "-f", "-c", program) if line] == offered


@needs_shtab
@in_turn("shell", lambda: SHELLS)
@in_turn(
    "program, words",
    lambda: [
        ("busservo", [*PROGRAM.verbs, "retries", *NAMES]),
        ("busservo-simulator", ["battery", "local-echo"]),
        ("framegen", [*framegen.cli.VERBS, "unknown-type", "python"]),
    ],
)
def test_shells_learn_verbs_options_and_names(program: str, words: list[str], shell: str) -> None:
    assert [word for word in words if word not in script(program, shell)] == []


# ------------------------------------------------------------------ where it cannot be made
@in_turn("program", lambda: PROGRAMS)
def test_without_shtab_there_is_a_hint(program: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "shtab", None)
    hint = "completion is made by shtab, which is not installed here: pip install shtab"
    assert completion(program, "bash") == (2, "", f"{program}: error: {hint}\n")


@in_turn("program", lambda: PROGRAMS)
def test_shtab_too_old_for_fish_gets_a_hint(program: str, monkeypatch: pytest.MonkeyPatch) -> None:
    shtab = pytest.importorskip("shtab")

    def refuse(*_: object, **__: object) -> None:
        raise NotImplementedError

    monkeypatch.setattr(shtab, "complete", refuse)
    hint = "this shtab is too old to know fish: pip install --upgrade shtab"
    assert completion(program, "fish") == (2, "", f"{program}: error: {hint}\n")


@in_turn("program", lambda: PROGRAMS)
def test_an_unknown_shell_is_refused(program: str) -> None:
    status, _, errors = completion(program, "ksh")
    assert (status, "invalid choice: 'ksh'" in errors) == (2, True)
