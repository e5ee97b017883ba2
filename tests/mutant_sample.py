"""A sample of mutants, which shows whether other tests detect as much as those before them.

tests/mutant_sample.yaml has one row for each: a place in the code, and what it becomes there. They
were drawn by a seed, before any was tried, from lines that were the same in an older edition, so
that the tests of that edition can be tried on the same mutants. What only words depend on is left
out. A row in which nothing can show a difference says so: `equivalent`.

    python -m tests.mutant_sample --results before.yaml
    python -m tests.mutant_sample --killers before.yaml --results after.yaml
    python -m tests.mutant_sample --only codec-3 --commit 3fe21efa --tests tests/test_stream.py

Each mutant is made in a clone of the commit, the libraries are generated there again if it is part
of them, and the tests of its subject run until one fails, then all others. With --killers, files
of the name of the killer run first, wherever they are now.

tests/derive_mutants.yaml has mutants of what codec and libraries have in common, so that tests that
compare the two see nothing. Each names the second opinion that kills it, which alone runs, on
libraries generated under the mutant:

    python -m tests.mutant_sample --rows tests/derive_mutants.yaml --only place --only order-field
"""

import argparse
import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

import yaml

ROOT = Path(__file__).parent.parent
SAMPLE = Path(__file__).with_suffix(".yaml")
PARTS = ("generated", "codegen", "simulator", "runtime")
# What is in here is in the libraries, too.
COPIED = ("codegen/framegen/targets/python/", "runtime/")
SECONDS, BYTES = 300, 4 << 30


# Names of files and folders of tests that are tried first on the mutants of a subject.
SUBJECTS = {
    "model": ["model", "language", "test_bad_specs.py", "test_explain.py", "test_vectors.py"],
    "checks": ["checks", "test_findings.py", "test_part_names.py"],
    "comparison": ["comparison"],
    "codec": ["codec", "test_messages.py", "test_demo_library.py", "protocols"],
    "client": ["client", "independent"],
    "tables": ["tables"],
    "page": ["page", "test_*_js.py", "test_search.py"],
}
# A clone is no installed package, so that its version is that of the spec.
LEFT_OUT = "not test_there_is_one_version"


def git(*arguments: str, folder: Path = ROOT) -> str:
    """Return what git prints."""
    command = ["git", "-C", str(folder), *arguments]
    return subprocess.run(command, check=True, capture_output=True, encoding="utf-8").stdout


def _places(some: list[str], text: str) -> list[int]:
    lines = text.splitlines()
    return [at for at in range(len(lines)) if lines[at : at + len(some)] == some]


class Run:
    """A clone of a commit, in which mutants are made and tests run."""

    def __init__(self, folder: Path, commit: str) -> None:
        self.folder = folder
        git("clone", "-q", "--shared", "--no-checkout", str(ROOT), str(folder))
        git("checkout", "-q", "--detach", git("rev-parse", commit).strip(), folder=folder)
        path = os.pathsep.join(str(folder / part) for part in PARTS)
        self.environment = os.environ | {"PYTHONPATH": path}
        self.environment.pop("PYTHONDONTWRITEBYTECODE", None)

    def mutate(self, row: dict[str, str]) -> bool:
        """Make a mutant in place of the last one, and tell whether libraries could be generated."""
        git("reset", "-q", "--hard", folder=self.folder)
        git("clean", "-q", "-d", "--force", folder=self.folder)
        path = self.folder / row["file"]
        text = path.read_text(encoding="utf-8")
        (at,) = _places(row["was"].splitlines(), text)
        lines = text.splitlines(keepends=True)
        lines[at : at + row["was"].count("\n") + 1] = [row["becomes"] + "\n"]
        path.write_text("".join(lines), encoding="utf-8")
        in_library = "killer" in row or row["file"].startswith(COPIED)
        done = not in_library or self.python("-m", "framegen", "generate").returncode == 0
        # What is compiled is known by its second and size, which two mutants may share.
        for part in PARTS:
            for compiled in [*(self.folder / part).rglob("__pycache__")]:
                shutil.rmtree(compiled)
        return done

    def killer(self, *arguments: str) -> str | None:
        """Run tests, and return the first that fails, or the one that has no end."""
        limit = f"faulthandler_timeout={SECONDS}"
        options = ["-x", "-q", "--tb=no", "-p", "no:cacheprovider", "-o", limit]
        options += ["-o", "faulthandler_exit_on_timeout=true", "-k", LEFT_OUT, *arguments]
        run = self.python("-m", "pytest", *options)
        if run.returncode in {0, 5}:  # 5: there are no such tests
            return None
        failed = re.search(r"^(?:FAILED|ERROR) (.+?)(?: - |$)", run.stdout, re.MULTILINE)
        endless = re.search(r"(tests/\S+)\", line \d+ in (test_\w+)", run.stderr)
        return (
            failed[1] if failed else "::".join(endless.groups()) if endless else "tests/conftest.py"
        )

    def python(self, *arguments: str) -> subprocess.CompletedProcess[str]:
        """Run a module in the clone."""
        command, here = [sys.executable, *arguments], self.folder
        return subprocess.run(
            command,
            cwd=here,
            env=self.environment,
            capture_output=True,
            encoding="utf-8",
            check=False,
        )

    def files(self, killer: str) -> list[str]:
        """Return files of tests with the name of the one that killed before, or with its test."""
        name, _, test = killer.partition("::")
        test = test.partition("[")[0]
        files = [*(self.folder / "tests").rglob("test_*.py")]
        files = [file for file in files if "world" not in file.parts]
        found = [file for file in files if file.name == Path(name).name]
        moved = [file for file in files if test and f"def {test}(" in file.read_text("utf-8")]
        return [str(file.relative_to(self.folder)) for file in found or moved]

    def near(self, subject: str) -> list[str]:
        """Return the files and folders of tests of a subject, wherever they are."""
        tests = self.folder / "tests"
        found = [file for name in SUBJECTS[subject] for file in sorted(tests.rglob(name))]
        inside = [file.relative_to(self.folder) for file in found]
        return [str(file) for file in inside if "world" not in file.parts]

    def judge(self, row: dict[str, str], tests: list[str], killer: str) -> str | None:
        """Return what kills a mutant: the former killer, or tests of its subject, or any other."""
        done = self.mutate(row)
        if "killer" in row:  # whether a spec is refused for it is for that test to say
            return self.killer(*(tests or [row["killer"]]))
        if not done:
            return "framegen generate"
        if tests:
            return self.killer(*tests)
        first = self.files(killer) if killer else []
        near = self.near(row["id"].partition("-")[0])
        rest = ["-n", "2", *(f"--ignore={each}" for each in near)]
        return (
            (first and self.killer(*first)) or (near and self.killer(*near)) or self.killer(*rest)
        )


def table(rows: object) -> str:
    """Write YAML, with several lines as they are."""

    def lines(dumper: yaml.SafeDumper, text: str) -> yaml.Node:
        style = "|" if "\n" in text else None
        return dumper.represent_scalar("tag:yaml.org,2002:str", text, style)

    class Dumper(yaml.SafeDumper):
        """Does not change how others write."""

    Dumper.add_representer(str, lines)
    return yaml.dump(rows, Dumper=Dumper, sort_keys=False, allow_unicode=True, width=1000)


def main() -> None:
    """Try the sample, or some of it."""
    parser = argparse.ArgumentParser(prog="python -m tests.mutant_sample")
    parser.add_argument("--rows", type=Path, default=SAMPLE, metavar="FILE", help="other mutants")
    parser.add_argument("--only", action="append", metavar="ID", help="a mutant, or all of a kind")
    parser.add_argument("--tests", nargs="+", default=[], metavar="FILE", help="these tests alone")
    parser.add_argument("--commit", default="HEAD", help="where tests and code are from")
    parser.add_argument("--results", type=Path, metavar="FILE", help="what to write: who killed")
    parser.add_argument("--killers", type=Path, metavar="FILE", help="results, to try those first")
    asked = parser.parse_args()
    killers = yaml.safe_load(asked.killers.read_text("utf-8")) if asked.killers else {}
    results = {}
    if asked.results and asked.results.exists():
        results = yaml.safe_load(asked.results.read_text("utf-8"))
    resource.setrlimit(resource.RLIMIT_DATA, (BYTES, BYTES))
    with TemporaryDirectory() as folder:
        run = Run(Path(folder) / "clone", asked.commit)
        for row in yaml.safe_load(asked.rows.read_text("utf-8")):
            named = {row["id"], row["id"].partition("-")[0]}
            if not named.isdisjoint(asked.only) if asked.only else "equivalent" not in row:
                used = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
                killer = run.judge(row, asked.tests, killers.get(row["id"], {}).get("killer") or "")
                used = sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2]) - used
                results[row["id"]] = {"killer": killer, "seconds": round(used)}
                print(f"{row['id']}: {killer or 'survived'} ({used:.0f} s)", flush=True)
                if asked.results:
                    asked.results.write_text(table(results), encoding="utf-8")


if __name__ == "__main__":
    main()
