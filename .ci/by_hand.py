"""Run what pages say for Windows: their `bat` blocks in one shell, and there `powershell` as well.

    python .ci/by_hand.py                           CONTRIBUTING.md, where there is no make
    python .ci/by_hand.py docs/getting-started.md

Where there is no Windows, bash runs the `bat` blocks as it would write them, for a try in a clone
that may be spoilt. At the end nothing may differ from what was committed: what is generated is the
same everywhere.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# What bash says instead.
IN_BASH = {
    "%USERPROFILE%": "$HOME",
    "cd /d ": "cd ",
    "\\": "/",
    "/Scripts/activate": "/bin/activate",
}


def commands(page: str, kind: str) -> list[str]:
    """Return the lines of the blocks of a kind."""
    text = (ROOT / page).read_text(encoding="utf-8")
    blocks = re.findall(rf"^```{kind}\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    return [line for block in blocks for line in block.splitlines()]


def in_bash(line: str) -> str:
    """Return a line of `bat` as bash writes it."""
    for old, new in IN_BASH.items():
        line = line.replace(old, new)
    return f". {line}" if "/bin/activate" in line else line


def run(script: Path, lines: list[str], *command: str) -> int:
    """Run lines as a script; return its exit code."""
    script.write_text("\n".join([*lines, ""]), encoding="utf-8")
    return subprocess.run([*command, str(script)], cwd=ROOT, check=False).returncode


def main() -> int:
    """Run the blocks of the named pages; return the exit code of the first line that fails."""
    for page in sys.argv[1:] or ["CONTRIBUTING.md"]:
        lines = commands(page, "bat")
        if not lines:
            sys.exit(f"{page} has no block of commands for Windows")
        with tempfile.TemporaryDirectory() as folder:
            if os.name == "nt":
                # Without `call`, a script that is called would be the last thing that happens.
                called = [f"call {line} || exit /b 1" for line in lines]
                failed = run(Path(folder, "by_hand.cmd"), called, "cmd", "/c")
                shell = [
                    "$ErrorActionPreference = 'Stop'",
                    # The folder is there already, from the other shell.
                    *(line for line in commands(page, "powershell") if "mkdir" not in line),
                ]
                bypass = ("powershell", "-ExecutionPolicy", "Bypass", "-File")
                failed = failed or run(Path(folder, "by_hand.ps1"), shell, *bypass)
            else:
                python = 'py() { "${PYTHON:-python3}" "$@"; }'
                lines = ["set -ex", python, *map(in_bash, lines)]
                failed = run(Path(folder, "by_hand.sh"), lines, "bash")
        if failed:
            return failed
    return subprocess.run(["git", "diff", "--exit-code"], cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
