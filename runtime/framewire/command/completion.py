"""Shell completion of the command line: verbs, options, messages, fields and ports."""

from __future__ import annotations

from argparse import ArgumentParser
from functools import partial

from .events import kinds
from .reference_topics import TOPICS
from .shell_completion import CompletionError, Files, Folders, Function, Words, script
from .usage_error import UsageError
from .verbs import verb_named

TYPE_CHECKING = False
if TYPE_CHECKING:
    from argparse import Action

    from .program import Program
    from .shell_completion import Candidates

_PATHS: dict[object, Candidates] = {
    **dict.fromkeys(("FILE", "HEX|FILE", "PATH"), Files()),
    "DIR": Folders(),
}


def completion(shell: str, program: Program) -> str:
    """Return the script for a shell. Raises UsageError if shtab is missing or too old."""
    # All verbs in one parser; the command itself imports only the one that is called.
    parser = ArgumentParser(prog=program.name, description=program.summary)
    parser.add_argument("--version", action="store_true", help="show the version")
    parts = parser.add_subparsers()
    for name, about in program.verbs.items():
        part = parts.add_parser(name, help=about.replace("%", "%%"))
        verb_named(name, program).add_arguments(part, program)
    try:
        return script(parser, shell, partial(_candidates, program))
    except CompletionError as error:
        raise UsageError(str(error)) from None


def _candidates(program: Program, command: str, action: Action) -> Candidates | None:
    messages = program.library.codec.messages
    if "--port" in action.option_strings:
        return _ports(program.name)
    if action.metavar == "FIELD=VALUE":
        return _fields(program)
    if action.metavar == "MESSAGE":
        # Anything can be encoded; what has to do with a port is for what is sent from here.
        some = messages if command.endswith(" encode") else tuple(program.library.exchanges)
        return Words([kind.__name__ for kind in some])
    if action.metavar == "MESSAGE|WORD":
        return Words([*(kind.__name__ for kind in messages), *TOPICS])
    if action.metavar == "NAME":
        return Words([*kinds(program.library.codec), *(kind.__name__ for kind in messages)])
    return _PATHS.get(action.metavar)


def _fields(program: Program) -> Function:
    """Return the fields of the message that stands before."""
    fields = {
        kind.__name__: " ".join(f"{n}=" for n in kind.__match_args__)
        for kind in program.library.codec.messages
    }
    name = f"_{program.name}_fields"
    bash = "\n".join(f'      {kind}) names="{names}" ;;' for kind, names in fields.items())
    zsh = "\n".join(f"      {kind}) names=({names}) ;;" for kind, names in fields.items())
    fish = "\n".join(f"      case {kind}\n        set names {n}" for kind, n in fields.items())
    texts = {
        "bash": f"""
{name}() {{
  local word names=""
  for word in "${{COMP_WORDS[@]}}"; do
    case $word in
{bash}
    esac
  done
  compgen -W "$names" -- "$1"
}}""",
        "zsh": f"""
{name}() {{
  local word
  local -a names
  for word in $words; do
    case $word in
{zsh}
    esac
  done
  compadd "$@" -S '' -- $names
}}""",
        "fish": f"""
function {name}
  set -l names
  for word in (commandline -opc)
    switch $word
{fish}
    end
  end
  string join \\n -- $names
end""",
    }
    return Function(name, texts)


def _ports(program: str) -> Function:
    """Return the ports that are plugged in, or files once a path is begun."""
    # bash takes what a function of such a name finds for files: behind a folder comes no blank.
    name, listed = f"_{program}_port_files", f"{program} ports 2>/dev/null"
    texts = {
        "bash": f"""
{name}() {{
  compgen -W "$({listed} | while read -r port about; do echo "$port"; done)" -- "$1"
  if [[ $1 == */* ]]; then compgen -f -- "$1"; fi
}}""",
        "zsh": f"""
{name}() {{
  local -a names
  names=(${{${{(f)"$({listed})"}}%% *}})
  compadd "$@" -- $names
  if [[ $PREFIX == */* ]]; then _files; fi
}}""",
        "fish": f"""
function {name}
  {listed} | string replace -r ' .*' ''
  if string match -q '*/*' -- (commandline -ct)
    __fish_complete_path (commandline -ct)
  end
end""",
    }
    return Function(name, texts)
