"""The same spec gives the same bytes: in any folder, locale, time zone, hash order and Python."""

import os
import shutil
import sys
from functools import cache
from pathlib import Path

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
    python: str = sys.executable,
    *,
    cwd: Path = ROOT,
    specs: list[Path],
    environment: dict[str, str] | None = None,
) -> str:
    """Return what that program prints in a fresh interpreter, in that folder and environment."""
    variables = {"PYTHONPATH": str(ROOT / "codegen"), **(environment or {})}
    return ran(python, "-c", DIGESTS, *specs, cwd=cwd, environment=variables).stdout


@cache
def expected() -> str:
    return digests(specs=list(SPECS.values()), environment={"PYTHONHASHSEED": "0"})


def test_every_file_has_a_digest() -> None:
    paths = [line.split(" ", 1)[1] for line in expected().splitlines()]
    first = {"/".join(path.split("/")[:-1]) for path in paths}
    for name in SPECS:
        reference = f"reference/{name}"
        assert {f"generated/{name}", f"docs/{reference}", f"site/{reference}"} <= first
    assert "site/index.html" in paths


@pytest.mark.parametrize(
    "environment",
    [
        {
            "PYTHONHASHSEED": "1",
            "LC_ALL": "C",
            "PYTHONUTF8": "0",
            "PYTHONCOERCECLOCALE": "0",
            "TZ": "Pacific/Kiritimati",
            "SOURCE_DATE_EPOCH": "0",
            "PYTHONOPTIMIZE": "1",
        },
        {
            "PYTHONHASHSEED": "4294967295",
            "LC_ALL": "tr_TR.UTF-8",
            "LANG": "tr_TR.UTF-8",
            "TZ": "America/Caracas",
            "USER": "somebody",
            "HOME": "/",
            "HOSTNAME": "elsewhere",
            "PYTHONDONTWRITEBYTECODE": "1",
            "COLUMNS": "20",
            "NO_COLOR": "1",
            "TERM": "dumb",
        },
    ],
    ids=" ".join,
)
def test_the_environment_makes_no_difference(environment: dict[str, str]) -> None:
    assert digests(specs=list(SPECS.values()), environment=environment) == expected()


def test_where_it_runs_makes_no_difference(tmp_path: Path) -> None:
    assert digests(cwd=tmp_path, specs=list(SPECS.values())) == expected()
    relative = [Path(os.path.relpath(spec, ROOT / "tests")) for spec in SPECS.values()]
    assert digests(cwd=ROOT / "tests", specs=relative) == expected()


def test_where_the_project_lies_makes_no_difference(tmp_path: Path) -> None:
    copies = [tmp_path / "a b" / "ü" / spec.relative_to(ROOT) for spec in SPECS.values()]
    for spec, copy in zip(SPECS.values(), copies, strict=True):
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(spec, copy)
    assert digests(specs=copies) == expected()


def other_pythons() -> list[str]:
    """Return every Python from 3.10 on that is installed, except the running one."""
    names = [f"python3.{minor}" for minor in range(10, 15)]
    found = [path for name in names if (path := shutil.which(name)) is not None]
    running = Path(sys.executable).resolve()
    return [path for path in found if Path(path).resolve() != running]


def test_every_python_at_hand_gives_the_same_bytes() -> None:
    """The running Python always, and every other that can import what the generator needs.

    What is committed was written by one of them: `framegen generate --check` under each Python of
    the test matrix, here and in CI, compares them all with each other.
    """
    assert digests(specs=list(SPECS.values())) == expected()
    for python in other_pythons():
        imports = "import jinja2, markdown_it, pydantic, pygments, yaml"
        needs = ran(python, "-c", imports, status=None)
        if needs.returncode == 0:
            assert digests(python, specs=list(SPECS.values())) == expected()


def test_the_committed_output_comes_out_of_this_python() -> None:
    path = {"PYTHONPATH": str(ROOT / "codegen")}
    words = ("framegen", "generate", "--check")
    assert ran(sys.executable, "-m", *words, cwd=ROOT, environment=path).stdout == ""
