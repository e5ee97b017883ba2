"""Every name that a library binds anywhere is a good name for anything, for type checkers, too."""

import sys
from pathlib import Path

import pytest

from tests.bound_crowds import CROWDS, crowd_of
from tests.factories import ROOT, compiled_of, library_files, write_files
from tests.names_at_work import at_work
from tests.programs import ran

KINDS = [(kind, plain) for kind in CROWDS for plain in (True, False)]


@pytest.mark.parametrize(("kind", "plain"), KINDS)
def test_a_library_works_whatever_its_names_are(kind: str, plain: bool) -> None:
    at_work(compiled_of(crowd_of(kind, plain=plain, everywhere=True)))


@pytest.mark.parametrize(("kind", "plain"), KINDS)
def test_linters_and_type_checkers_say_nothing(kind: str, plain: bool, tmp_path: Path) -> None:
    write_files(library_files(compiled_of(crowd_of(kind, plain=plain))), tmp_path)
    config, untyped = ROOT / "pyproject.toml", ROOT / "tests" / "untyped.ini"
    for words in (
        ("ruff", "check", "--no-cache", "--config", str(config), "."),
        ("ruff", "format", "--check", "--no-cache", "--config", str(config), "."),
        ("mypy", "--strict", "--config-file", str(untyped), "--cache-dir", "cache", "crowded"),
    ):
        pytest.importorskip(words[0], reason="`pip install --group lint`")
        ran(sys.executable, "-m", *words, cwd=tmp_path / "generated")
