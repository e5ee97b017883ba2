"""What html-validate finds in pages."""

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest

from tests.factories import write_files
from tests.programs import ran
from tests.unit.site.reference import NODE, NODE_MODULES

VALIDATOR = NODE_MODULES / "html-validate" / "bin" / "html-validate.mjs"
RULES = {"root": True, "extends": ["html-validate:standard"]}

needs_validator = pytest.mark.skipif(
    NODE is None or not VALIDATOR.exists(),
    reason="html-validate is not installed; `make docs-tools` installs it",
)


def complaints(folder: Path, pages: dict[str, str]) -> list[str]:
    """Return the validator's findings in pages, each with its place."""
    write_files(pages, folder)
    (folder / ".htmlvalidate.json").write_text(json.dumps(RULES))
    # Into a file: it ends before it has written more than a pipe holds.
    said_of = folder / "said.json"
    with said_of.open("w", encoding="utf-8") as output:
        options: Any = {"capture_output": False, "stdout": output, "stderr": subprocess.PIPE}
        words = (NODE, VALIDATOR, "--formatter", "json", folder)
        done = ran(*words, status=None, cwd=folder, **options)
    assert done.returncode in (0, 1), done.stderr
    files = json.loads(said_of.read_text("utf-8"))
    found = [(Path(file["filePath"]).name, said) for file in files for said in file["messages"]]
    return [f"{name}:{said['line']}: {said['ruleId']}: {said['message']}" for name, said in found]
