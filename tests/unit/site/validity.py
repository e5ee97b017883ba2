"""What html-validate finds in pages."""

import json
import subprocess
from pathlib import Path

import pytest

from tests.factories import write_files
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
        done = subprocess.run(
            [str(NODE), str(VALIDATOR), "--formatter", "json", str(folder)],
            cwd=folder,
            stdout=output,
            stderr=subprocess.PIPE,
            encoding="utf-8",
            check=False,
        )
    assert done.returncode in (0, 1), done.stderr
    return [
        f"{Path(file['filePath']).name}:{said['line']}: {said['ruleId']}: {said['message']}"
        for file in json.loads(said_of.read_text("utf-8"))
        for said in file["messages"]
    ]
