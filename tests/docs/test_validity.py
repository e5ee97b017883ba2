"""Every page is valid HTML, according to html-validate."""

import json
import subprocess
from pathlib import Path

import pytest

from tests.docs.reference import NODE, NODE_MODULES, SPECS, reference
from tests.docs.test_hostile_pages import PAYLOADS, hostile
from tests.factories import write_files

VALIDATOR = NODE_MODULES / "html-validate" / "bin" / "html-validate.mjs"
RULES = {"root": True, "extends": ["html-validate:standard"]}

pytestmark = pytest.mark.skipif(
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


@pytest.mark.parametrize("name", SPECS)
def test_every_page_is_valid(name: str, tmp_path: Path) -> None:
    pages = {path: page.text for path, page in reference(name).pages.items()}
    assert complaints(tmp_path, pages) == []


def test_every_page_of_a_hostile_spec_is_valid(tmp_path: Path) -> None:
    site = hostile(" ".join(PAYLOADS.values()))
    pages = {path: page.text for path, page in site.pages.items() if "ServoMove" in path}
    pages |= {path: site.pages[path].text for path in ("index.html", "errata.html", "decoder.html")}
    assert complaints(tmp_path, pages) == []


def test_the_validator_refuses_an_invalid_page(tmp_path: Path) -> None:
    page = reference("busservo").pages["index.html"].text
    broken = page.replace("</table>", "", 1).replace('<html lang="en">', "<html>")
    assert complaints(tmp_path, {"index.html": broken})
