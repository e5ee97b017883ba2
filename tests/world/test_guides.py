"""Guides, followed: with boards in real time, git, processes, and what takes long, as a cluster."""

import re
from importlib.metadata import version
from pathlib import Path

import pytest

from tests.documents import PAGES, ROOT, copy_project, played
from tests.unit.project.test_readme import TAKE_TIME

LONG = [page for page in PAGES if "\n```python slow\n" in page.read_text(encoding="utf-8")]
CONSTRAINTS = (ROOT / "constraints.txt").read_text(encoding="utf-8")


@pytest.mark.parametrize("name", sorted(TAKE_TIME))
def test_examples_print_what_the_page_says(name: str, tmp_path: Path) -> None:
    text = (ROOT / name).read_text(encoding="utf-8")
    truth = played(text, copy_project(tmp_path, text))
    assert truth == text, "if this was meant to change: python -m tests.documents"


def test_one_of_the_pages_takes_long() -> None:
    assert [page.name for page in LONG] == ["captures.md"]


@pytest.mark.parametrize("page", LONG, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_long_examples_print_what_the_page_says(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    truth = played(text, copy_project(tmp_path, text), slow=True)
    assert truth == text, "if this was meant to change: python -m tests.documents"


@pytest.mark.skipif(
    f"matplotlib=={version('matplotlib')}\n" not in CONSTRAINTS,
    reason="another Matplotlib draws it in another way",
)
def test_the_guide_shows_the_picture_that_its_command_draws(tmp_path: Path) -> None:
    page = (ROOT / "docs" / "captures.md").read_text(encoding="utf-8")
    (recorded,) = re.findall(r"^```python\n# arm\.py\n.*?^```\n", page, re.MULTILINE | re.DOTALL)
    command = "```console\n$ busservo stats arm.hex --plot arm.svg\n...\n```\n"
    played(f"{recorded}\n{command}", copy_project(tmp_path, command))
    drawn = (tmp_path / "arm.svg").read_text(encoding="utf-8")
    # To get the new picture: copy what the guide's command draws.
    assert drawn == (ROOT / "docs" / "images" / "plot-arm.svg").read_text(encoding="utf-8")
