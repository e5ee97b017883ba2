"""The same spec gives the same bytes: in any folder, locale, time zone, hash order and Python."""

import os
import shutil
import sys
from functools import cache
from pathlib import Path
from typing import Any

import pytest

from tests.factories import BUSSERVO, DEMO, ROOT
from tests.programs import ran

SPECS = {"busservo": BUSSERVO, "greenhouse": DEMO}

# Prints a digest of each file that follows from the specs that it is given, the pages included.
DIGESTS = """
import sys
from hashlib import sha256
from pathlib import Path
from framegen.compile import compile_spec
from framegen.language.load import read_source
from framegen.render import render, render_shared, snippets
from framegen.site.project import Project
from framegen.site.site import render_site

specs = [compile_spec(read_source(Path(name))) for name in sys.argv[1:]]
files = {f"site/{path}": text for path, text in render_site(Project(specs), snippets()).items()}
for compiled in specs:
    files |= render(compiled).files | render_shared(compiled).files
for path, text in files.items():
    print(sha256(text.encode()).hexdigest(), path)
"""


def digests(
    *specs: Path, python: str = sys.executable, cwd: Path = ROOT, **environment: str
) -> str:
    """Return what that program prints in a fresh interpreter, in that folder and environment."""
    variables = {"PYTHONPATH": str(ROOT / "codegen"), **environment}
    files = specs or SPECS.values()
    return ran(python, "-c", DIGESTS, *files, cwd=cwd, environment=variables).stdout


@cache
def expected() -> str:
    return digests(PYTHONHASHSEED="0")


def test_every_file_has_a_digest() -> None:
    paths = [line.split(" ", 1)[1] for line in expected().splitlines()]
    first = {"/".join(path.split("/")[:-1]) for path in paths}
    for name in SPECS:
        reference = f"reference/{name}"
        assert {f"generated/{name}", f"docs/{reference}", f"site/{reference}"} <= first
    assert "site/index.html" in paths


ENVIRONMENTS = [
    """
    PYTHONHASHSEED=1 LC_ALL=C PYTHONUTF8=0 PYTHONCOERCECLOCALE=0 TZ=Pacific/Kiritimati
    SOURCE_DATE_EPOCH=0 PYTHONOPTIMIZE=1
    """,
    """
    PYTHONHASHSEED=4294967295 LC_ALL=tr_TR.UTF-8 LANG=tr_TR.UTF-8 TZ=America/Caracas USER=somebody
    HOME=/ HOSTNAME=elsewhere PYTHONDONTWRITEBYTECODE=1 COLUMNS=20 NO_COLOR=1 TERM=dumb
    """,
]


@pytest.mark.parametrize("environment", ENVIRONMENTS)
def test_the_environment_makes_no_difference(environment: str) -> None:
    variables: Any = dict(each.split("=") for each in environment.split())
    assert digests(**variables) == expected()


def test_where_it_runs_makes_no_difference(tmp_path: Path) -> None:
    assert digests(cwd=tmp_path) == expected()
    relative = [Path(os.path.relpath(spec, ROOT / "tests")) for spec in SPECS.values()]
    assert digests(*relative, cwd=ROOT / "tests") == expected()


def test_where_the_project_lies_makes_no_difference(tmp_path: Path) -> None:
    copies = [tmp_path / "a b" / "ü" / spec.relative_to(ROOT) for spec in SPECS.values()]
    for spec, copy in zip(SPECS.values(), copies, strict=True):
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(spec, copy)
    assert digests(*copies) == expected()


def test_every_python_at_hand_gives_the_same_bytes() -> None:
    """The running Python always, and every other that can import what the generator needs.

    What is committed was written by one of them: `framegen generate --check` under each Python of
    the test matrix, here and in CI, compares them all with each other.
    """
    assert digests() == expected()
    imports = "import jinja2, markdown_it, pydantic, pygments, yaml"
    for python in filter(None, (shutil.which(f"python3.{minor}") for minor in range(10, 15))):
        if ran(python, "-c", imports, status=None).returncode == 0:
            assert digests(python=python) == expected()


def test_the_committed_output_comes_out_of_this_python() -> None:
    path = {"PYTHONPATH": str(ROOT / "codegen")}
    words = ("framegen", "generate", "--check")
    assert ran(sys.executable, "-m", *words, cwd=ROOT, environment=path).stdout == ""
