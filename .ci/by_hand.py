"""Run what README.md says for machines without make: each line of its `bat` block, in one shell.

    python .ci/by_hand.py

At the end nothing may differ from what was committed: what is generated is the same everywhere.
"""

from __future__ import annotations

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent


def commands() -> list[str]:
    """Return the lines of the block."""
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    block = re.search(r"^```bat\n(.*?)^```", readme, flags=re.MULTILINE | re.DOTALL)
    if block is None:
        sys.exit("README.md has no block of commands for Windows")
    return block[1].splitlines()


def main() -> int:
    """Run them; return the exit code of the first that fails."""
    lines = [*commands(), "git diff --exit-code"]
    with tempfile.TemporaryDirectory() as folder:
        if os.name == "nt":
            script = Path(folder, "by_hand.cmd")
            # Without `call`, a script that is called would be the last thing that happens.
            lines = [f"call {line} || exit /b 1" for line in lines]
            command = ["cmd", "/c", str(script)]
        else:
            # For a try where there is no Windows, in a clone that may be spoilt.
            script = Path(folder, "by_hand.sh")
            python = 'py() { "${PYTHON:-python3}" "$@"; }'
            lines = ["set -ex", python, *lines]
            lines = [line.replace(".venv\\Scripts\\", ". .venv/bin/") for line in lines]
            command = ["bash", str(script)]
        script.write_text("\n".join([*lines, ""]), encoding="utf-8")
        return subprocess.run(command, cwd=ROOT, check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
