"""What follows from a spec depends on nothing else, and its text is clean.

tests/world/test_deterministic.py holds that other folders, locales, hash orders and Pythons give
the same bytes.
"""

import os
import sys
from pathlib import Path

import pytest
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.render import render, snippets
from framegen.targets.table import TARGETS

from tests.factories import BUSSERVO, DEMO, ROOT

SPECS = {"busservo": BUSSERVO, "greenhouse": DEMO}


@pytest.mark.parametrize("name", SPECS)
def test_rendering_twice_gives_the_same_and_touches_no_disk(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    compiled = compile_spec(read_source(SPECS[name]))
    monkeypatch.chdir(tmp_path)
    first = render(compiled)
    assert render(compiled) == first
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", SPECS)
def test_no_file_holds_where_when_or_by_whom_it_was_made(name: str) -> None:
    compiled = compile_spec(read_source(SPECS[name]))
    forbidden = [str(ROOT), str(Path.home()) + os.sep, sys.prefix, os.sep + "home" + os.sep]
    for path, text in render(compiled).files.items():
        assert [word for word in forbidden if word in text] == [], path


@pytest.mark.parametrize("name", SPECS)
def test_every_file_ends_in_one_line_feed_and_holds_nothing_unseen(name: str) -> None:
    compiled = compile_spec(read_source(SPECS[name]))
    for path, text in render(compiled).files.items():
        assert text == "" or (text.endswith("\n") and not text.endswith("\n\n")), path
        assert text.replace("\n", "").isprintable(), path
        assert [line for line in text.split("\n") if line != line.rstrip()] == [], path


def test_no_two_targets_write_the_same_file() -> None:
    compiled = compile_spec(read_source(SPECS["greenhouse"]))
    paths = [path for target in TARGETS for path in target.render(compiled, snippets())]
    assert len(paths) == len(set(paths))
