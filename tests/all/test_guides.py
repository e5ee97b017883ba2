"""What guides show that takes long to run, such as a cluster, prints what they say."""

from __future__ import annotations

from typing import TYPE_CHECKING

import pytest

from tests.documents import PAGES, ROOT, copy_project, played

if TYPE_CHECKING:
    from pathlib import Path

LONG = [page for page in PAGES if "\n```python slow\n" in page.read_text(encoding="utf-8")]


def test_one_of_the_pages_takes_long() -> None:
    assert [page.name for page in LONG] == ["captures.md"]


@pytest.mark.parametrize("page", LONG, ids=lambda page: page.relative_to(ROOT).as_posix())
def test_long_examples_print_what_the_page_says(page: Path, tmp_path: Path) -> None:
    text = page.read_text(encoding="utf-8")
    truth = played(text, copy_project(tmp_path, text), slow=True)
    assert truth == text, "if this was meant to change: python -m tests.documents"
