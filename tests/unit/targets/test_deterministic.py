"""What follows from a spec depends on nothing else, and its text is clean.

tests/world/test_deterministic.py holds that other folders, locales, hash orders and Pythons give
the same bytes.
"""

import os
import sys
from functools import cache
from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.output import Output
from framegen.render import render, snippets
from framegen.targets.table import TARGETS

from tests.factories import BUSSERVO, DEMO, ROOT, compiled_file

SPECS = {"busservo": BUSSERVO, "greenhouse": DEMO}


@cache
def rendered(name: str) -> Output:
    return render(compiled_file(SPECS[name]))


@pytest.mark.parametrize("name", SPECS)
def test_rendering_twice_gives_the_same_and_touches_no_disk(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    # The spec is also read once more.
    assert render(compile_spec(read_source(SPECS[name]))) == rendered(name)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", SPECS)
def test_no_file_holds_where_when_or_by_whom_it_was_made(name: str) -> None:
    forbidden = [str(ROOT), str(Path.home()) + os.sep, sys.prefix, os.sep + "home" + os.sep]
    for path, text in rendered(name).files.items():
        assert [word for word in forbidden if word in text] == [], path


@pytest.mark.parametrize("name", SPECS)
def test_every_file_ends_in_one_line_feed_and_holds_nothing_unseen(name: str) -> None:
    for path, text in rendered(name).files.items():
        assert text == "" or (text.endswith("\n") and not text.endswith("\n\n")), path
        assert text.replace("\n", "").isprintable(), path
        assert [line for line in text.split("\n") if line != line.rstrip()] == [], path


def test_no_two_targets_write_the_same_file() -> None:
    compiled = compiled_file(DEMO)
    paths = [path for target in TARGETS for path in target.render(compiled, snippets())]
    assert len(paths) == len(set(paths))
